"""The library as it is installed: its interface, its pkg-config file, its CMake configuration and its C examples.

Each test takes what it needs from the environment: OROGRAPH_INSTALLED (the prefix), OROGRAPH_SOURCE (the project's
folder), OROGRAPH_PROGRAM, and OROGRAPH_CMAKE.
"""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import abi

INSTALLED = Path(os.environ["OROGRAPH_INSTALLED"])
SOURCE = Path(os.environ["OROGRAPH_SOURCE"])
PROGRAM = os.environ["OROGRAPH_PROGRAM"]
CMAKE = os.environ["OROGRAPH_CMAKE"]
DATA = SOURCE / "data" / "jacksboro.tif"
HEADER = INSTALLED / "include/orograph.h"


def library():
    found = list(INSTALLED.glob("lib/**/liborograph.so.1"))
    assert len(found) == 1, found
    return found[0]


def run(*words, code=0, **keys):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=300, **keys)
    assert done.returncode == code, f"{words} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
    return done


def environment():
    return {**os.environ, "PKG_CONFIG_PATH": str(library().parent / "pkgconfig"),
            "LD_LIBRARY_PATH": str(library().parent)}


def flags():
    return run("pkg-config", "--cflags", "--libs", "orograph", env=environment()).stdout.split()


class InstalledLibrary(unittest.TestCase):
    def test_has_each_line_of_its_interface_and_no_others(self):
        kept, found = abi.kept_lines(), abi.found_lines(HEADER.read_text(), library())
        self.assertEqual(len(set(kept)), len(kept))
        self.assertEqual([line for line in kept if line not in found], [], "lines of abi.txt that are changed or gone")
        self.assertEqual([line for line in found if line not in kept], [], "lines that abi.txt lacks: see its head")

    def test_symbols_are_those_of_the_header_and_no_others(self):
        symbols = [re.fullmatch(r"symbol (\w+)@@OROGRAPH_\d", line)[1] for line in abi.exported_lines(library())]
        functions = [re.match(r"function [\w ]+?\*? ?(oro_\w+)\(", line)[1]
                     for line in abi.declared_lines(HEADER.read_text()) if line.startswith("function ")]
        self.assertEqual(sorted(symbols), sorted(functions))

    def test_a_change_of_the_header_is_found(self):
        header, kept = HEADER.read_text(), abi.kept_lines()
        for before, after, changed in [
                ("double feather_m;", "float feather_m;", "member oro_open_options.feather_m double at 56 of 8"),
                ("size_t highest, lowest;", "size_t lowest, highest;", "member oro_profile_sums.highest size_t at 56 of 8"),
                ("int above;", "int above; int more;", None),
                ("ORO_CANCELLED = 5", "ORO_CANCELLED = 7", "value ORO_CANCELLED 5"),
                ("ORO_API const char* oro_version(void);", "", "function const char* oro_version(void)"),
                ("size_t* width_px, size_t* height_px", "size_t* height_px, size_t* width_px", "function oro_status oro_shot("),
                ("(-9999.0f)", "(-9999.0)", "macro ORO_UNKNOWN (-9999.0f)"),
                ("20.0, 0.0, ORO_AIR_STANDARD", "25.0, 0.0, ORO_AIR_STANDARD", "default oro_viewshed_options.radius_km 20")]:
            self.assertIn(before, header)
            other = header.replace(before, after)
            lines = abi.declared_lines(other) + abi.measured_lines(other)
            gone = [line for line in kept if line not in lines and not line.startswith("symbol ")]
            if changed is None:
                self.assertEqual([line for line in lines if line not in kept], ["member oro_point.more int at 28 of 4"])
            else:
                self.assertTrue(any(line.startswith(changed) for line in gone), (after, gone))

    def test_soname_has_its_version(self):
        said = run("readelf", "-d", library()).stdout
        self.assertIn("Library soname: [liborograph.so.1]", said)
        self.assertNotIn("RPATH", said)
        self.assertNotIn("RUNPATH", said)

    def test_the_header_is_c99_and_cxx(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, compiler in (("h.c", ["cc", "-std=c99"]), ("h.cpp", ["c++", "-std=c++11"])):
                file = Path(folder) / name
                file.write_text("#include <orograph.h>\nint main(void) { return oro_api_version() == 0; }\n")
                run(*compiler, "-Wall", "-Wextra", "-Wpedantic", "-Werror", file, "-o", file.with_suffix(".run"), *flags())
                run(file.with_suffix(".run"), env=environment())

    def test_the_c_example_has_the_heights_of_the_program(self):
        places = ["36.55,-84.25", "36.512345,-84.298765"]
        with tempfile.TemporaryDirectory() as folder:
            example = Path(folder) / "heights"
            run("cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror",
                SOURCE / "apps/library/examples/heights.c", "-o", example, *flags())
            said = run(example, DATA, *places, "40,8", env=environment()).stdout.splitlines()
            refused = run(example, Path(folder) / "none.tif", "1,2", code=1, env=environment())
        profile = json.loads(run(PROGRAM, "profile", DATA, "--along", ";".join(places), "--json", "-q").stdout)
        for line, place, end in zip(said[1:3], places, ("begin", "end")):
            self.assertEqual(line, "%s: H %.17g m, h %.17g m" % (place, profile[end]["H_m"], profile[end]["h_m"]))
        self.assertEqual(said[3], "40,8: no ground")
        self.assertRegex(refused.stderr, r"^opening: .*none\.tif: ")

    def test_the_c_example_of_a_viewshed_counts_what_the_program_counts(self):
        with tempfile.TemporaryDirectory() as folder:
            example, picture = Path(folder) / "viewshed", Path(folder) / "seen.pgm"
            run("cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror",
                SOURCE / "apps/library/examples/viewshed.c", "-o", example, *flags())
            said = run(example, DATA, "36.55", "-84.25", "5", picture, env=environment()).stdout
            shed = json.loads(run(PROGRAM, "viewshed", DATA, "--at", "36.55,-84.25", "--radius", 5, "--out",
                                  folder + "/seen.tif", "--json", "-q").stdout)
            self.assertTrue(said.startswith("%d of %d posts are seen; " % (shed["seen"], shed["cells"])), said)
            size = "P5\n%d %d\n255\n" % (shed["columns"], shed["rows"])
            self.assertEqual(picture.read_bytes().count(b"\xff", len(size)), shed["seen"])
            self.assertEqual(picture.stat().st_size, len(size) + shed["columns"] * shed["rows"])

    def test_cmake_finds_it(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "CMakeLists.txt").write_text(
                "cmake_minimum_required(VERSION 3.25)\nproject(user LANGUAGES C)\nfind_package(Orograph 0.1 REQUIRED)\n"
                f"add_executable(user {SOURCE}/apps/library/examples/heights.c)\n"
                "target_link_libraries(user PRIVATE Orograph::orograph)\n")
            run(CMAKE, "-S", folder, "-B", folder + "/build", f"-DCMAKE_PREFIX_PATH={INSTALLED}")
            run(CMAKE, "--build", folder + "/build")
            self.assertIn("H ", run(folder + "/build/user", DATA, "36.55,-84.25").stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)

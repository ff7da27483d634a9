"""The library as it is installed: its symbols, its pkg-config file, its CMake configuration and its C examples.

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

INSTALLED = Path(os.environ["OROGRAPH_INSTALLED"])
SOURCE = Path(os.environ["OROGRAPH_SOURCE"])
PROGRAM = os.environ["OROGRAPH_PROGRAM"]
CMAKE = os.environ["OROGRAPH_CMAKE"]
DATA = SOURCE / "data" / "jacksboro.tif"


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


def declared():
    """The functions that the header declares."""
    text = re.sub(r"/\*.*?\*/", "", (SOURCE / "apps/library/orograph.h").read_text(), flags=re.S)
    return sorted(re.findall(r"ORO_API [\w ]+?\*? ?(oro_\w+)\(", text))


class InstalledLibrary(unittest.TestCase):
    def test_symbols_are_those_of_the_header_and_no_others(self):
        lines = run("nm", "-D", "--defined-only", "--with-symbol-versions", library()).stdout.splitlines()
        names = sorted(line.split()[-1].split("@")[0] for line in lines)
        versions = {line.split("@")[-1] for line in lines if "@" in line}
        self.assertGreaterEqual(len(declared()), 8)
        self.assertEqual(names, sorted(declared() + ["OROGRAPH_1", "OROGRAPH_2"]))
        self.assertEqual(versions, {"OROGRAPH_1", "OROGRAPH_2"})

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

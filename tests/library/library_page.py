"""The examples of docs/LIBRARY.md: each is run from the installed library, and prints what the page says.

A block of Python goes on where the one before it ended; `python NAME` is passed over where the module NAME is not there.
The block `text` that follows has what is printed. With --write the page gets what was printed.
"""

import contextlib
import importlib.util
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import traceback
import unittest
from pathlib import Path

INSTALLED = Path(os.environ["OROGRAPH_INSTALLED"])
SOURCE = Path(os.environ["OROGRAPH_SOURCE"])
CMAKE = os.environ["OROGRAPH_CMAKE"]
PAGE = SOURCE / "docs/LIBRARY.md"
FENCE = re.compile(r"^```([^\n]*)\n(.*?)^```$", re.M | re.S)
LIBRARY = next(INSTALLED.glob("lib/**/liborograph.so.1")).parent
sys.path.insert(0, str(INSTALLED / "lib/python3/dist-packages"))


def environment():
    return {**os.environ, "PKG_CONFIG_PATH": str(LIBRARY / "pkgconfig"), "LD_LIBRARY_PATH": str(LIBRARY)}


def run(*words, **keys):
    done = subprocess.run(words, capture_output=True, text=True, timeout=300, env=environment(), **keys)
    assert done.returncode == 0, f"{words} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
    return done.stdout


def printed_by_python(code, names):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(code, str(PAGE), "exec"), names)
    return out.getvalue()


def examples():
    """Kind, text and the text that is to be printed (None: nothing is shown) of each example, and where that stands."""
    text = PAGE.read_text()
    found = [(match.group(1), match.group(2), match) for match in FENCE.finditer(text)]
    return [(kind, code, found[i + 1][2] if i + 1 < len(found) and found[i + 1][0] == "text" else None)
            for i, (kind, code, _) in enumerate(found) if kind != "text"]


class LibraryPage(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.before = os.getcwd()
        os.chdir(self.folder.name)
        shutil.copy(SOURCE / "data/jacksboro.tif", ".")

    def tearDown(self):
        os.chdir(self.before)
        self.folder.cleanup()

    def check(self, code, printed, shown):
        self.assertIsNotNone(shown, f"the page does not say what this prints:\n{code}")
        self.assertEqual(printed, shown.group(2))

    def test_c(self):
        blocks = {kind: (code, shown) for kind, code, shown in examples() if kind in ("c", "sh", "cmake")}
        self.assertEqual(sorted(blocks), ["c", "cmake", "sh"])
        Path("example.c").write_text(blocks["c"][0])
        run("sh", "-ec", blocks["sh"][0])
        self.check(blocks["c"][0], run("./example"), blocks["c"][1])
        Path("CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(example LANGUAGES C)\n"
                                          "add_executable(example example.c)\n" + blocks["cmake"][0])
        run(CMAKE, "-S", ".", "-B", "build", f"-DCMAKE_PREFIX_PATH={INSTALLED}")
        run(CMAKE, "--build", "build")
        self.check(blocks["c"][0], run("build/example"), blocks["c"][1])

    def test_python(self):
        names, count, has_gdal = {"__name__": "example"}, 0, importlib.util.find_spec("osgeo") is not None
        for kind, code, shown in examples():
            words = kind.split()
            if words[:1] != ["python"]:
                continue
            missing = [word for word in words[1:] if importlib.util.find_spec(word) is None]
            if missing or ("osgeo" in code and not has_gdal):
                print("passed over: an example with", *(missing or ["osgeo"]))
                continue
            with self.subTest(code=code):
                self.check(code, printed_by_python(code, names), shown)
                count += 1
        self.assertGreaterEqual(count, 4)


def write_page():
    text, names = PAGE.read_text(), {"__name__": "example"}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        shutil.copy(SOURCE / "data/jacksboro.tif", ".")
        for kind, code, shown in examples():
            if kind.startswith("python") and shown is not None:
                try:
                    text = text.replace(code + "```\n\n" + shown.group(0),
                                        code + "```\n\n```text\n" + printed_by_python(code, names) + "```")
                except Exception:
                    traceback.print_exc()
    PAGE.write_text(text)


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        write_page()
    else:
        unittest.main(verbosity=2)

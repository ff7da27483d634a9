"""Drives apps/qgis/orograph/program.py, which knows nothing of QGIS: progress, messages, errors and cancel.

    qgis_program.py FOLDER_OF_THE_PLUGIN FOLDER

Prints a line for each of what follows; tests/apps/qgis_plugin_test.cpp compares them.
"""

import ast
import os
import stat
import sys
import time

sys.dont_write_bytecode = True
plugin, folder = sys.argv[1:]
sys.path.insert(0, plugin)
import program  # noqa: E402

for place, _, names in os.walk(plugin):
    for name in names:
        if name.endswith(".py"):
            with open(os.path.join(place, name), encoding="utf-8") as source:
                ast.parse(source.read(), name)
print("all files are Python")


def script(name, text):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as to:
        to.write("#!/bin/bash\n" + text)
    os.chmod(path, stat.S_IRWXU)
    return path


def run(path, is_cancelled=lambda: False):
    lines, shares = [], []
    try:
        written = program.run(path, ["a b", "ü"], lines.append, lambda *share: shares.append(share), is_cancelled)
    except (program.Cancelled, program.ProgramFailed) as error:
        written = type(error).__name__ + ": " + str(error)
    return written, lines, shares


# As the program draws it on a terminal, in pieces.
working = script("working", r"""
test -t 2 && echo "orograph: note: a terminal" >&2
printf '\r\033[K[###...]  42 %% reading a b' >&2; sleep 0.1; printf ' c' >&2
printf '\r\033[K[######] 100 %% done\r\033[K' >&2
printf '{"words": "%s"}' "$*"
""")
print(run(working))
print(run(script("failing", "echo 'orograph: no such file' >&2; exit 3\n")))
print(run(script("silent", "exit 4\n"))[0].replace(folder, ""))
print(run(os.path.join(folder, "nothing"))[0].replace(folder, ""))
# One that ends when it is asked to, and one that must be made to.
for name, seconds, trap in (("obedient", 20.0, "trap 'touch $0.asked; exit 143' TERM"), ("stubborn", 0.5, "trap '' TERM")):
    program.SECONDS_TO_END = seconds
    path = script(name, trap + "\ntouch $0.ready\nfor i in {1..600}; do sleep 0.05; done\n")
    begin = time.monotonic()
    said = run(path, lambda: os.path.exists(path + ".ready"))[0]
    print(name, said, time.monotonic() - begin < 15, os.path.exists(path + ".asked"))
# Much of it, on both streams at once.
much = script("much", "for i in {1..20000}; do echo line $i >&2; echo $i; done\n")
written, lines, _ = run(much)
print(len(written.split()), len(lines), lines[-1])

"""The interface of the library as binaries see it, in lines: those of abi.txt beside this file, and those that a header and
a built library have.

    symbol NAME@@VERSION                        a symbol that the library exports
    function PROTOTYPE                          as the header declares it
    type TYPEDEF
    value NAME NUMBER                           of an enumeration
    macro NAME TEXT                             what callers compile into their own code, but for initializers
    default STRUCT.NAME VALUE                   what the initializer of a structure gives a member
    member STRUCT.NAME TYPE at OFFSET of SIZE   in bytes, of 64 bits
    struct NAME of SIZE                         of a structure that does not tell its size, and so cannot grow

    python3 tests/library/abi.py HEADER LIBRARY

prints the lines that these two have and abi.txt lacks, for a new version of the interface to add them.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

FILE = Path(__file__).with_name("abi.txt")
# The number of the interface grows, and ORO_API says how symbols are shown.
NOT_HELD = {"ORO_API_VERSION", "ORO_API", "OROGRAPH_H"}


def kept_lines():
    lines = FILE.read_text().splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text.replace("\\\n", " "), flags=re.S)


def one_space(text):
    return re.sub(r"\s+", " ", text).strip()


def members_of(body):
    """The type and the name of each member of a structure; the type of an array has its length."""
    for declaration in body.split(";")[:-1]:
        first, *others = declaration.split(",")
        kind, name = re.fullmatch(r"(.*[\s*])(\w+(?:\[\d+\])?)", one_space(first)).groups()
        for each in [name, *(one_space(other) for other in others)]:
            name, length = re.fullmatch(r"(\w+)((?:\[\d+\])?)", each).groups()
            yield kind.strip() + length, name


def structures(header):
    """The members of each structure of a header: type and name."""
    found = re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", without_comments(header), re.S)
    return {name: list(members_of(body)) for name, body in found}


def values(header):
    bodies = re.findall(r"\benum \{(.*?)\};", without_comments(header), re.S)
    return [re.match(r"\s*(\w+)", part)[1] for body in bodies for part in body.split(",") if part.strip()]


def declared_lines(header):
    """What a header says without a compiler: functions, types and macros."""
    text = without_comments(header)
    functions = re.findall(r"^ORO_API ([^;]*);", text, re.M)
    types = re.findall(r"^typedef (?!struct)([^;]*);", text, re.M)
    macros = re.findall(r"^#define (\w+)(.*)$", text, re.M)
    return ["function " + one_space(each) for each in functions] + ["type " + one_space(each) for each in types] + [
        one_space(f"macro {name} {rest}") for name, rest in macros if name not in NOT_HELD and "{" not in rest]


def prints_of_defaults(header):
    """Statements of C that print what initializers give."""
    members = structures(header)
    for name, structure in re.findall(r"^#define (\w+) *\{ *sizeof\((\w+)\)", without_comments(header), re.M):
        yield f"const {structure} of_{structure} = {name};"
        for kind, member in members[structure][1:]:
            value = f"of_{structure}.{member}"
            if kind.endswith("*"):
                yield f'printf("default {structure}.{member} %s\\n", {value} == NULL ? "NULL" : "a pointer");'
            else:
                yield f'printf("default {structure}.{member} %.17g\\n", (double){value});'


def measured_lines(header):
    """What a compiler says of a header: values, where members lie, and what initializers give."""
    prints = [f'printf("value {name} %d\\n", (int){name});' for name in values(header)]
    for structure, members in structures(header).items():
        prints += [f'printf("member {structure}.{name} {kind} at %zu of %zu\\n", offsetof({structure}, {name}), '
                   f'sizeof((({structure}*)0)->{name}));' for kind, name in members]
        if members[0] != ("size_t", "size"):
            prints.append(f'printf("struct {structure} of %zu\\n", sizeof({structure}));')
    prints += prints_of_defaults(header)
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "orograph.h").write_text(header)
        Path(folder, "abi.c").write_text('#include "orograph.h"\n#include <stddef.h>\n#include <stdio.h>\n'
                                         "int main(void) {\n" + "\n".join(prints) + "\nreturn 0;\n}\n")
        subprocess.run(["cc", "-std=c99", folder + "/abi.c", "-o", folder + "/abi"], check=True, timeout=300)
        said = subprocess.run([folder + "/abi"], check=True, capture_output=True, text=True, timeout=300).stdout
    return said.splitlines()


def exported_lines(library):
    said = subprocess.run(["nm", "-D", "--defined-only", "--with-symbol-versions", str(library)], check=True,
                          capture_output=True, text=True, timeout=300).stdout
    # Of the kind A are the versions themselves.
    symbols = [line.split() for line in said.splitlines()]
    return ["symbol " + name for _, kind, name in symbols if kind != "A"]


def found_lines(header, library):
    return exported_lines(library) + declared_lines(header) + measured_lines(header)


if __name__ == "__main__":
    kept = set(kept_lines())
    found = found_lines(Path(sys.argv[1]).read_text(), sys.argv[2])
    print("\n".join(line for line in found if line not in kept))

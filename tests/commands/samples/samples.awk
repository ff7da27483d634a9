# Makes a C++ source of the code samples in the comments of headers: lines of a comment that are indented by five spaces
# and all end in a semicolon, a brace or a comment of their own. Each is the body of a function whose parameters are
# tests/commands/samples/sample_context.h's.
function emit() {
    if (block != "" && is_code) {
        bodies = bodies "// " FILENAME "\nResult<void> sample_" ++count "(SAMPLE_CONTEXT) {\n    {\n" block "    }\n    return {};\n}\n\n"
        if (!(FILENAME in included)) {
            included[FILENAME] = 1
            includes = includes "#include \"" FILENAME "\"\n"
        }
    }
    block = ""
    is_code = 1
}
BEGIN { is_code = 1 }
FNR == 1 { emit() }
/^\/\/     [^ ]/ || (/^\/\/     / && block != "") {
    line = substr($0, 8)
    block = block "        " line "\n"
    code = line
    sub(/ *\/\/.*$/, "", code)
    if (code !~ /[;{}]$/) is_code = 0
    next
}
{ emit() }
END {
    emit()
    printf "%s#include \"tests/commands/samples/sample_context.h\"\n\n", includes
    print "#pragma GCC diagnostic ignored \"-Wshadow\""
    print "#pragma GCC diagnostic ignored \"-Wunused-variable\""
    print "#pragma GCC diagnostic ignored \"-Wunused-but-set-variable\"\n"
    printf "namespace oro::samples {\n\n%s}  // namespace oro::samples\n", bodies
    if (count < 10) exit 1
}

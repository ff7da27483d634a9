# Puts a font's file into a C++ source, so that text has the same pixels wherever the program runs:
# cmake -D FONT=... -D OUT=... -P embed_font.cmake
file(READ ${FONT} bytes HEX)
string(REGEX REPLACE "(................................................)" "\\1\n" bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE ${OUT} "#include \"apps/text/font_file.h\"\n\nnamespace oro {\n\nconst unsigned char font_file[] = {\n${bytes}};\n"
     "const unsigned long font_file_bytes = sizeof(font_file);\n\n}  // namespace oro\n")

# cmake -DWORDS=file.spv -DNAME=name -DHEADER=name.h -P embed_words.cmake: the header that glslangValidator --vn writes.
file(READ ${WORDS} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${HEADER} "#pragma once\nconst uint32_t ${NAME}[] = {${words}};\n")

// The font that pictures are written in: DejaVu Sans, as it was when the program was built.
#pragma once

namespace oro {

extern const unsigned char font_file[];  // made by apps/text/embed_font.cmake
extern const unsigned long font_file_bytes;

}  // namespace oro

// The text of tables (CSV), which spreadsheets write in several encodings.
#pragma once

#include <string>

#include "core/base/result.h"

namespace oro {

// A text in UTF-8, and what a user must know of how it was read; "" for nothing.
struct TableText {
    std::string text;
    std::string note;  // without the file's name
};

// Turns the bytes of a table into UTF-8: UTF-16 and UTF-32 by their byte order mark (utf8_text()), and what
// is no UTF-8 from Windows-1252, with a note. Errors (a reason, without the file's name): UTF-16 without a
// mark, or another file with zero bytes; UTF-16 that ends within a character.
Result<TableText> utf8_table(std::string bytes);

// The same of a file. Errors: a file that is not there, or that is no plain file; one longer than
// longest_vector_text.
Result<TableText> read_table_text(const std::string& file);

}  // namespace oro

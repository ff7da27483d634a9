// The tables of land-cover products: those that come with the program, and a user's own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/cover/cover_table.h"

namespace oro {

// What --landcover names: files, later ones over earlier ones, and the table of all of them; "": as their
// codes say. A table is one that comes with the program, by its name, or a .json file.
struct CoverChoice {
    std::vector<std::string> files;
    std::string table;
    bool operator==(const CoverChoice&) const = default;
};

// The tables that come with the program, in alphabetical order: "cci", "corine", ...
std::vector<std::string> cover_table_names();

// A choice from the words of a command line, FILE or FILE,TABLE each. Errors (usage): two different tables.
Result<CoverChoice> cover_choice_from(const std::vector<std::string>& words);
// And back: the words that give it.
std::vector<std::string> words_of(const CoverChoice& choice);

// Whether a table is a user's own, in a file.
bool is_table_path(const std::string& table);

// A table, and the XXH64 of its text.
struct CoverTableRead {
    CoverTable table;
    std::uint64_t fingerprint{};
};
// Errors: no such table or file; what is missing or wrong in it.
Result<CoverTableRead> read_cover_table(const std::string& table);
// From the text of a table that `where` holds.
Result<CoverTable> cover_table_from(const std::string& text, const std::string& where);

}  // namespace oro

// Places of a table or a vector file, for each of which a line of a list is a job of its own.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// A place with what is known of it: `number` from 1, and all fields of its file. Where no column of a table
// is called `lat` or `lon`, those are what the column has that means the same
// (geo/vectors/coordinate_columns.h); `name` and `above` are columns of these names in any letters. A point
// of a vector file has `lat` and `lon` in degrees, and `ele` in metres where it has a height, whatever its
// file calls them.
struct BatchPlace {
    std::size_t number{};
    std::map<std::string, std::string> fields;

    // For messages: its number, and its name where it has one.
    [[nodiscard]] std::string words() const;
};

// What a file of places holds.
struct PlacesOfFile {
    std::vector<BatchPlace> all;
    std::vector<std::string> headings;  // the names in a table's first line, in their order, or those of the
                                        // fields that the points of a vector file have
    std::vector<std::string> notes;     // what a user must know of how it was read, one line each
};

// A table is a .csv, .tsv or .txt (geo/vectors/csv_records.h), a vector file one that read_vectors() reads:
// its points. Errors: those of reading; no place.
Result<PlacesOfFile> read_places(const std::string& file);

// The text with what a place has in the place of each {field}; {{ and }} are braces. Errors (usage): a field
// that the place does not have; a brace alone.
Result<std::string> with_fields(const std::string& text, const BatchPlace& place, bool is_file_name);

}  // namespace oro

// What a user must know of the values that were read: in words.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geo/sources/source.h"

namespace oro {

// Adds a line for each kind of finding (undeclared no data, heights that no terrain has, gaps, slopes that no
// terrain has); the same of several files is one line.
void note_values(std::span<const Source> sources, std::vector<std::string>& notes);

// Of sources whose posts are all void: that what they hold is no height in metres, to go on a sentence; ""
// where that is not why.
std::string why_no_height(std::span<const Source> sources);

// "a.tif", "a.tif and 11 more files".
std::string files_words(const std::string& first, std::size_t files);

}  // namespace oro

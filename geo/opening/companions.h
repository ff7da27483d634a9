// Files that lie beside elevation data and hold no heights: which of several sources are such, and how they
// are told of.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geo/sources/source.h"

namespace oro {

// A source that holds no heights, and why that is known: "holds slope, made of dem.tif; no elevation".
struct CompanionSource {
    std::size_t source{};  // its number
    std::string why;
};

// Those that by themselves may be heights, and by what lies over the same ground are none: what was made of
// another's heights on the same grid (slope, aspect, ...); whole numbers of 0 to 255 beside heights of
// another type (masks, counts, pictures); a file named like another with a word added ("_mask", "_error",
// ...); what contradicts a file on the same grid whose last word is dem, dsm or dtm, and has no such word
// itself. Files that the user named count only where they share the other's grid. Reads a few rows of files
// that share a grid; what cannot be read is no companion.
std::vector<CompanionSource> companions_among(std::span<const Source> sources);

// A file that was left out.
struct LeftOutFile {
    std::string path;
    std::string why;  // "holds radar amplitude (TanDEM-X DEM), no elevation"
};
// One note on all of them, with their names (of many the first 32) and what they hold; "" for none.
std::string note_of_left_out(std::span<const LeftOutFile> files);
// One note on sources of bytes that are taken for heights; "" for none.
std::string note_of_bytes(std::span<const Source> sources);

}  // namespace oro

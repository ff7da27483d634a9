// Whether the features of a vector file lie where the elevation data do.
#pragma once

#include <string>

#include "geo/region/region.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// One line, with the file's name: none of its features lies in the box of a grid of the region, or most would
// with latitude and longitude swapped, and do not without. "": neither.
std::string note_of_place(const VectorFile& file, const Region& region);

}  // namespace oro

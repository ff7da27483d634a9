// Land cover that a file has as polygons.
#pragma once

#include <string>

#include "geo/cover/cover_source.h"

namespace oro {

// Whether a file is of a format of vectors, by its name.
bool is_vector_file(const std::string& file);

// Reads polygons whose field `code_18`, `code_12`, `code_06`, `code_00`, `clc_code`, `code`, `class`,
// `gridcode`, `value` or `dn` (the first of these that they have) is a class's code, and draws them as cells
// of latitude and longitude, the later ones over the earlier ones: a cell has the polygon that its middle
// lies in. Edges go the shorter way round the Earth; a ring that goes once round it is closed over the nearer
// pole. Cells are 5 m, or so long that the longer side has 8,192 of them; a note says how long. Errors:
// those of read_vectors(); no polygon; no such field; a code that is no whole number from 0 to 65,534.
Result<CoverSource> open_cover_polygons(const std::string& file);

}  // namespace oro

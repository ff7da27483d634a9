// The table of public sources: that of the program, and what users add to it.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/fetch/tile_layout.h"

namespace oro {

// The layouts of a JSON text; `where` is its file, for messages. Errors: what is wrong in it.
Result<std::vector<TileLayout>> tile_layouts_from(const std::string& text, const std::string& where);

// The layouts of the program's own table (sources/sources.json of its data), of sources.json in the user's
// folder of settings where that is there, and of `file` unless it is "". Of layouts of one name the last
// counts. Sorted by name. Errors: a file that cannot be read or holds something else.
Result<std::vector<TileLayout>> read_tile_layouts(const std::string& file);

}  // namespace oro

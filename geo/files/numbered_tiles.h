// Folders of tiles, A/B/C.EXTENSION with numbers for A, B and C, and one file that tells of them. Of tilesets
// some words may stand for A, too, and there may be one folder more or less.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// Whether a folder that is there holds nothing but tiles with that extension (".png") and a file `index`
// ("tiles.json"), so that it may be replaced; `also`: the words for A; none: of no tileset. Errors (failed):
// a file or folder that is neither, by name.
Result<void> check_holds_tiles_alone(const std::string& folder, const std::string& extension,
                                     const std::string& index, const std::vector<std::string>& also = {});

}  // namespace oro

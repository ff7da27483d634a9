// Land cover laid over a region: the tiles that the GPU gets of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/drape/cover_tiles.h"
#include "geo/cover/cover_map.h"

namespace oro {

// Tiles of a map of land cover over a grid; the map stays with them. A texel of the finest level has the
// class of the pixel that its middle lies in; coarser ones shares of up to 16 x 16 pixels evenly within them.
// `outside` names the files that lie nowhere over the grid. Errors: a CRS that PROJ knows no way to.
Result<std::unique_ptr<CoverTiles>> cover_over(const PostGrid& grid, std::shared_ptr<const CoverMap> map,
                                               std::vector<std::string>& outside);

}  // namespace oro

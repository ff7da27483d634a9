// Tiles of the real data as one region.
#pragma once

#include "geo/opening/open_region.h"
#include "geo/region/region.h"
#include "tests/support/test_data.h"

namespace oro::test {

// Of a folder of the real data, which must be there; tiles as parse_tile_range() takes them.
inline Result<Region> open_tiles(const char* folder, const char* tiles) {
    RegionRequest request;
    request.paths = {real_data(folder)->string()};
    request.box = *parse_tile_range(tiles);
    return open_region(request);
}

}  // namespace oro::test

// The grids of a region as the ground of a tileset: what finer grids cover is cut out of them, and what is
// between them lies beside them.
#pragma once

#include <deque>
#include <memory>

#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/tilesets/ground_tileset.h"

namespace oro {

class RegionTiles {
  public:
    // The same surface as RegionGround has: cut_regions(). `region` outlives it. Grids have no sources, facts
    // and errors yet. threads: of building clusters, which grids that nothing is cut out of have where they
    // were baked with them. Errors: those of cut_regions(); posts that cannot be read.
    static Result<std::unique_ptr<RegionTiles>> of(const Region& region, int threads);
    RegionTiles(const RegionTiles&) = delete;
    RegionTiles& operator=(const RegionTiles&) = delete;

    // Which finer grids cut a part out of, and so are others than the data's.
    [[nodiscard]] bool is_cut(std::size_t grid) const { return cut_[grid].has_value(); }
    TilesetGround ground;

  private:
    RegionTiles() = default;
    std::deque<std::optional<HeightField>> cut_;  // of each grid, where something is cut out
};

}  // namespace oro

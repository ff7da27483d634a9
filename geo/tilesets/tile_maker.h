// The tiles of a grid of a tileset, made from its ground or taken from those that are kept. Within tilesets.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "geo/tilesets/cut_rims.h"
#include "geo/tilesets/ground_tileset.h"
#include "geo/tilesets/tile_bounds.h"

namespace oro {

class TileMaker {
  public:
    // Both stay where they are.
    TileMaker(const TilesetGrid& grid, const TilesetRequest& request);

    [[nodiscard]] const TilesetLayout& layout() const { return layout_; }
    [[nodiscard]] const TilesetGrid& grid() const { return grid_; }
    // Whether a tile is one of the request's part.
    [[nodiscard]] bool is_own(std::size_t number) const {
        return number % static_cast<std::size_t>(request_.parts) == static_cast<std::size_t>(request_.part);
    }
    // Whether all tiles of the part are kept, so that the ground is not needed.
    [[nodiscard]] bool all_kept() const;
    // Gets the ground. Errors: its own.
    Result<void> begin();
    // After begin(): of all its tiles.
    [[nodiscard]] EdgeBound bound() const { return bounds_->whole(); }
    // What other grids have beside this one; before tiles are asked for.
    void lay_beside(const EdgeBound& others) { others_ = others; }
    // Before tiles of a level are asked for.
    void begin_level(int level);
    // From several threads. Without begin() all tiles are kept.
    [[nodiscard]] Result<KeptTile> tile(const TileIndex& tile) const;

  private:
    [[nodiscard]] Result<KeptTile> made(const TileIndex& tile) const;

    const TilesetGrid& grid_;
    const TilesetRequest& request_;
    std::optional<KeptTiles> kept_;
    TilesetLayout layout_;
    std::unique_ptr<ClusteredGround> ground_;
    std::vector<LevelCut> cuts_;
    std::optional<TileBounds> bounds_;
    std::optional<EdgeBound> others_;
    CutRims rims_;                    // of the level
    std::vector<glm::vec3> normals_;  // ... likewise
};

// From a post to the next, at most, metres.
double largest_spacing_m(const PostGrid& grid);

}  // namespace oro

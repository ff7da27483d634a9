// How far the ground of a tile is from the surface, at most, and how deep the walls around it must reach.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "geo/tilesets/clustered_ground.h"
#include "geo/tilesets/level_cut.h"
#include "geo/tilesets/tileset_layout.h"

namespace oro {

// The walls of a tile along its northern, eastern, southern and western edge, and along the rims that other
// grids go on from (CutRims): so far they reach down from the edge, and so far outwards at their foot. 0
// where there is no neighbour, and so no wall.
struct TileWalls {
    static constexpr std::size_t rim = 4;
    std::array<double, 5> down_m{};
    std::array<double, 5> out_m{};
};

// What the edges of some ground may be off where it is drawn.
struct EdgeBound {
    double error_m{-1.0};  // none: nothing is drawn
    // Between which heights above the ellipsoid its posts lie.
    double lowest_h_m{std::numeric_limits<double>::infinity()};
    double highest_h_m{-std::numeric_limits<double>::infinity()};
    double beside_m{};   // how far edges may be beside each other: sag and step
    double steepness{};  // of the steepest triangle: what falls on a way of 1

    // Makes it hold for what another one is of, too.
    void widen(const EdgeBound& by) {
        error_m = std::max(error_m, by.error_m);
        lowest_h_m = std::min(lowest_h_m, by.lowest_h_m);
        highest_h_m = std::max(highest_h_m, by.highest_h_m);
        beside_m = std::max(beside_m, by.beside_m);
        steepness = std::max(steepness, by.steepness);
    }
};
// How far a wall from an edge of `own` must reach down and outwards, so that nothing opens between it and the
// edge of `other` beside it: two edges are off the surface by their errors at most, so the sum of these is
// deep enough where both lie above one line. They are beside each other by their sags; the wall leans
// outwards by twice as much, and reaches as much deeper as ground of the other's steepness falls on that way,
// but not below all of it.
struct WallReach {
    double down_m{}, out_m{};
};
WallReach wall_reach(const EdgeBound& own, const EdgeBound& other);

// How far a flat triangle between posts that reaches over so many rows and columns lies from the one that is
// linear in row, column and height, at most, in metres. dh_m: how much higher one of its corners is than
// another.
double flat_triangle_sag_m(const PostGrid& grid, double rows, double columns, double highest_h_m,
                           double dh_m);

// The bounds of the tiles of a grid, each drawn alone by flat triangles whose corners are rounded to steps
// along three axes at right angles. 64 bytes a tile.
class TileBounds {
  public:
    // cuts: by level. `layout` outlives them.
    static TileBounds of(const ClusteredGround& ground, const TilesetLayout& layout,
                         const std::vector<LevelCut>& cuts);

    // Whether the tile has a triangle.
    [[nodiscard]] bool drawn(const TileIndex& tile) const { return at(tile).error_m >= 0.0; }
    // Of one that is drawn: upper bound, metres, of the distance in space between a point of the surface
    // (TrueSurface: height linear in row and column over each triangle) and the point of the tile at the same
    // row and column. In it are the errors of the groups of clusters that the tile has triangles of, the sag
    // of the surface's own triangles, the steps of drawn heights, and the rounding of positions. At least
    // those of the tiles that refine it.
    [[nodiscard]] double error_m(const TileIndex& tile) const { return at(tile).error_m; }
    // What error_m() has beside the errors of groups, where the ground lies below highest_h_m and within
    // rise_m.
    static double added_m(const PostGrid& grid, double highest_h_m, double rise_m, double step_m);
    // Walls that close what may open to any neighbour that a viewer can draw beside this tile: one of the
    // same level, those below that, or one of a coarser level that does not cover this tile (wall_reach()).
    // other_grids: what is beside the grid's rims, on any level; null: nothing, and there are no such walls.
    [[nodiscard]] TileWalls walls(const TileIndex& tile, const EdgeBound* other_grids = nullptr) const;
    // Of all tiles.
    [[nodiscard]] EdgeBound whole() const;

  private:
    explicit TileBounds(const TilesetLayout& layout) : layout_(&layout) {}
    [[nodiscard]] const EdgeBound& at(const TileIndex& tile) const {
        return levels_[static_cast<std::size_t>(tile.level)][layout_->number(tile)];
    }
    [[nodiscard]] EdgeBound bound_of(const ClusteredGround& ground, const LevelCut& cut,
                                     const TileIndex& tile) const;
    // The tile across an edge of what covers `tile` on a level at or above its own; nothing where none is.
    [[nodiscard]] std::optional<TileIndex> across(const TileIndex& tile, int level, std::size_t edge) const;

    const TilesetLayout* layout_;
    bool wraps_longitude_{};
    std::vector<std::vector<EdgeBound>> levels_;
};

}  // namespace oro

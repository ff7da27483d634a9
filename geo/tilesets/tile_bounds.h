// How far the ground of a tile is from the surface, at most, and how deep the walls around it must reach.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "geo/tilesets/clustered_ground.h"
#include "geo/tilesets/level_cut.h"
#include "geo/tilesets/tileset_layout.h"

namespace oro {

// The walls of a tile along its northern, eastern, southern and western edge: so far they reach down from the
// edge, and so far outwards at their foot. 0 where there is no neighbour, and so no wall.
struct TileWalls {
    std::array<double, 4> down_m{};
    std::array<double, 4> out_m{};
};

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
    // same level, those below that, or one of a coarser level that does not cover this tile. Two edges are
    // off the surface by their tiles' errors at most, so their sum is deep enough where both lie above one
    // line. They are beside each other by their sags; walls lean outwards by twice as much, and reach as much
    // deeper as ground of the neighbour's steepness falls on that way, but not below all of it.
    [[nodiscard]] TileWalls walls(const TileIndex& tile) const;

  private:
    struct Bound {
        double error_m{-1.0};  // of this tile and all below it; none: nothing is drawn
        // Between which heights above the ellipsoid posts of it and of all below it lie.
        double lowest_h_m{std::numeric_limits<double>::infinity()};
        double highest_h_m{-std::numeric_limits<double>::infinity()};
        double beside_m{};   // how far edges may be beside each other: sag and step; of all below it, too
        double steepness{};  // of the steepest triangle: what falls on a way of 1; of all below it, too
    };
    explicit TileBounds(const TilesetLayout& layout) : layout_(&layout) {}
    [[nodiscard]] const Bound& at(const TileIndex& tile) const {
        return levels_[static_cast<std::size_t>(tile.level)][layout_->number(tile)];
    }
    [[nodiscard]] Bound bound_of(const ClusteredGround& ground, const LevelCut& cut,
                                 const TileIndex& tile) const;
    // The tile across an edge of what covers `tile` on a level at or above its own; nothing where none is.
    [[nodiscard]] std::optional<TileIndex> across(const TileIndex& tile, int level, std::size_t edge) const;

    const TilesetLayout* layout_;
    bool wraps_longitude_{};
    std::vector<std::vector<Bound>> levels_;
};

}  // namespace oro

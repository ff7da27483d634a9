#include "geo/tilesets/tile_bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geo/tilesets/post_place.h"

namespace oro {
namespace {

// Above the radii of curvature anywhere. Source: wgs84_a_m^2 / wgs84_b_m, at a pole.
constexpr double largest_radius_m = 6399594.0;
// Three coordinates that are half a step off: sqrt(3) / 2, rounded up.
constexpr double rounded_share = 0.8661;

// The largest of a tile's triangles.
struct Largest {
    double rows{}, columns{}, rise_m{};  // each by itself
    double steepness{};
};

}  // namespace

// As in core/lod/node_deviations.cpp, with both radii of curvature at their largest.
double flat_triangle_sag_m(const PostGrid& grid, double rows, double columns, double highest_h_m,
                           double dh_m) {
    const double both = rows * grid.row_step_rad() + columns * grid.column_step_rad();
    const double radius_m = largest_radius_m + std::max(0.0, highest_h_m);
    if (grid.net)
        return 0.125 * (grid.net->bend() * radius_m * both * both + 2.02 * dh_m * both +
                        2.0 * grid.net->kink() * radius_m * both);
    return 0.125 * 1.0001 * (radius_m * both * both + 2.0 * dh_m * both);
}

double TileBounds::added_m(const PostGrid& grid, double highest_h_m, double rise_m, double step_m) {
    return flat_triangle_sag_m(grid, 1.0, 1.0, highest_h_m, rise_m) + 0.5 * height_step_m +
           rounded_share * step_m;
}

EdgeBound TileBounds::bound_of(const ClusteredGround& ground, const LevelCut& cut,
                               const TileIndex& tile) const {
    EdgeBound bound;
    Largest largest;
    double error_m = -1.0;
    for (const std::uint32_t number : cut.tiles[layout_->number(tile)]) {
        error_m = std::max(error_m, static_cast<double>(cut.errors_m[number]));
        std::array<SurfaceVertex, 3> corners;
        std::array<glm::dvec3, 3> at_m;
        for (std::size_t i = 0; i < 3; ++i) {
            corners[i] = ground.surface().vertex(cut.triangles[number][i]);
            at_m[i] = ground.ecef(corners[i]).m;
        }
        const auto [north, south] = std::minmax({corners[0].row, corners[1].row, corners[2].row});
        const auto [west, east] = std::minmax({corners[0].column, corners[1].column, corners[2].column});
        const auto [low, high] = std::minmax({corners[0].steps, corners[1].steps, corners[2].steps});
        bound.lowest_h_m = std::min(bound.lowest_h_m, low * height_step_m);
        bound.highest_h_m = std::max(bound.highest_h_m, high * height_step_m);
        largest.rows = std::max<double>(largest.rows, south - north);
        largest.columns = std::max<double>(largest.columns, east - west);
        largest.rise_m = std::max(largest.rise_m, (high - low) * height_step_m);
        const glm::dvec3 normal = glm::cross(at_m[2] - at_m[0], at_m[1] - at_m[0]);
        const double up = glm::dot(normal, glm::normalize(at_m[0]));
        if (up > 0.0) largest.steepness = std::max(largest.steepness, glm::length(normal) / up);
    }
    if (error_m < 0.0) return bound;
    const double rise_m = bound.highest_h_m - bound.lowest_h_m + 2.0 * error_m;
    // The surface's own triangles lie within the error of the tile's heights.
    bound.error_m = error_m + added_m(ground.grid(), bound.highest_h_m + error_m, rise_m, cut.step_m);
    bound.beside_m =
        flat_triangle_sag_m(ground.grid(), largest.rows, largest.columns, bound.highest_h_m, largest.rise_m) +
        cut.step_m;
    bound.steepness = largest.steepness;
    for (int i = 0; tile.level > 0 && i < 4; ++i) {
        const TileIndex child{2 * tile.row + i / 2, 2 * tile.column + i % 2, tile.level - 1};
        if (child.row >= layout_->rows(child.level) || child.column >= layout_->columns(child.level))
            continue;
        bound.widen(at(child));
    }
    return bound;
}

TileBounds TileBounds::of(const ClusteredGround& ground, const TilesetLayout& layout,
                          const std::vector<LevelCut>& cuts) {
    TileBounds bounds(layout);
    bounds.wraps_longitude_ = ground.grid().wraps_longitude();
    for (int level = 0; level < layout.levels(); ++level) {
        std::vector<EdgeBound>& all = bounds.levels_.emplace_back();
        all.reserve(layout.count(level));
        for (std::size_t number = 0; number < layout.count(level); ++number)
            all.push_back(
                bounds.bound_of(ground, cuts[static_cast<std::size_t>(level)], layout.tile(number, level)));
    }
    return bounds;
}

std::optional<TileIndex> TileBounds::across(const TileIndex& tile, int level, std::size_t edge) const {
    // North, east, south, west.
    constexpr std::array<std::array<int, 2>, 4> steps{{{-1, 0}, {0, 1}, {1, 0}, {0, -1}}};
    const auto [down, right] = steps[edge];
    const int up = level - tile.level;
    const int columns = layout_->columns(level);
    const TileIndex above{tile.row >> up, tile.column >> up, level};
    TileIndex other{above.row + down, above.column + right, level};
    const bool round = tile.column + right < 0 || tile.column + right >= layout_->columns(tile.level);
    // Where the edge is not one of the tile above, that tile covers both sides.
    if (!round && ((tile.row + down) >> up != other.row || (tile.column + right) >> up != other.column))
        return std::nullopt;
    if (round && wraps_longitude_) other.column = right < 0 ? columns - 1 : 0;
    if (other.row < 0 || other.row >= layout_->rows(level) || other.column < 0 || other.column >= columns ||
        other == above)
        return std::nullopt;
    return other;
}

WallReach wall_reach(const EdgeBound& own, const EdgeBound& other) {
    WallReach reach;
    reach.out_m = 2.0 * (own.beside_m + other.beside_m);
    reach.down_m = own.error_m + other.error_m +
                   std::min(1.5 * reach.out_m * other.steepness,
                            std::max(0.0, own.highest_h_m - other.lowest_h_m) + other.beside_m);
    return reach;
}

TileWalls TileBounds::walls(const TileIndex& tile, const EdgeBound* other_grids) const {
    TileWalls walls;
    const EdgeBound& own = at(tile);
    if (own.error_m < 0.0) return walls;
    const auto set = [&](std::size_t edge, const EdgeBound& other) {
        if (other.error_m < 0.0) return;
        const WallReach reach = wall_reach(own, other);
        walls.down_m[edge] = reach.down_m;
        walls.out_m[edge] = reach.out_m;
    };
    for (std::size_t edge = 0; edge < TileWalls::rim; ++edge) {
        EdgeBound other;
        for (int level = tile.level; level < layout_->levels(); ++level) {
            const std::optional<TileIndex> index = across(tile, level, edge);
            if (!index) break;
            other.widen(at(*index));
        }
        set(edge, other);
    }
    if (other_grids != nullptr) set(TileWalls::rim, *other_grids);
    return walls;
}

EdgeBound TileBounds::whole() const {
    EdgeBound whole;
    for (const std::vector<EdgeBound>& level : levels_)
        for (const EdgeBound& bound : level) whole.widen(bound);
    return whole;
}

}  // namespace oro

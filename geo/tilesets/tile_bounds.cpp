#include "geo/tilesets/tile_bounds.h"

#include <algorithm>
#include <cmath>

#include "core/lod/levels_gpu.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/level_grid.h"
#include "core/terrain/post_spacing.h"

namespace oro {
namespace {

// Above the radii of curvature anywhere. Source: wgs84_a_m^2 / wgs84_b_m, at a pole.
constexpr double largest_radius_m = 6399594.0;
// Three coordinates that are half a step off: sqrt(3) / 2, rounded up.
constexpr double rounded_share = 0.8661;
// See TileBounds::step_m().
double step_of_m(double certified_m, double post_m, double radius_m) {
    constexpr double finest_m = 0x1.0p-11, coarsest_of_posts_m = 0x1.0p-4, share = 0x1.0p-10;
    // A post is no farther from the sphere's centre than this, and a coordinate has 23 bits and a sign.
    const double least_m = 2.0 * radius_m * 0x1.0p-22;
    const double wanted_m =
        std::max({finest_m, std::min(coarsest_of_posts_m, share * post_m), share * certified_m});
    return std::max(std::exp2(std::floor(std::log2(wanted_m))), std::exp2(std::ceil(std::log2(least_m))));
}

// Where the page's posts are closest to each other.
PostSpacing post_spacing_at_page(const PostGrid& grid, const PageIndex& page) {
    const LevelGrid level = level_grid(grid, page.level);
    constexpr int page_quads = static_cast<int>(gpu::page_quads);
    const auto ends = [](const LevelAxis& axis, int number) {
        return std::array{axis.region_post(number * page_quads),
                          axis.region_post(std::min((number + 1) * page_quads, axis.quads))};
    };
    constexpr double far_m = 1.0e9, turned = 0.5;  // a net's posts are nowhere twice as close as at corners
    PostSpacing closest{far_m, far_m};
    for (const int row : ends(level.row, page.row))
        for (const int column : ends(level.column, page.column)) {
            const PostSpacing apart = post_spacing_at(grid, row, column);
            closest = {std::min(closest.row_m, apart.row_m), std::min(closest.column_m, apart.column_m)};
        }
    return grid.net ? PostSpacing{turned * closest.row_m, turned * closest.column_m} : closest;
}

}  // namespace

// As in core/lod/node_deviations.cpp, with both radii of curvature at their largest.
double flat_triangle_sag_m(const PostGrid& grid, int level, double highest_h_m, double dh_m) {
    const double both = std::ldexp(grid.row_step_rad(), level) + std::ldexp(grid.column_step_rad(), level);
    const double radius_m = largest_radius_m + std::max(0.0, highest_h_m);
    if (grid.net)
        return 0.125 * (grid.net->bend() * radius_m * both * both + 2.02 * dh_m * both +
                        2.0 * grid.net->kink() * radius_m * both);
    return 0.125 * 1.0001 * (radius_m * both * both + 2.0 * dh_m * both);
}

const TileBounds::Bound& TileBounds::at(const PageIndex& page) const {
    return levels_[static_cast<std::size_t>(page.level)]
                  [pages_->layout(page.level).number(page.row, page.column)];
}

Result<TileBounds::Bound> TileBounds::bound_of(const PageIndex& page) const {
    ORO_TRY(const PageRecord record, pages_->record(page));
    const PageSummary& summary = record.summary;
    const PostGrid& grid = pages_->facts().grid;
    Bound bound;
    bound.drawn = summary.triangles > 0;
    const double certified_m = page.level == 0 ? 0.0 : static_cast<double>(summary.largest_error_m);
    const double dh_m = summary.highest_h_m - summary.lowest_h_m;
    const PostSpacing apart = post_spacing_at_page(grid, page);
    bound.post_m = std::min(apart.row_m, apart.column_m);
    const bool fits = certified_m < static_cast<double>(gpu::unfit_error_m);
    bound.step_m = step_of_m(fits ? certified_m : 0.0, bound.post_m, std::max(1.0, summary.radius_m));
    bound.beside_m = flat_triangle_sag_m(grid, page.level, summary.highest_h_m, dh_m) + bound.step_m;
    if (bound.drawn) bound.lowest_h_m = summary.lowest_h_m, bound.highest_h_m = summary.highest_h_m;
    // Of the pages below it.
    double error_m = 0.0, shown_error_m = -1.0;
    for (int i = 0; page.level > 0 && i < 4; ++i) {
        const PageIndex child{2 * page.row + i / 2, 2 * page.column + i % 2, page.level - 1};
        const PageLayout below = pages_->layout(child.level);
        if (child.row >= below.rows || child.column >= below.columns) continue;
        error_m = std::max(error_m, at(child).error_m);
        shown_error_m = std::max(shown_error_m, at(child).shown_error_m);
        bound.lowest_h_m = std::min(bound.lowest_h_m, at(child).lowest_h_m);
        bound.highest_h_m = std::max(bound.highest_h_m, at(child).highest_h_m);
        bound.post_m = std::min(bound.post_m, at(child).post_m);
    }
    if (!fits) {
        bound.error_m = unbounded_m;
        bound.shown_error_m = shown_error_m;
        return bound;
    }
    // The surface's own triangles lie within the certificate of the page's heights.
    const double surface_sag_m =
        flat_triangle_sag_m(grid, 0, summary.highest_h_m + certified_m, dh_m + 2.0 * certified_m);
    bound.error_m =
        std::max(error_m, certified_m + surface_sag_m + 0.5 * height_step_m + rounded_share * bound.step_m);
    if (bound.drawn) bound.shown_error_m = bound.error_m;
    return bound;
}

Result<TileBounds> TileBounds::of(const RegionPages& pages) {
    TileBounds bounds(pages);
    for (int level = 0; level < pages.levels(); ++level) {
        const PageLayout layout = pages.layout(level);
        std::vector<Bound>& all = bounds.levels_.emplace_back();
        all.reserve(layout.count());
        for (int row = 0; row < layout.rows; ++row) {
            for (int column = 0; column < layout.columns; ++column) {
                ORO_TRY(const Bound bound, bounds.bound_of({row, column, level}));
                all.push_back(bound);
            }
        }
    }
    return bounds;
}

std::optional<PageIndex> TileBounds::across(const PageIndex& page, int level, std::size_t edge) const {
    // North, east, south, west.
    constexpr std::array<std::array<int, 2>, 4> steps{{{-1, 0}, {0, 1}, {1, 0}, {0, -1}}};
    const auto [down, right] = steps[edge];
    const int up = level - page.level;
    const PageLayout finest = pages_->layout(page.level), layout = pages_->layout(level);
    const PageIndex above{page.row >> up, page.column >> up, level};
    PageIndex other{above.row + down, above.column + right, level};
    const bool round = page.column + right < 0 || page.column + right >= finest.columns;
    // Where the edge is not one of the page above, that page covers both sides.
    if (!round && ((page.row + down) >> up != other.row || (page.column + right) >> up != other.column))
        return std::nullopt;
    if (round && pages_->wraps_longitude()) other.column = right < 0 ? layout.columns - 1 : 0;
    if (other.row < 0 || other.row >= layout.rows || other.column < 0 || other.column >= layout.columns ||
        other == above)
        return std::nullopt;
    return other;
}

TileWalls TileBounds::walls(const PageIndex& page) const {
    TileWalls walls;
    const Bound& own = at(page);
    if (std::isinf(own.error_m)) return walls;
    for (std::size_t edge = 0; edge < walls.down_m.size(); ++edge) {
        double error_m = -1.0, beside_m = 0.0, steepness = 0.0, lowest_h_m = own.highest_h_m;
        for (int level = page.level; level < pages_->levels(); ++level) {
            const std::optional<PageIndex> index = across(page, level, edge);
            if (!index) break;
            const Bound& other = at(*index);
            if (other.shown_error_m < 0.0) continue;
            error_m = std::max(error_m, other.shown_error_m);
            beside_m = std::max(beside_m, other.beside_m);
            steepness = std::max(steepness, (other.highest_h_m - other.lowest_h_m) / other.post_m);
            lowest_h_m = std::min(lowest_h_m, other.lowest_h_m);
        }
        if (error_m < 0.0) continue;
        walls.out_m[edge] = 2.0 * (own.beside_m + beside_m);
        walls.down_m[edge] =
            own.error_m + error_m +
            std::min(1.5 * walls.out_m[edge] * steepness, own.highest_h_m - lowest_h_m + beside_m);
    }
    return walls;
}

}  // namespace oro

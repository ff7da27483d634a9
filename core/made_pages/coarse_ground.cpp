#include "core/made_pages/coarse_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/made/made_heights.h"

namespace oro {
namespace {

int posts_of_tile(int tile, int last) {
    const std::int64_t cells = std::min<std::int64_t>(CoarseGround::tile_cells,
                                                      last - std::int64_t{tile} * CoarseGround::tile_cells);
    return static_cast<int>((cells + (1 << CoarseGround::level) - 1) >> CoarseGround::level) + 1;
}

}  // namespace

CoarseGround::Tile CoarseGround::tile(int row, int column) const {
    const PostGrid& grid = region_.grid;
    const int last_row = grid.rows() - 1, last_column = grid.columns() - 1;
    Tile tile;
    tile.rows = posts_of_tile(row, last_row);
    tile.columns = posts_of_tile(column, last_column);
    const auto lat_deg = [&](int post) { return grid.lat.at_deg(region_post(row, post, last_row)); };
    const auto lon_deg = [&](int post) { return grid.lon.at_deg(region_post(column, post, last_column)); };
    const double north_deg = lat_deg(0), south_deg = lat_deg(tile.rows - 1);
    const auto nearest_deg = static_cast<std::size_t>(std::max({0.0, south_deg, -north_deg}));
    const MadeLevelBound& bound =
        region_.bounds_from_deg[std::min(nearest_deg, region_.bounds_from_deg.size() - 1)][level];
    const UndulationField& N = region_.undulation;
    std::tie(tile.lowest_N_m, tile.highest_N_m) =
        N.range_m(north_deg, south_deg, lon_deg(0), lon_deg(tile.columns - 1));
    tile.off_m = static_cast<float>(bound.coarse) + 0.1F;
    tile.lowest_H_m = static_cast<float>(made_step_m * region_.terrain.low) - 0.1F;
    tile.highest_H_m = static_cast<float>(made_step_m * region_.terrain.high) + 0.1F;
    std::vector<MadeColumn> columns;
    for (int i = 0; i < tile.columns; ++i)
        columns.push_back(made_column(region_.terrain.west + region_post(column, i, last_column),
                                      region_.terrain.posts_per_deg));
    std::vector<std::int32_t> steps(columns.size());
    tile.coarse_m.reserve(static_cast<std::size_t>(tile.rows) * columns.size());
    for (int i = 0; i < tile.rows; ++i) {
        made_row_of_octaves(region_.terrain, region_.rule, region_post(row, i, last_row), columns,
                            bound.coarse_octaves, steps);
        for (const std::int32_t step : steps)
            tile.coarse_m.push_back(static_cast<float>(made_step_m * static_cast<double>(step)));
    }
    return tile;
}

CoarseGround::Quarters CoarseGround::highest_of_quarters(int row, int column) const {
    const std::uint64_t number = static_cast<std::uint64_t>(row) << 32U | static_cast<std::uint64_t>(column);
    {
        const std::scoped_lock lock(mutex_);
        if (const auto found = highest_m_.find(number); found != highest_m_.end()) return found->second;
    }
    const Tile posts = tile(row, column);
    constexpr int half = (tile_posts - 1) / 2;
    Quarters highest_m;
    highest_m.fill(-std::numeric_limits<float>::infinity());
    for (int r = 0; r < posts.rows; ++r)
        for (int c = 0; c < posts.columns; ++c) {
            const float high_m = posts.high_m(static_cast<std::size_t>(r * posts.columns + c));
            for (int quarter = 0; quarter < 4; ++quarter) {
                const bool is_in =
                    (quarter < 2 ? r <= half : r >= half) && (quarter % 2 == 0 ? c <= half : c >= half);
                float& highest = highest_m[static_cast<std::size_t>(quarter)];
                if (is_in) highest = std::max(highest, high_m);
            }
        }
    const std::scoped_lock lock(mutex_);
    highest_m_.emplace(number, highest_m);
    return highest_m;
}

float CoarseGround::highest_m(int node_level, int row, int column) const {
    const int up = node_level - 3;
    const LevelGrid nodes = level_grid(region_.grid, 3);
    float highest = -std::numeric_limits<float>::infinity();
    const int last_row = std::min((row + 1) << up, nodes.row.nodes()) - 1,
              last_column = std::min((column + 1) << up, nodes.column.nodes()) - 1;
    for (int r = row << up; r <= last_row; ++r)
        for (int c = column << up; c <= last_column; ++c)
            highest = std::max(
                highest, highest_of_quarters(r / 2, c / 2)[static_cast<std::size_t>(2 * (r % 2) + c % 2)]);
    return highest;
}

}  // namespace oro

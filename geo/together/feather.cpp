#include "geo/together/feather.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "core/terrain/post_spacing.h"
#include "geo/together/coverage_rim.h"
#include "geo/together/cut_regions.h"

namespace oro {
namespace {

// Metres from post to post, along a column and along a row, at a row of the grid.
struct PostsApart {
    double row_m;
    double column_m;
};
PostsApart apart_at(const PostGrid& grid, int row) {
    if (grid.net) return {grid.net->row_m(), grid.net->column_m()};
    const PostSpacing spacing = post_spacing(grid, grid.lat.at_deg(row));
    return {spacing.row_m, spacing.column_m};
}

// Of each post how far the nearest one on the rim is, in metres; infinity from width_m on.
std::vector<float> rim_distances_m(const HeightField& field, double width_m) {
    const PostGrid& grid = field.grid;
    std::vector<float> distances(grid.post_count(), std::numeric_limits<float>::infinity());
    std::set<std::pair<int, int>> rim;
    for (const RimEdge& edge : coverage_rim(field)) {
        rim.insert({edge.from.row, edge.from.column});
        rim.insert({edge.to.row, edge.to.column});
    }
    for (const auto& [rim_row, rim_column] : rim) {
        const GridPost post{rim_row, rim_column};
        const PostsApart apart = apart_at(grid, post.row);
        const int down = static_cast<int>(width_m / apart.row_m),
                  right = static_cast<int>(width_m / apart.column_m);
        for (int row = std::max(0, post.row - down); row <= std::min(grid.rows() - 1, post.row + down);
             ++row) {
            for (int column = std::max(0, post.column - right);
                 column <= std::min(grid.columns() - 1, post.column + right); ++column) {
                const auto away_m = static_cast<float>(
                    std::hypot((row - post.row) * apart.row_m, (column - post.column) * apart.column_m));
                float& known =
                    distances[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
                              static_cast<std::size_t>(column)];
                if (static_cast<double>(away_m) < width_m) known = std::min(known, away_m);
            }
        }
    }
    return distances;
}

// A grid, and which of its posts finer ones cover: cells beside those are split as they are drawn.
struct GridBelow {
    RegionGrid* grid;
    std::vector<char> masked;
};

// H of the ground below a grid: that of the smallest rank among the greater ones.
std::optional<double> H_below_m(std::span<const GridBelow> below, const PostPlace& place) {
    for (const GridBelow& other : below)
        if (const auto H_m = other.grid->field.surface_H_m(place.lat_deg, place.lon_deg,
                                                           other.masked.empty() ? nullptr : &other.masked))
            return H_m;
    return std::nullopt;
}

void feather_grid(RegionGrid& of, std::span<const GridBelow> below, double width_m) {
    const PostGrid& grid = of.field.grid;
    const std::vector<float> distances = rim_distances_m(of.field, width_m);
    Feathered summary{width_m, 0, 0.0, 0.0};
    std::vector<float> changed = of.field.H_m;
    double squares = 0.0;
    for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
            const std::size_t post =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
                static_cast<std::size_t>(column);
            if (std::isinf(distances[post]) || is_void(of.field.H_m[post])) continue;
            const auto H_m = H_below_m(below, grid.place_at(row, column));
            if (!H_m) continue;
            const double share = static_cast<double>(distances[post]) / width_m,
                         weight = share * share * (3.0 - 2.0 * share),
                         own_m = static_cast<double>(changed[post]);
            changed[post] = static_cast<float>(std::lerp(*H_m, own_m, weight));
            const double by_m = std::abs(static_cast<double>(changed[post]) - own_m);
            ++summary.posts;
            summary.most_m = std::max(summary.most_m, by_m);
            squares += by_m * by_m;
        }
    }
    of.field.H_m = std::move(changed);
    if (summary.posts == 0) return;
    summary.rms_m = std::sqrt(squares / static_cast<double>(summary.posts));
    of.feathered = summary;
    char note[200];
    std::snprintf(
        note, sizeof note,
        "--feather: %llu posts within %g m of a rim go over to the heights below, changed by up to %.2f m "
        "(RMS %.2f m)",
        static_cast<unsigned long long>(summary.posts), width_m, summary.most_m, summary.rms_m);
    of.notes.emplace_back(note);
}

}  // namespace

// The coarsest first: what lies below a grid is then as it is drawn. Heights change, and where there are any
// does not: so neither does what is cut out.
Result<void> feather(Region& region, double width_m) {
    std::vector<GridBelow> grids;
    for (RegionGrid& grid : region.grids) grids.push_back({&grid, {}});
    std::ranges::stable_sort(grids, {}, [](const GridBelow& one) { return one.grid->rank; });
    for (GridBelow& one : grids) {
        ORO_TRY(GridClip cut, cut_of(region, *one.grid));
        one.masked = std::move(cut.masked_posts);
    }
    for (std::size_t i = grids.size() - 1; i-- > 0;)
        feather_grid(*grids[i].grid, std::span(grids).subspan(i + 1), width_m);
    return region.health();
}

}  // namespace oro

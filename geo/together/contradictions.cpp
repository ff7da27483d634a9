#include "geo/together/contradictions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "geo/posts/seams.h"
#include "geo/together/cut_regions.h"

namespace oro {
namespace {

struct Shared {
    int places{}, contradicting{};
    double largest_m{};
};

// By how much a height is beyond those of the four posts around a place; nothing where these have none.
std::optional<double> beyond_cell_m(const HeightField& field, double lat_deg, double lon_deg, double H_m) {
    const PostNumber at = field.grid.post_at(lat_deg, lon_deg);
    if (!(at.row >= 0.0 && at.column >= 0.0 && at.row <= field.grid.rows() - 1 &&
          at.column <= field.grid.columns() - 1))
        return std::nullopt;
    const int row = std::min(static_cast<int>(at.row), field.grid.rows() - 2);
    const int column = std::min(static_cast<int>(at.column), field.grid.columns() - 2);
    double lowest_m = 0.0, highest_m = 0.0;
    for (int corner = 0; corner < 4; ++corner) {
        const float post_m = field.H_at_post_m(row + corner / 2, column + corner % 2);
        if (is_void(post_m)) return std::nullopt;
        const auto corner_m = static_cast<double>(post_m);
        lowest_m = corner == 0 ? corner_m : std::min(lowest_m, corner_m);
        highest_m = corner == 0 ? corner_m : std::max(highest_m, corner_m);
    }
    return std::max({0.0, lowest_m - H_m, H_m - highest_m});
}

Shared shared_places(const HeightField& finer, const HeightField& coarser) {
    constexpr int most = 32;
    const int rows = finer.grid.rows(), columns = finer.grid.columns();
    const int down = std::min(most, rows), across = std::min(most, columns);
    Shared shared;
    for (int i = 0; i < down * across; ++i) {
        const int row = static_cast<int>((2 * std::int64_t{i / across} + 1) * rows / (2 * down));
        const int column = static_cast<int>((2 * std::int64_t{i % across} + 1) * columns / (2 * across));
        const float H_m = finer.H_at_post_m(row, column);
        if (is_void(H_m)) continue;
        const PostPlace place = finer.grid.place_at(row, column);
        const auto beyond_m = beyond_cell_m(coarser, place.lat_deg, place.lon_deg, static_cast<double>(H_m));
        if (!beyond_m) continue;
        ++shared.places;
        shared.contradicting += *beyond_m > contradiction_m ? 1 : 0;
        shared.largest_m = std::max(shared.largest_m, *beyond_m);
    }
    return shared;
}

bool boxes_meet(const PostGrid& one, const PostGrid& other) {
    if (one.north_deg() < other.south_deg() || other.north_deg() < one.south_deg()) return false;
    for (const double turn_deg : {-360.0, 0.0, 360.0})
        if (one.west_deg() + turn_deg <= other.east_deg() && other.west_deg() <= one.east_deg() + turn_deg)
            return true;
    return false;
}

std::string name_of(const RegionGrid& grid) {
    if (grid.sources.empty()) return "a grid";
    const std::string first = grid.sources.front().path;
    return grid.sources.size() == 1
               ? first
               : first + " and " + std::to_string(grid.sources.size() - 1) + " files of its grid";
}

}  // namespace

std::string note_of_contradicting_grids(const Region& region) {
    constexpr std::size_t most_grids = 64;
    constexpr double like_spacing = 4.0;
    constexpr int least_places = 16;
    const std::vector<RegionGrid>& grids = region.grids;
    if (grids.size() < 2 || grids.size() > most_grids) return "";
    std::string pairs;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        for (std::size_t k = i + 1; k < grids.size(); ++k) {
            const RegionGrid* finer = &grids[i];
            const RegionGrid* coarser = &grids[k];
            if (finer->field.grid.row_step_rad() > coarser->field.grid.row_step_rad())
                std::swap(finer, coarser);
            const PostGrid& fine = finer->field.grid;
            if (coarser->field.grid.row_step_rad() > like_spacing * fine.row_step_rad()) continue;
            if (!boxes_meet(fine, coarser->field.grid)) continue;
            const Shared shared = shared_places(finer->field, coarser->field);
            if (shared.places < least_places || 2 * shared.contradicting <= shared.places) continue;
            char by[40];
            std::snprintf(by, sizeof by, ", up to %.1f m", shared.largest_m);
            pairs += (pairs.empty() ? "" : "; ") + name_of(*finer) + " and " + name_of(*coarser) + by;
        }
    }
    if (pairs.empty()) return "";
    return "files contradict each other by more than 16 m at most of the places that both have: " + pairs +
           "; one holds no elevation, or counts in another unit or from another datum, or lies elsewhere";
}

}  // namespace oro

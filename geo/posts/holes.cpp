#include "geo/posts/holes.h"

#include <cmath>
#include <set>
#include <utility>

#include "geo/places/bounding_box.h"

namespace oro {
namespace {

// Whole degrees at or below each post of an axis; the last post of a cell belongs to it where the axis ends
// there.
std::vector<int> cells_of(const GridAxis& axis) {
    constexpr double line_deg = 1e-7;
    const double last_deg = std::max(axis.at_deg(0), axis.at_deg(axis.count - 1));
    const int last_cell = static_cast<int>(std::ceil(last_deg - line_deg)) - 1;
    std::vector<int> cells;
    for (int i = 0; i < axis.count; ++i)
        cells.push_back(std::min(last_cell, static_cast<int>(std::floor(axis.at_deg(i) + line_deg))));
    return cells;
}

}  // namespace

Uncovered count_uncovered(const HeightField& field, const std::vector<std::string>& missing_cells,
                          const std::function<bool(std::size_t post)>& covered) {
    std::set<std::pair<int, int>> missing;
    for (const std::string& name : missing_cells) {
        if (const auto box = parse_tile_range(name); box.ok())
            missing.insert({static_cast<int>(box->south_deg), static_cast<int>(box->west_deg)});
    }
    const std::vector<int> lat_cells = cells_of(field.grid.lat), lon_cells = cells_of(field.grid.lon);
    Uncovered counts;
    std::vector<unsigned char> in_missing(lon_cells.size());
    for (std::size_t row = 0, post = 0; row < lat_cells.size(); ++row) {
        if (row == 0 || lat_cells[row] != lat_cells[row - 1]) {
            for (std::size_t c = 0; c < lon_cells.size(); ++c)
                in_missing[c] = missing.contains(
                    {lat_cells[row], lon_cells[c] >= 180 ? lon_cells[c] - 360 : lon_cells[c]});
        }
        for (std::size_t c = 0; c < lon_cells.size(); ++c, ++post) {
            if (!is_void(field.H_m[post]) || covered(post)) continue;
            ++(in_missing[c] ? counts.in_missing : counts.outside);
        }
    }
    return counts;
}

}  // namespace oro

#include "geo/posts/source_at.h"

#include <algorithm>
#include <cmath>

#include "geo/posts/seams.h"

namespace oro {
namespace {

// True for a place in a source's box, or no more than `beyond` of its posts' spacings outside it.
bool holds(const SourceReport& source, double lat_deg, double lon_deg, double beyond) {
    const double margin_lat_deg = beyond * source.lat_spacing_deg,
                 margin_lon_deg = beyond * source.lon_spacing_deg;
    const BoundingBox& box = source.box;
    if (!(lat_deg >= box.south_deg - margin_lat_deg && lat_deg <= box.north_deg + margin_lat_deg))
        return false;
    double width_deg = box.east_deg - box.west_deg;
    if (width_deg < 0.0) width_deg += 360.0;
    // East of the western margin, in [0, 360): a place and its box may be written in different turns.
    const double from_west_deg = lon_deg - (box.west_deg - margin_lon_deg);
    const double east_deg = from_west_deg - 360.0 * std::floor(from_west_deg / 360.0);
    // In another turn, a place on the western rim can come out a rounding short of it.
    constexpr double rounding_deg = 1e-12;
    return east_deg <= width_deg + 2.0 * margin_lon_deg + rounding_deg || east_deg >= 360.0 - rounding_deg;
}

// The same by the posts themselves, where it is known which they are.
bool holds_place(const RegionGrid& grid, const SourceReport& source, double lat_deg, double lon_deg,
                 double beyond) {
    if (!source.part) return holds(source, lat_deg, lon_deg, beyond);
    const PostNumber post = grid.field.grid.post_at(lat_deg, lon_deg);
    const double down = post.row - source.part->row, right = post.column - source.part->column;
    const double slack = std::max(beyond, 1e-6);
    return down >= -slack && down <= source.part->rows - 1 + slack && right >= -slack &&
           right <= source.part->columns - 1 + slack;
}

}  // namespace

const SourceReport* source_at(const RegionGrid& grid, double lat_deg, double lon_deg) {
    constexpr double half_a_cell = 0.5 + 1e-6;
    for (const double beyond : {0.0, half_a_cell}) {
        std::vector<const SourceReport*> around;
        std::vector<Precedence> ranks;
        for (const SourceReport& source : grid.sources) {
            if (!holds_place(grid, source, lat_deg, lon_deg, beyond)) continue;
            around.push_back(&source);
            ranks.push_back(precedence_of(source));
        }
        if (!around.empty()) return around[by_precedence(ranks).front()];
    }
    return nullptr;
}

}  // namespace oro

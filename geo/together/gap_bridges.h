// Ground between grids that lie next to each other with a gap of about a post.
#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/together/coverage_rim.h"

namespace oro {

// A post of one of a region's grids, by the grid's number.
struct BridgePost {
    std::size_t grid{};
    GridPost post{};
    bool operator==(const BridgePost&) const = default;
};

// Anticlockwise, seen from above; its corners are posts on the rims of two grids.
struct GapBridge {
    std::array<BridgePost, 3> posts;
};

// Rims that are farther apart than so many posts, of the coarser grid, stay apart.
inline constexpr double widest_gap_posts = 2.0;

// What joins the rims of a region's grids where they are no farther apart than that, and no grid has ground
// between them: tiles whose posts are the middles of their cells, two UTM zones that meet. It holds no height
// that the data do not. Takes each post of grids that lie near others once. Errors: what GEOS says.
Result<std::vector<GapBridge>> gap_bridges(const Region& region);

}  // namespace oro

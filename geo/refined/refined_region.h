// Ground between the posts near an eye: one more grid of a region, which lies over that of the data.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "geo/cover/cover_map.h"
#include "geo/region/region.h"

namespace oro {

// Where ground is invented between posts, and how dense its posts are.
struct DetailRequest {
    int halvings{1};  // 1 to 6
    double lat_deg{};
    double lon_deg{};
    // How far from that place, in metres towards each side; nothing: usual_detail_m, or as far as most_posts
    // allow.
    std::optional<double> radius_m;
};
inline constexpr double usual_detail_m = 5000.0;
// Posts that the grid has at most: 400 MB while they are made and measured.
inline constexpr std::uint64_t most_detail_posts = 16'777'216;

// Adds a grid to a region, behind the others: a box around a place, of the grid that is the ground there,
// with 2^halvings posts in place of one each way and ground between them (core/refined). It lies over its
// grid; grids that lie over that one lie over it, too. No detail is made on level ground and on the classes
// of `cover` that are water, snow or built land; where cover is null, on ground that is level and high up
// instead, as ice is. Errors: no ground at the place (no_data); a radius that asks for too many posts
// (usage), and those of refined_posts() and CoverMap::codes_at().
Result<void> add_detail(Region& region, const DetailRequest& request,
                        const std::shared_ptr<const CoverMap>& cover);

// All of a grid with 2^halvings posts in place of one each way, by the same rules. Errors: too many posts
// (usage); those of refined_posts().
Result<RegionGrid> whole_with_detail(const RegionGrid& data, int halvings);

// The grid that a region has from add_detail(); null: none.
const RegionGrid* detail_of(const Region& region);
// The grid of the data that it lies over. Null: none.
const RegionGrid* data_under_detail(const Region& region);
// How far the surface of a grid from add_detail() is from that of its data at a fractional row and column of
// it: metres of H, below 0 where it is lower. Nothing where either has no ground.
std::optional<double> invented_m(const RegionGrid& detail, const RegionGrid& data, double row, double column);

}  // namespace oro

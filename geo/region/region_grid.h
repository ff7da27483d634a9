// Which part of the world a region is, and the one post grid that its sources meet on.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/places/bounding_box.h"
#include "geo/sources/source.h"

namespace oro {

// A box whose longitudes have been unwrapped: west in [-180, 180), east in (west, west + 360].
struct RegionExtent {
    BoundingBox box;
    // Bounds that come from what was asked for, not from where the sources end.
    bool west_asked{}, south_asked{}, east_asked{}, north_asked{};
};

// The box with its longitudes unwrapped.
BoundingBox unwrapped(const BoundingBox& box);

// Whole turns by which a span of longitudes must be moved to overlap [west, east] by more than a line.
std::vector<int> turns_that_meet(const LonSpan& span, double west_deg, double east_deg);

// Lets sources whose cells touch (their posts are a spacing apart) reach over the seam to each other's first
// posts: a box that lies in between is inside the surface.
void reach_over_seams(std::span<Source> sources);

// True when the source, with its reach over seams, and the (unwrapped) box share more than a line.
bool meets(const Source& source, const BoundingBox& box);

// Where the asked box and the sources overlap; without a box the narrowest one that holds them all. Nothing
// when they do not meet.
std::optional<RegionExtent> region_extent(std::span<const Source> sources,
                                          const std::optional<BoundingBox>& asked);

// That a grid of so many posts over a box fits this machine's memory; else the error says what makes it so
// large.
Result<void> check_size(double rows, double columns, const BoundingBox& box, std::span<const Source> sources);

// Which part of the world a region is. Leaves out the sources that lie elsewhere; nothing when none is left,
// or when they cover no area.
std::optional<RegionExtent> choose_extent(std::vector<Source>& sources,
                                          const std::optional<BoundingBox>& box);

// Which of some sources, at least one, makes a region large: the one with the closest posts, and the one that
// lies farthest from where most lie. Numbers.
std::size_t finest_of(std::span<const Source> sources);
std::size_t farthest_of(std::span<const Source> sources);

// Posts that region_grid's answer has, or would have if memory held them.
double posts_of_region(std::span<const Source> sources, const RegionExtent& extent);

// The grid over an extent. Spacing: per axis that of the finest source. Alignment: the finest source on a
// grid of WGS84 degrees, so that its posts are the grid's (a finer spacing is then a whole part of that
// source's); otherwise posts at whole parts of a degree. The poles are never passed. Error: more posts than
// this machine's memory holds.
Result<PostGrid> region_grid(std::span<const Source> sources, const RegionExtent& extent);
// The same grid, whatever memory holds: for posts that are made when they are asked for. An axis has fewer than
// 2^31 of them.
PostGrid grid_over(std::span<const Source> sources, const RegionExtent& extent);

}  // namespace oro

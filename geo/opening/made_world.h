// Made terrain that is too large to hold: its posts are made when they are asked for.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/made/made_ground.h"
#include "geo/opening/grid_choice.h"
#include "geo/region/region.h"
#include "geo/sources/region_request.h"

namespace oro {

// More posts than this are made when they are asked for; fewer are made at once. More than the other are too
// many: places of 128 x 128 of them take 8 bytes each.
inline constexpr double posts_made_at_once = 268'435'456.0, most_made_posts = 1e12;

// Whether a chosen grid is made terrain alone, of a kind whose levels can be made when they are asked for,
// and so many posts.
bool is_made_world(const ChosenGrid& chosen);
// The same of sources over an extent.
bool is_made_world(std::span<const Source> sources, const RegionExtent& extent);

// The grid of such terrain, described: no post is void, and its fingerprint is that of its rule and its grid.
// Errors: those of GeoidOfRegion.
Result<RegionGrid> made_world(const ChosenGrid& chosen, const RegionRequest& request,
                              std::vector<std::string> notes);

// The rule of a grid in memory whose posts are all made by one, as that has them; null for any other grid.
std::shared_ptr<const MadeGround> made_ground_of(const RegionGrid& grid);

// The refusal where all posts of a grid would be needed that are made when they are asked for; success for
// any other grid. what: what needs them, as the place of the error.
Result<void> check_not_made_world(const RegionGrid& grid, const std::string& what);

}  // namespace oro

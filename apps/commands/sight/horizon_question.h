// What is asked of horizons, and of which posts.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "apps/options/horizon_options.h"
#include "core/sight/post_horizons.h"
#include "core/terrain/grid_part.h"
#include "core/truth/true_ground.h"
#include "geo/places/bounding_box.h"

namespace oro {

// What is asked of each post, without the posts. Errors (usage): a radius or a height over the ground that is
// none.
Result<PostHorizonsRequest> horizon_request(const HorizonOptions& options);

struct HorizonPosts {
    std::size_t grid{};
    GridPart part;
};
// The grid with most posts in the box, and these; `where` is what asked for the box. Errors: no posts there;
// (usage) more than 500,000,000 values.
Result<HorizonPosts> horizon_posts(const std::optional<BoundingBox>& box, const std::string& where,
                                   const TrueGround& ground, int directions);

}  // namespace oro

// What ground a picture or a map shows: which classes of land cover, how near it is, and whether images hide
// its colours.
#pragma once

#include <limits>
#include <set>

#include "apps/view/view.h"
#include "geo/together/region_ground.h"

namespace oro {

struct ShownGround {
    std::set<int> codes;  // that the files of land cover have for it, where no image hides it
    bool by_rule{};       // some of it is not hidden by an image, and no file of land cover knows it
    bool under_images{};  // there is some, and all of it is hidden by images
    double nearest_m{std::numeric_limits<double>::infinity()};          // from the eye; of a map nothing
    double eye_over_ground_m{std::numeric_limits<double>::infinity()};  // infinite where there is no ground
};

// At 64 x 48 points, evenly over the picture: what covers less than a thousandth of it may be missed. Meshes
// are no ground. Follows from the view and the data alone. Errors: a post, a file of land cover or an image
// that cannot be read.
Result<ShownGround> ground_shown(const View& view, const RegionGround& ground);

}  // namespace oro

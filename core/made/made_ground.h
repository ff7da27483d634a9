// A grid's posts as a rule of places gives them: what a page's heights can be made from wherever they are
// needed.
#pragma once

#include <cstdint>

#include "core/made/made_rule.h"

namespace oro {

// All of a grid's posts are those of a rule; none is void. Posts lie on whole multiples of 1 / posts_per_deg
// degrees; the numbers of the grid's first row and column are latitude and longitude times that.
struct MadeGround {
    gpu::MadeRule rule;
    std::int64_t posts_per_deg{};
    std::int64_t north{}, west{};
};

}  // namespace oro

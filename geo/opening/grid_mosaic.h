// The fourth step to a region: the posts of a grid, from its sources.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "geo/opening/grid_choice.h"
#include "geo/posts/seams.h"
#include "geo/region/region.h"
#include "geo/sources/region_request.h"
#include "geo/sources/source.h"

namespace oro {

// A grid that has its posts, and is not described yet.
struct LaidGrid {
    RegionGrid grid;
    std::vector<Source> sources;  // with what was found in them
    // This says which posts are covered; its heights are the grid's by now. A baked grid, which was described
    // when it was baked, has none.
    std::optional<JoinedSurface> surface;
};

// This lays sources into the grid that was chosen for them. notes: what is known already; what a user must
// know comes after it. The posts of a baked grid are read when they are asked for, or at once where a box
// cuts a part out of it. Errors: damage in a source; a datum that cannot be honoured; a grid that is too
// large.
[[nodiscard]] Result<LaidGrid> lay_grid(ChosenGrid chosen, const RegionRequest& request,
                                        std::vector<std::string> notes, const Progress& progress);

}  // namespace oro

// The third step to a region: which sources make a grid each, and which grid wins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/opening/region_sources.h"
#include "geo/region/region_grid.h"
#include "geo/sources/region_request.h"
#include "geo/sources/source.h"

namespace oro {

// Sources that become one grid, or a grid that was baked.
struct ChosenGrid {
    std::vector<Source> sources;  // at least one, or none of a baked grid
    RegionExtent extent{};        // of the grid that sources become
    int rank{};                   // RegionGrid::rank
    std::optional<BakedGrid> baked{};
};

// This gives the paths of a request, as errors name them: "a.tif, b.tif".
[[nodiscard]] std::string paths_words(const RegionRequest& request);
// This chooses the grids of the sources that were found, and leaves out those that the request's box does not
// meet, and groups whose posts lie on a line or a point. Of a baked region it takes each grid. Errors: none
// is left (no_data); several baked grids where one is asked for (usage).
[[nodiscard]] Result<std::vector<ChosenGrid>> choose_grids(RegionSources found, const RegionRequest& request);

}  // namespace oro

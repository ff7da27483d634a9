// Whether a view is drawn by clusters.
#pragma once

#include <string>

#include "apps/view/view.h"
#include "geo/region/region.h"

namespace oro {

// Whether a region has clusters that a view's models can be drawn by, whatever else the view asks for.
bool has_clusters(const Region& region, const View& view);

// True where the region was baked with clusters and the view can be drawn by them: at its own heights and
// geoid, on the ellipsoid, one grid alone; unless the view asks for the grid, or shows what clusters do not
// have. Puts what is drawn into view.mesh ("clusters", or "auto" for the grid). Errors: the view asks for
// clusters, and why there are none.
Result<bool> draws_clusters(const Region& region, View& view);

}  // namespace oro

// The ground below a polygon.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/terrain/post_grid.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// The lowest H of the ground within a polygon, by its rings of WGS84 (the outer one, then holes). fields: the
// ground's, the best first; the first that has ground anywhere in the polygon answers. Exact for the
// triangles that are drawn, but for what a view cuts out of a grid: the least of the ring's corners, of posts
// inside, and of where sides cross sides of triangles. Where a part has no ground, the rest counts. Nothing
// where there is none. From any thread.
std::optional<double> lowest_ground_H_m(const std::vector<std::vector<VectorPlace>>& rings,
                                        std::span<const HeightField* const> fields);

}  // namespace oro

// Which vertices some triangles have.
#pragma once

#include <span>
#include <vector>

#include "core/surface/surface_vertex.h"

namespace oro {

// Each of the triangles' vertices once, by rising number. Quick for as many triangles as a cluster has.
[[nodiscard]] std::vector<VertexNumber> distinct_vertices(std::span<const VertexTriangle> triangles);

}  // namespace oro

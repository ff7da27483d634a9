// Triangles shared out to clusters.
#pragma once

#include <span>
#include <vector>

#include "core/surface/original_surface.h"

namespace oro {

// Sorts triangles so that they are clusters one after another, and appends how many each has: at most
// most_cluster_triangles, with at most most_cluster_vertices. As few as the first allows, and none with far
// fewer than the others; cut in two by their middles, across the longer side, again and again.
void split_to_clusters(const OriginalSurface& surface, std::span<VertexTriangle> triangles,
                       std::vector<std::size_t>& counts);

// Different vertices of some triangles.
[[nodiscard]] std::size_t vertex_count(std::span<const VertexTriangle> triangles);

}  // namespace oro

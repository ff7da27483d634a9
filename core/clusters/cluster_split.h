// Triangles shared out to clusters, and in order in each.
#pragma once

#include <span>
#include <vector>

#include "core/clusters/cluster_walk.h"
#include "core/surface/original_surface.h"

namespace oro {

// Sorts triangles so that they are clusters one after another, and appends how many each has: at most
// most_cluster_triangles, with at most most_cluster_vertices. As few as the first allows, and none with far
// fewer than the others; cut in two by their middles, across the longer side, again and again.
void split_to_clusters(const OriginalSurface& surface, std::span<VertexTriangle> triangles,
                       std::vector<std::size_t>& counts);

// Different vertices of some triangles.
[[nodiscard]] std::size_t vertex_count(std::span<const VertexTriangle> triangles);

// The triangles of a cluster in the order of a walk, and each turned as the walk tells it: the edge first
// that it was reached by. One that is reached by none is the least of those that are left, its least corner
// first. Gives the same for the same triangles in any order.
[[nodiscard]] std::vector<LocalTriangle> walk_order(std::span<const LocalTriangle> triangles, int vertices);

// Vertices of a cluster by place.
[[nodiscard]] std::vector<VertexNumber> vertices_by_place(const OriginalSurface& surface,
                                                          std::span<const VertexTriangle> triangles);

// Puts a cluster's triangles into the order of a walk.
void put_in_walk_order(const OriginalSurface& surface, std::span<VertexTriangle> triangles);

}  // namespace oro

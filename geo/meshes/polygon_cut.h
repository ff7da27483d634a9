// Polygons of a mesh cut into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geo/meshes/source_mesh.h"

namespace oro {

// A polygon of more corners is refused by the readers: cutting takes up to the square of their number.
inline constexpr std::size_t most_polygon_corners = 10000;

// The rings of a polygon, by numbers of vertices, without the first again at the end: the outer one, then
// those of holes. Each has at least three corners; which way round they go does not matter.
using PolygonRings = std::vector<std::vector<std::uint32_t>>;

// Cuts a polygon into triangles between its own corners and adds them to `triangles`; they turn as the outer
// ring does. A polygon of n corners and k holes gives n + 2 k - 2. The cut is made in the plane of the outer
// ring's area, so the corners need not lie exactly in a plane. Gives false where the rings cross themselves
// or each other in that plane, or have no area there: the triangles then still join all corners of the outer
// ring, and the last ones may overlap. It costs up to the square of the corners' number. From any thread.
// Source: G. Meisters, Polygons have ears, Am. Math. Monthly 82(6), 1975; holes: D. Eberly, Triangulation by
// ear clipping, 2002.
bool cut_polygon(std::span<const glm::dvec3> vertices, const PolygonRings& rings,
                 ScratchVector<SourceTriangle>& triangles);

}  // namespace oro

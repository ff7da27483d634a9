// Lines on the ground as a picture shows them: where they are, and which parts the terrain leaves free.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "apps/names/seen_points.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// A part of a line that is seen without a break, from pixel to pixel: places half a pixel to one apart.
struct SeenLine {
    std::vector<glm::dvec2> places_px;  // from the picture's top left corner
    std::size_t shape{};                // number of the shape, as they were given
};

// Follows shapes' lines and rings on the ground, and asks the oracle about each place: a place is seen when
// what is a third of a pixel above it is seen. Parts up to `margin_px` beyond the picture's border are given,
// too. The same for the same shapes. Points are left out.
std::vector<SeenLine> seen_lines(const std::vector<const VectorShape*>& shapes, const TrueGround& ground,
                                 const PointsInView& in_view, const Camera& camera, double margin_px);

}  // namespace oro

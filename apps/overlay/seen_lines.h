// Lines on the ground as a picture shows them: where they are, and which parts the terrain leaves free.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "apps/names/seen_points.h"
#include "core/truth/true_ground.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// Takes the next place of a line on the ground; nothing where the ground ends and the line with it.
using PlaceSink = std::function<void(const std::optional<Geodetic>& place)>;

// Follows the way from one place to another on the ground: even in latitude and longitude, the shorter way
// round. Gives the first place, each place where the way comes to another triangle of the ground, and the
// last: between them the ground is as straight as the way. Places without ground end the line. Heights are
// the surface's; error: its own rounding.
void follow_ground(const TrueGround& ground, const VectorPlace& from, const VectorPlace& to,
                   const PlaceSink& sink);

// A line or ring on the ground, as follow_ground() gives it.
struct GroundLine {
    std::vector<std::optional<Geodetic>> places;
    std::size_t shape{};  // number of the shape, as they were given
};

// Shapes' lines and rings on the ground, `most` places at most; nothing where they have more. Points are left
// out.
std::optional<std::vector<GroundLine>> ground_lines(const std::vector<const VectorShape*>& shapes,
                                                    const TrueGround& ground, std::size_t most);

// A part of a line that is seen without a break, from pixel to pixel: places half a pixel to one apart.
struct SeenLine {
    std::vector<glm::dvec2> places_px;  // from the picture's top left corner
    std::size_t shape{};
};

// Follows shapes' lines and rings on the ground, and asks the oracle about each place: a place is seen when
// what is a third of a pixel above it is seen. Parts up to `margin_px` beyond the picture's border are given,
// too. The same for the same shapes. Points are left out.
std::vector<SeenLine> seen_lines(const std::vector<const VectorShape*>& shapes, const TrueGround& ground,
                                 const PointsInView& in_view, const Camera& camera, double margin_px);
// The same of lines that were followed before, with places up to `apart_px` apart: where they end is known to
// half of that.
std::vector<SeenLine> seen_lines(const std::vector<GroundLine>& lines, const PointsInView& in_view,
                                 const Camera& camera, double margin_px, double apart_px);

}  // namespace oro

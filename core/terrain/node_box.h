// The box around what a node draws, which occlusion asks.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "shaders/shared.h"

namespace oro {

// Half sizes to east, north and up around the middle of `bounds`, as PageBlock::boxes has them: in 1023rds of
// its radius, rounded outwards by more than a float's rounding of each term. points: in axes of the page,
// metres, within bounds' sphere. origin_lat_deg: of the page, whose PageBlock::up is that latitude's.
[[nodiscard]] gpu::uint node_box(std::span<const glm::dvec3> points, const gpu::MeshletBounds& bounds,
                                 double origin_lat_deg);

}  // namespace oro

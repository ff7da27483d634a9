// One tile of terrain as "quantized-mesh-1.0", which CesiumJS and others read.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "geo/web_maps/geographic_tiles.h"

namespace oro {

// A tile has so many quads along each side, all alike.
inline constexpr int quantized_quads = 64;
// Coordinates and heights of a tile are whole numbers to this one.
inline constexpr int quantized_steps = 32767;

// The tile's heights above the ellipsoid at the corners of its quads, from the south-west, row by row:
// (quantized_quads + 1)^2 of them. A corner between two whole numbers lies at the nearest.
using TileHeights = std::vector<double>;
// Between which heights those of a tile are whole numbers: rounded to float, outwards.
struct HeightSteps {
    float lowest_h_m{}, highest_h_m{};
};
HeightSteps height_steps_of(const TileHeights& heights_m);
// A height as the tile has it: half a step off at most.
std::uint16_t quantized_height(double h_m, const HeightSteps& steps);
double height_of_quantized_m(std::uint16_t quantized, const HeightSteps& steps);
// The whole number that stands for a corner, 0 .. quantized_quads, along either side.
int quantized_corner(int corner);

// The tile's bytes. Quads are split from south-west to north-east.
// Source: github.com/CesiumGS/quantized-mesh, specification of version 1.0.
std::vector<std::uint8_t> quantized_mesh_bytes(const GeographicTile& tile, const TileHeights& heights_m);

// A point in the scaled space of the ellipsoid from which on an eye may see something of the points, along
// `towards`; a far one where it is not known. Source: K. Ring, Computing the horizon occlusion point,
// cesium.com/blog, 2013.
glm::dvec3 horizon_occlusion_point(const std::vector<glm::dvec3>& points_m, const glm::dvec3& towards_m);

}  // namespace oro

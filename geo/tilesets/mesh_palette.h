// Colours of meshes in 3D Tiles and models.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geo/meshes/placed_mesh.h"
#include "geo/meshes/triangle_looks.h"

namespace oro {

// Means of materials that meshes are made of, linear light, 0 to 1.
struct MeshPalette {
    std::array<double, 3> ground{};  // of surveys
    std::array<double, 3> built{};   // what is built on: roads are a little darker
    std::array<double, 3> water{};
};

// The colour that pictures of materials have of a triangle in the mean, linear light: plaster, tiles or
// gravel of the building's own hue by how steep the triangle is, or what the palette has; grey where the
// file states colours of its corners. corners_m: ECEF.
std::array<double, 3> colour_of_triangle(const TriangleLook& of, const std::array<glm::dvec3, 3>& corners_m,
                                         const MeshPalette& palette);
// Of a triangle's corner, 0 to 2, likewise: that which the file states, or else the triangle's.
std::array<double, 3> colour_of_corner(const PlacedMesh& mesh, std::size_t triangle, std::size_t corner,
                                       const std::array<double, 3>& of_triangle);
// Of each triangle of a mesh. vertices_m: ECEF.
std::vector<std::array<double, 3>> colours_of_triangles(const PlacedMesh& mesh,
                                                        std::span<const glm::dvec3> vertices_m,
                                                        const MeshPalette& palette);

}  // namespace oro

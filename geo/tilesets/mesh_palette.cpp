#include "geo/tilesets/mesh_palette.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/earth/ellipsoid.h"
#include "core/seam/mesh_colours.h"

namespace oro {
namespace {

// 0 level, 90 upright; of one without an area 0.
double slope_of_triangle_deg(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const glm::dvec3 up = glm::normalize(a / glm::dvec3(1.0, 1.0, 1.0 - wgs84_e2));
    return deg_from_radians(
        Radians{std::atan2(glm::length(glm::cross(normal, up)), std::abs(glm::dot(normal, up)))});
}

std::array<double, 3> parts_of_light(const gpu::vec3& light) {
    return {light.x, light.y, light.z};
}

}  // namespace

std::array<double, 3> colour_of_triangle(const TriangleLook& of, const std::array<glm::dvec3, 3>& corners_m,
                                         const MeshPalette& palette) {
    switch (of.look) {
        case gpu::mesh_look_built: {
            const double slope_deg = slope_of_triangle_deg(corners_m[0], corners_m[1], corners_m[2]);
            return parts_of_light(colour_of_building(of.tone, static_cast<float>(slope_deg)));
        }
        case gpu::mesh_look_plain:
        case gpu::mesh_look_coloured:
            return parts_of_light(colour_of_plain_mesh());
        case gpu::mesh_look_water:
            return palette.water;
        case gpu::mesh_look_paved:
            return parts_of_light(
                colour_of_paving(gpu::vec3(palette.built[0], palette.built[1], palette.built[2])));
        default:
            return palette.ground;
    }
}

std::array<double, 3> colour_of_corner(const PlacedMesh& mesh, std::size_t triangle, std::size_t corner,
                                       const std::array<double, 3>& of_triangle) {
    return is_coloured(mesh, triangle) ? light_of_colour(mesh.colours[mesh.triangles[triangle][corner]])
                                       : of_triangle;
}

std::vector<std::array<double, 3>> colours_of_triangles(const PlacedMesh& mesh,
                                                        std::span<const glm::dvec3> vertices_m,
                                                        const MeshPalette& palette) {
    const TriangleLooks looks(mesh);
    std::vector<std::array<double, 3>> colours;
    colours.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        colours.push_back(
            colour_of_triangle(looks.of(i), {vertices_m[a], vertices_m[b], vertices_m[c]}, palette));
    }
    return colours;
}

}  // namespace oro

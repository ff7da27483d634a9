#include "geo/tilesets/outward_normals.h"

#include <cstddef>
#include <glm/geometric.hpp>

#include "geo/together/mesh_surface.h"

namespace oro {

std::vector<std::array<glm::vec3, 3>> outward_normals(const PlacedMesh& mesh,
                                                      std::span<const glm::dvec3> vertices_m) {
    std::vector<std::array<glm::vec3, 3>> normals = corner_normals(mesh, vertices_m);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        const glm::dvec3 out = glm::cross(vertices_m[b] - vertices_m[a], vertices_m[c] - vertices_m[a]);
        for (glm::vec3& normal : normals[i])
            if (glm::dot(glm::dvec3(normal), out) < 0.0) normal = -normal;
    }
    return normals;
}

}  // namespace oro

#include "geo/tilesets/model_mesh.h"

#include <filesystem>
#include <glm/matrix.hpp>
#include <map>
#include <tuple>

#include "geo/tilesets/mesh_things.h"
#include "geo/tilesets/outward_normals.h"

namespace oro {

ModelMesh model_mesh(const PlacedMesh& mesh, const UndulationField& undulation, const Geodetic& origin,
                     const MeshPalette& palette) {
    const std::vector<glm::dvec3> vertices_m = vertices_of_mesh(mesh, undulation);
    const std::vector<std::array<glm::vec3, 3>> normals = outward_normals(mesh, vertices_m);
    const std::vector<std::array<double, 3>> colours = colours_of_triangles(mesh, vertices_m, palette);
    const glm::dvec3 origin_m = ecef_from_geodetic(origin).m;
    const glm::dmat3 enu_from_ecef = glm::transpose(ecef_from_enu(origin.lat_deg, origin.lon_deg));
    const auto y_up_of = [&](const glm::dvec3& ecef) {
        const glm::dvec3 enu = enu_from_ecef * ecef;
        return glm::vec3(enu.x, enu.z, -enu.y);
    };
    ModelMesh made;
    made.name = std::filesystem::path(mesh.path).filename().string();
    // A vertex of the mesh is one for each normal and each colour of its triangles.
    using Key = std::tuple<std::uint32_t, float, float, float, std::array<double, 3>>;
    std::map<Key, std::uint32_t> known;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::uint32_t corner = mesh.triangles[i][j];
            const glm::vec3 normal = normals[i][j] == glm::vec3(0.0F) ? glm::vec3(0.0F, 1.0F, 0.0F)
                                                                      : y_up_of(glm::dvec3(normals[i][j]));
            const std::array<double, 3> colour = colour_of_corner(mesh, i, j, colours[i]);
            const auto [vertex, is_new] =
                known.try_emplace({corner, normal.x, normal.y, normal.z, colour},
                                  static_cast<std::uint32_t>(made.positions_m.size()));
            made.indices.push_back(vertex->second);
            if (!is_new) continue;
            made.positions_m.push_back(y_up_of(vertices_m[corner] - origin_m));
            made.normals.push_back(normal);
            made.colours.push_back(colour);
        }
    return made;
}

}  // namespace oro

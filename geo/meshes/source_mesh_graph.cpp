#include "geo/meshes/source_mesh_graph.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "geo/meshes/crs_unit.h"

namespace oro {

Result<MetricMesh> metric_mesh(const SourceMesh& mesh) {
    constexpr double steps_per_metre = 2048.0;
    double metres = mesh.unit.empty() ? 1.0 : mesh.metres_per_unit;
    if (!mesh.crs.empty()) {
        const std::optional<double> axis_m = crs_unit_m(mesh.crs);
        if (!axis_m)
            return Error{
                ErrorKind::failed, mesh.path,
                "has degrees for coordinates: its levels are told once it lies on terrain and is baked"};
        if (mesh.unit.empty()) metres = *axis_m;
    }
    // Around the first, so that far coordinates keep their millimetres.
    const glm::dvec3 first = mesh.vertices[mesh.triangles.front()[0]];
    std::map<std::tuple<double, double, double>, std::uint32_t> numbers;
    MetricMesh made;
    made.first_m = first * metres;
    std::vector<glm::dvec3>& vertices = made.vertices;
    std::vector<std::uint32_t> number_of(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const glm::dvec3 at =
            glm::round((mesh.vertices[i] - first) * metres * steps_per_metre) / steps_per_metre;
        const auto [found, is_new] =
            numbers.try_emplace({at.x, at.y, at.z}, static_cast<std::uint32_t>(vertices.size()));
        if (is_new) vertices.push_back(at);
        number_of[i] = found->second;
    }
    for (const SourceTriangle& corners : mesh.triangles) {
        const std::uint32_t a = number_of[corners[0]], b = number_of[corners[1]], c = number_of[corners[2]];
        if (glm::cross(vertices[b] - vertices[a], vertices[c] - vertices[a]) == glm::dvec3(0.0)) continue;
        made.triangles.push_back({a, b, c});
    }
    if (made.triangles.empty()) return Error{ErrorKind::failed, mesh.path, "has no triangle with an area"};
    return made;
}

Result<MeshGraph> graph_of_source(const SourceMesh& mesh, int threads) {
    ORO_TRY(const MetricMesh metric, metric_mesh(mesh));
    return build_mesh_graph(metric.vertices, metric.triangles, metric.first_m, {threads});
}

}  // namespace oro

// Any bytes as a mesh with its graph. The first byte says how the others are taken: as the mesh's bytes, or
// as changes of a true one's, three bytes each: where, and what is there instead. What is read must be a
// graph, and its errors can be measured again.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "core/cluster_frame/cluster_cut.h"
#include "core/mesh_file/mesh_bytes.h"
#include "core/mesh_file/mesh_check.h"

namespace {

using namespace oro;

// A ball of 144 triangles.
const std::vector<std::byte>& true_bytes() {
    static const std::vector<std::byte> bytes = [] {
        constexpr std::uint32_t n = 7, around = 12;
        std::vector<LatticeSteps> places{{0, 0, 40000}, {0, 0, -40000}};
        for (std::uint32_t i = 1; i < n; ++i)
            for (std::uint32_t k = 0; k < around; ++k) {
                const double a = std::numbers::pi * i / n, b = 2.0 * std::numbers::pi * k / around;
                places.push_back({std::llround(40000.0 * std::sin(a) * std::cos(b)),
                                  std::llround(40000.0 * std::sin(a) * std::sin(b)),
                                  std::llround(40000.0 * std::cos(a))});
            }
        std::vector<std::array<std::uint32_t, 3>> triangles;
        const auto at = [&](std::uint32_t i, std::uint32_t k) { return 2 + i * around + k % around; };
        for (std::uint32_t k = 0; k < around; ++k) {
            triangles.push_back({0, at(0, k), at(0, k + 1)});
            triangles.push_back({1, at(n - 2, k + 1), at(n - 2, k)});
            for (std::uint32_t i = 0; i + 2 < n; ++i) {
                triangles.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
                triangles.push_back({at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)});
            }
        }
        std::vector<glm::dvec3> vertices;
        for (const LatticeSteps& place : places)
            vertices.push_back(glm::dvec3(place[0], place[1], place[2]) / lattice_steps_per_m);
        const MeshGraph graph = build_mesh_graph(vertices, triangles, glm::dvec3(0.0));
        return mesh_to_bytes({{}, places, {}, 0, graph}).value();
    }();
    return bytes;
}

void expect(bool is_so) {
    if (!is_so) std::abort();
}

void use(const StoredMesh& mesh) {
    const ClusterGraph& graph = mesh.graph.clusters;
    expect(graph.triangles.size() == mesh.graph.original_of.size());
    for (const VertexTriangle& triangle : graph.triangles)
        for (const std::uint32_t corner : triangle) expect(corner < mesh.places.size());
    for (const ClusterGroup& group : graph.groups) {
        expect(std::isfinite(group.error_m) && std::isfinite(group.radius_m));
        expect(group.error_m >= largest_member_error_m(graph, group));
    }
    std::size_t before = triangles_of_cut(graph, cut_by_level(graph, 0));
    for (std::uint32_t level = 1; level <= graph.levels.size(); ++level) {
        const std::size_t now = triangles_of_cut(graph, cut_by_level(graph, level));
        expect(now <= before);
        before = now;
    }
    constexpr std::size_t few = 2000;
    if (graph.triangles.size() < few) (void)understated_error(mesh, 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    std::vector<std::byte> bytes;
    if (data[0] % 2 == 0) {
        for (std::size_t i = 1; i < size; ++i) bytes.push_back(static_cast<std::byte>(data[i]));
    } else {
        bytes = true_bytes();
        for (std::size_t i = 1; i + 2 < size; i += 3)
            bytes[(static_cast<std::size_t>(data[i]) << 8U | data[i + 1]) % bytes.size()] =
                static_cast<std::byte>(data[i + 2]);
    }
    StoredMesh mesh;
    if (!mesh_from_bytes(bytes, mesh)) use(mesh);
    return 0;
}

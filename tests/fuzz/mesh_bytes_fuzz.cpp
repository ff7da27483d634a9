// Any bytes as a mesh with its graph. The first byte says how the others are taken: as the mesh's bytes, or
// as changes of a true one's, three bytes each: where, and what is there instead; its third bit, whether the
// leaves are given apart from the bytes. What is read must be a graph, and its errors can be measured again.
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/cluster_frame/cluster_cut.h"
#include "core/mesh_file/mesh_bytes.h"
#include "core/mesh_file/mesh_check.h"
#include "tests/fuzz/mesh_of_ball.h"

namespace {

using namespace oro;
using test::expect;

struct TrueMesh {
    std::vector<std::byte> bytes, apart;  // which have the leaves, and which do not
    MeshLeaves leaves;
};

// A ball of 144 triangles.
const TrueMesh& true_mesh() {
    static const TrueMesh mesh = [] {
        const test::MeshOfBall ball = test::mesh_of_ball(7);
        const MeshGraph graph = ball.graph();
        const MeshToStore store{{}, ball.places, {}, 0, graph};
        const WrittenMesh apart = write_mesh(store, nullptr, LeavesIn::payloads).value();
        TrueMesh all{mesh_to_bytes(store).value(), {apart.bytes.begin(), apart.bytes.end()}, {}};
        StoredMesh whole;
        expect(!mesh_from_bytes(all.bytes, whole));
        all.leaves.places = whole.places;
        for (const VertexTriangle& triangle : whole.graph.clusters.triangles)
            if (all.leaves.triangles.size() < ball.triangles.size()) all.leaves.triangles.push_back(triangle);
        return all;
    }();
    return mesh;
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
    const bool is_apart = (data[0] & 4U) != 0;
    std::vector<std::byte> bytes;
    if (data[0] % 2 == 0) {
        for (std::size_t i = 1; i < size; ++i) bytes.push_back(static_cast<std::byte>(data[i]));
    } else {
        bytes = test::changed(is_apart ? true_mesh().apart : true_mesh().bytes, data + 1, size - 1);
    }
    StoredMesh mesh;
    MeshLeaves leaves = true_mesh().leaves;
    if (!mesh_from_bytes(bytes, mesh, is_apart ? &leaves : nullptr)) use(mesh);
    return 0;
}

#include "geo/together/mesh_detail.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "core/cluster_frame/cluster_cut.h"
#include "core/cluster_frame/group_rule.h"
#include "geo/together/mesh_surface.h"

namespace oro {
namespace {

// For each vertex the first one at its place.
std::vector<std::uint32_t> firsts_at(const std::vector<glm::dvec3>& places) {
    std::vector<std::uint32_t> order(places.size()), first(places.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) { return std::tuple(places[i].x, places[i].y, places[i].z); };
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple_cat(key(a), std::tuple(a)) < std::tuple_cat(key(b), std::tuple(b));
    });
    for (std::size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && places[order[i]] == places[order[i - 1]] ? first[order[i - 1]] : order[i];
    return first;
}

constexpr std::uint32_t not_used = ~std::uint32_t{0};

}  // namespace

MeshDetail::Graph MeshDetail::graph_of(const PlacedMesh& mesh, const UndulationField& undulation,
                                       double exaggeration, int threads) {
    const std::vector<glm::dvec3> places = drawn_places_m(mesh, undulation, exaggeration);
    const std::vector<std::uint32_t> first = firsts_at(places);
    Graph graph;
    std::vector<std::uint32_t> number(places.size(), not_used);
    std::vector<glm::dvec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const glm::dvec3 origin = places[mesh.triangles.front()[0]];
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        std::array<glm::dvec3, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = places[mesh.triangles[i][k]];
        if (glm::cross(at[1] - at[0], at[2] - at[0]) == glm::dvec3(0.0)) continue;
        std::array<std::uint32_t, 3>& triangle = triangles.emplace_back();
        graph.triangle_of.push_back(i);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = first[mesh.triangles[i][k]];
            if (number[vertex] == not_used) {
                number[vertex] = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(places[vertex] - origin);
                graph.vertex_of.push_back(vertex);
            }
            triangle[k] = number[vertex];
        }
    }
    if (!triangles.empty()) graph.graph = build_mesh_graph(vertices, triangles, origin, {threads});
    return graph;
}

MeshDetail MeshDetail::of(const Region& region, double exaggeration, int threads) {
    MeshDetail detail;
    detail.meshes_ = region.meshes;
    for (const PlacedMesh& mesh : *region.meshes)
        detail.graphs_.push_back(
            graph_of(mesh, region.grids.front().field.undulation, exaggeration, threads));
    return detail;
}

PlacedMesh MeshDetail::drawn(const PlacedMesh& mesh, const Graph& graph,
                             const std::vector<std::uint32_t>& clusters) {
    PlacedMesh drawn;
    drawn.path = mesh.path, drawn.format = mesh.format, drawn.crs = mesh.crs, drawn.heights = mesh.heights;
    drawn.features = mesh.features, drawn.in_file = mesh.in_file, drawn.fingerprint = mesh.fingerprint;
    std::vector<std::uint32_t> number(mesh.vertices.size(), not_used);
    const ClusterGraph& all = graph.graph.clusters;
    for (const std::uint32_t one : clusters) {
        const Cluster& cluster = all.clusters[one];
        for (std::uint32_t i = cluster.first_triangle; i < cluster.first_triangle + cluster.triangles; ++i) {
            SourceTriangle& triangle = drawn.triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = graph.vertex_of[all.triangles[i][k]];
                if (number[vertex] == not_used) {
                    number[vertex] = static_cast<std::uint32_t>(drawn.vertices.size());
                    drawn.vertices.push_back(mesh.vertices[vertex]);
                }
                triangle[k] = number[vertex];
            }
            if (!mesh.feature_of.empty())
                drawn.feature_of.push_back(mesh.feature_of[graph.triangle_of[graph.graph.original_of[i]]]);
        }
    }
    return drawn;
}

MeshCut MeshDetail::cut(const Camera& camera, double tau_px, const Air& air,
                        const std::optional<std::uint32_t>& level) const {
    const GroupRule rule(camera, tau_px, air, level);
    MeshCut cut;
    auto meshes = std::make_shared<std::vector<PlacedMesh>>();
    for (std::size_t i = 0; i < graphs_.size(); ++i) {
        const ClusterGraph& graph = graphs_[i].graph.clusters;
        std::vector<char> stands;
        stands.reserve(graph.groups.size());
        for (const ClusterGroup& group : graph.groups) stands.push_back(rule.stands(group) ? 1 : 0);
        const std::vector<std::uint32_t> clusters = cut_of(graph, stands);
        for (std::size_t k = 0; k < stands.size(); ++k) {
            if (stands[k] == 0) continue;
            cut.error_m = std::max(cut.error_m, graph.groups[k].error_m);
            cut.error_px = std::max(cut.error_px, rule.error_px(graph.groups[k]));
        }
        meshes->push_back(drawn((*meshes_)[i], graphs_[i], clusters));
        cut.triangles += meshes->back().triangles.size();
        cut.of_triangles += (*meshes_)[i].triangles.size();
    }
    cut.meshes = std::move(meshes);
    return cut;
}

}  // namespace oro

#include "geo/together/mesh_detail.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cluster_frame/cluster_cut.h"
#include "core/cluster_frame/group_rule.h"
#include "core/frame/frame_colours.h"
#include "core/mesh_file/stored_mesh.h"
#include "core/streamed_mesh/streamed_mesh.h"
#include "core/terrain/page_on_net.h"
#include "geo/together/baked_meshes.h"
#include "geo/together/lattice_mesh.h"
#include "geo/together/mesh_ground.h"
#include "geo/together/mesh_surface.h"
#include "geo/together/streamed_triangles.h"

namespace oro {
namespace {

constexpr std::uint32_t not_used = ~std::uint32_t{0};

// Whether a mesh is drawn where its baked graph was built, and over the same ground.
bool lies_as_stored(const PlacedMesh& mesh, const Region& region, double exaggeration) {
    if (!mesh.stored()) return false;
    const std::vector<glm::dvec3> places =
        drawn_places_m(mesh, region.grids.front().field.undulation, exaggeration);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (lattice_point(places[i]).steps != mesh.stored()->places[i]) return false;
    if (mesh.stored()->ground_fingerprint == 0) return true;
    const MeshGround ground = ground_below_parts(*mesh.stored(), region, exaggeration);
    return fingerprint_of(ground, mesh.stored()->origin_ecef_m()) == mesh.stored()->ground_fingerprint;
}

VertexColour coded(const gpu::vec3& colour) {
    const auto code = [](float value) {
        return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
    };
    return {code(colour.x), code(colour.y), code(colour.z), 1};
}

// The colour of a cluster, as pictures of the ground's own clusters have it (shaders/shade/show.comp). Those
// of several meshes have other numbers.
VertexColour colour_of_part(const ClusterGraph& graph, std::uint32_t number, MeshParts parts,
                            std::size_t mesh) {
    const Cluster& cluster = graph.clusters[number];
    const auto first = static_cast<std::uint32_t>(mesh << 24U);
    if (parts == MeshParts::clusters) return coded(colour_of_number(first ^ number));
    if (parts == MeshParts::groups)
        return coded(
            colour_of_number(first ^ (cluster.made_by != no_group ? cluster.made_by : cluster.used_by)));
    const std::uint32_t level = cluster.made_by == no_group ? 0 : graph.groups[cluster.made_by].level;
    // Clusters beside each other differ by a little light.
    const float light = 0.85F + 0.15F * colour_of_number(first ^ number).x;
    const gpu::vec3 colour = colour_of_level(level);
    return coded(gpu::vec3(light * colour.x, light * colour.y, light * colour.z));
}

}  // namespace

MeshDetail::Graph MeshDetail::graph_of(const PlacedMesh& mesh, const UndulationField& undulation,
                                       double exaggeration, int threads, const Region* region) {
    const std::vector<glm::dvec3> places = drawn_places_m(mesh, undulation, exaggeration);
    LatticeMesh lattice = lattice_mesh(places, mesh.triangles);
    Graph graph;
    graph.origin_m = lattice.origin_m;
    for (const std::uint32_t vertex : lattice.vertex_of) graph.places_m.push_back(places[vertex]);
    MeshGround ground;
    if (region != nullptr)
        ground =
            ground_below_parts(lattice.vertices, lattice.triangles, lattice.origin_m, *region, exaggeration);
    graph.ground_fingerprint = fingerprint_of(ground, lattice.origin_m);
    MeshGraphOptions options{threads};
    options.ground = &ground;
    graph.graph = std::make_shared<const MeshGraph>(
        lattice.triangles.empty()
            ? MeshGraph()
            : build_mesh_graph(lattice.vertices, lattice.triangles, lattice.origin_m, options));
    graph.vertex_of.assign(lattice.vertex_of.begin(), lattice.vertex_of.end());
    graph.triangle_of.assign(lattice.triangle_of.begin(), lattice.triangle_of.end());
    return graph;
}

MeshDetail MeshDetail::of(const Region& region, double exaggeration, int threads) {
    return of(region, exaggeration, threads, region.meshes);
}

MeshDetail MeshDetail::of(const Region& region, double exaggeration, int threads,
                          std::shared_ptr<const std::vector<PlacedMesh>> meshes) {
    MeshDetail detail;
    detail.meshes_ = std::move(meshes), detail.threads_ = threads;
    const UndulationField& undulation = region.grids.front().field.undulation;
    for (const PlacedMesh& mesh : *detail.meshes_) {
        if (mesh.streamed()) {
            Graph& streamed = detail.graphs_.emplace_back();
            streamed.graph = std::shared_ptr<const MeshGraph>(mesh.baked, &mesh.streamed()->records().graph);
            detail.undulation_ = undulation;
            continue;
        }
        if (lies_as_stored(mesh, region, exaggeration)) {
            Graph& stored = detail.graphs_.emplace_back();
            stored.graph = std::shared_ptr<const MeshGraph>(mesh.baked, &mesh.stored()->graph);
            continue;
        }
        detail.graphs_.push_back(graph_of(mesh, undulation, exaggeration, threads, &region));
        detail.graphs_.back().places_m = {};
        ++detail.built_;
    }
    return detail;
}

Result<MeshDetail> MeshDetail::open(const Region& region, double exaggeration, int threads) {
    const UndulationField& undulation = region.grids.front().field.undulation;
    auto meshes = region.meshes;
    for (std::size_t i = 0; i < region.meshes->size(); ++i) {
        const PlacedMesh& mesh = (*region.meshes)[i];
        if (!mesh.streamed() || streams_as_drawn(mesh, region, exaggeration)) continue;
        auto changed = std::make_shared<std::vector<PlacedMesh>>(*meshes);
        ORO_TRY((*changed)[i], read_whole_mesh(mesh, undulation));
        meshes = std::move(changed);
    }
    return of(region, exaggeration, threads, std::move(meshes));
}

PlacedMesh MeshDetail::drawn(const PlacedMesh& mesh, const Graph& graph,
                             const std::vector<std::uint32_t>& clusters) {
    PlacedMesh drawn = without_triangles(mesh);
    std::vector<std::uint32_t> number(mesh.vertices.size(), not_used);
    const ClusterGraph& all = graph.graph->clusters;
    const auto of_mesh = [](const std::vector<std::uint32_t>& numbers, std::uint32_t i) {
        return numbers.empty() ? i : numbers[i];
    };
    const auto drawn_vertex = [&](std::uint32_t vertex) {
        if (number[vertex] == not_used) {
            number[vertex] = static_cast<std::uint32_t>(drawn.vertices.size());
            drawn.vertices.push_back(mesh.vertices[vertex]);
            if (!mesh.colours.empty())
                drawn.colours.push_back(vertex < mesh.colours.size() ? mesh.colours[vertex] : VertexColour{});
        }
        return number[vertex];
    };
    for (const std::uint32_t one : clusters) {
        const Cluster& cluster = all.clusters[one];
        for (std::uint32_t i = cluster.first_triangle; i < cluster.first_triangle + cluster.triangles; ++i) {
            SourceTriangle& triangle = drawn.triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k)
                triangle[k] = drawn_vertex(of_mesh(graph.vertex_of, all.triangles[i][k]));
            if (!mesh.feature_of.empty())
                drawn.feature_of.push_back(
                    mesh.feature_of[of_mesh(graph.triangle_of, graph.graph->original_of[i])]);
        }
    }
    // From the terrain to where the mesh itself ends: what is drawn ends within tau of that, and skirts close
    // gaps of tau.
    for (const RimWall& wall : mesh.rim_walls)
        drawn.rim_walls.push_back({{drawn_vertex(wall.cut[0]), drawn_vertex(wall.cut[1])},
                                   {drawn_vertex(wall.over[0]), drawn_vertex(wall.over[1])}});
    return drawn;
}

Result<MeshCut> MeshDetail::cut(const Camera& camera, double tau_px, const Air& air,
                                const std::optional<std::uint32_t>& level, const MeshCut* before,
                                MeshParts parts) const {
    return cut(std::span(&camera, 1), tau_px, air, level, before, parts);
}

Result<MeshCut> MeshDetail::cut(std::span<const Camera> cameras, double tau_px, const Air& air,
                                const std::optional<std::uint32_t>& level, const MeshCut* before,
                                MeshParts parts) const {
    return with_meshes(chosen(cameras, tau_px, air, level), before, parts);
}

MeshCut MeshDetail::chosen(std::span<const Camera> cameras, double tau_px, const Air& air,
                           const std::optional<std::uint32_t>& level) const {
    std::vector<GroupRule> rules;
    for (const Camera& camera : cameras) rules.emplace_back(camera, tau_px, air, level);
    MeshCut cut;
    for (const Graph& one : graphs_) {
        const ClusterGraph& graph = one.graph->clusters;
        std::vector<char> stands;
        stands.reserve(graph.groups.size());
        for (const ClusterGroup& group : graph.groups) {
            const bool all =
                std::ranges::all_of(rules, [&](const GroupRule& rule) { return rule.stands(group); });
            stands.push_back(all ? 1 : 0);
            if (!all) continue;
            cut.error_m = std::max(cut.error_m, group.error_m);
            for (const GroupRule& rule : rules) cut.error_px = std::max(cut.error_px, rule.error_px(group));
        }
        cut.clusters.push_back(cut_of(graph, stands));
        for (const std::uint32_t cluster : cut.clusters.back())
            cut.triangles += graph.clusters[cluster].triangles;
    }
    for (const PlacedMesh& mesh : *meshes_)
        cut.of_triangles += mesh.streamed() ? mesh.streamed()->records().triangles : mesh.triangles.size();
    return cut;
}

Result<MeshCut> MeshDetail::with_meshes(MeshCut cut, const MeshCut* before, MeshParts parts) const {
    cut.parts = parts;
    if (before != nullptr && before->clusters == cut.clusters && before->parts == parts) {
        cut.meshes = before->meshes;
        return cut;
    }
    auto meshes = std::make_shared<std::vector<PlacedMesh>>();
    for (std::size_t i = 0; i < graphs_.size(); ++i) {
        const PlacedMesh& mesh = (*meshes_)[i];
        if (mesh.streamed()) {
            ORO_TRY(PlacedMesh read, streamed_cut(mesh, cut.clusters[i], undulation_, threads_));
            meshes->push_back(std::move(read));
        } else {
            meshes->push_back(drawn(mesh, graphs_[i], cut.clusters[i]));
        }
        if (parts == MeshParts::none) continue;
        const ClusterGraph& graph = graphs_[i].graph->clusters;
        for (const std::uint32_t cluster : cut.clusters[i])
            meshes->back().part_colours.insert(meshes->back().part_colours.end(),
                                               graph.clusters[cluster].triangles,
                                               colour_of_part(graph, cluster, parts, i));
    }
    cut.meshes = std::move(meshes);
    return cut;
}

void MeshDetail::hold_at_most(std::uint64_t bytes) const {
    hold_streamed_at_most(*meshes_, bytes);
}

std::size_t mesh_levels(const Region& region) {
    std::size_t levels = 1;
    for (const PlacedMesh& mesh : *region.meshes) {
        std::size_t of_mesh = 1;
        if (mesh.streamed())
            of_mesh += mesh.streamed()->records().graph.clusters.levels.size();
        else if (mesh.stored())
            of_mesh += mesh.stored()->graph.clusters.levels.size();
        else
            for (double left = static_cast<double>(mesh.triangles.size()); left > most_cluster_triangles;
                 left *= 2.0 / 3.0)
                ++of_mesh;
        levels = std::max(levels, of_mesh);
    }
    return levels;
}

}  // namespace oro

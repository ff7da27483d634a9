// A region's meshes at the detail that a view needs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/mesh_graph/mesh_graph.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/region/region.h"

namespace oro {

// What triangles that are drawn have the colours of: the cluster that each is of; the group that made that
// cluster, or for one of the mesh's own triangles the group that uses it; the level of the cluster, where 0
// are the mesh's own triangles. None: what the mesh looks like.
enum class MeshParts { none, clusters, groups, levels };

// What is drawn in the place of a region's meshes.
struct MeshCut {
    std::shared_ptr<const std::vector<PlacedMesh>> meshes;  // as many, with fewer triangles each
    std::uint64_t triangles{};
    std::uint64_t of_triangles{};  // of the meshes themselves
    // Bounds of how far any place that is drawn is from the mesh, and any place of the mesh from what is
    // drawn: the distance in space, and what of it can be seen. Infinite where nothing can be promised, which
    // is where a level was asked for and the eye is near.
    double error_m{};
    double error_px{};
    std::vector<std::vector<std::uint32_t>> clusters;  // of each mesh's graph, those that are drawn
    MeshParts parts{};                                 // what their triangles have the colours of
};

// The cluster graphs of a region's meshes (core/mesh_graph/mesh_graph.h). Vertices at one place of the
// lattice that is drawn are one vertex.
class MeshDetail {
  public:
    // Takes them from the region's baked file, or builds them, over the region's ground; one that was built
    // over other ground than is there now is built again. region: with meshes, which it holds on to.
    // threads: 1 or more; the graphs are the same by any number.
    static MeshDetail of(const Region& region, double exaggeration, int threads);
    // The same; meshes that the region reads group by group are read so where streams_as_drawn() says that
    // they may be, else whole. Errors: damage.
    static Result<MeshDetail> open(const Region& region, double exaggeration, int threads);

    // What a view draws: of each mesh as few triangles as keep all within tau_px of where the mesh is seen,
    // or those of one level from everywhere: 0 are all triangles. Its triangles' features are those of the
    // triangles that they began as. camera: of the whole picture. parts: what they have the colours of.
    // before: a cut of these meshes; where the same clusters are drawn in the same colours now, its meshes
    // are given once more.
    // Errors: groups that cannot be read.
    [[nodiscard]] Result<MeshCut> cut(const Camera& camera, double tau_px, const Air& air,
                                      const std::optional<std::uint32_t>& level,
                                      const MeshCut* before = nullptr,
                                      MeshParts parts = MeshParts::none) const;
    // The same of several views at once: what is drawn keeps tau_px in each of them.
    [[nodiscard]] Result<MeshCut> cut(std::span<const Camera> cameras, double tau_px, const Air& air,
                                      const std::optional<std::uint32_t>& level,
                                      const MeshCut* before = nullptr,
                                      MeshParts parts = MeshParts::none) const;
    // Its two halves: which clusters, without meshes, which reads nothing; and the meshes of these.
    [[nodiscard]] MeshCut chosen(std::span<const Camera> cameras, double tau_px, const Air& air,
                                 const std::optional<std::uint32_t>& level) const;
    [[nodiscard]] Result<MeshCut> with_meshes(MeshCut chosen, const MeshCut* before = nullptr,
                                              MeshParts parts = MeshParts::none) const;

    // The graph of a mesh, by its number from 0; without triangles where these are read group by group.
    [[nodiscard]] const MeshGraph& graph(std::size_t mesh) const { return *graphs_[mesh].graph; }
    [[nodiscard]] std::size_t size() const { return graphs_.size(); }
    // How many of them had to be built; the others lay in a baked file, which holds for where its meshes are
    // drawn without exaggeration.
    [[nodiscard]] std::size_t built() const { return built_; }

    // Bytes of memory that all groups that were read may take between cuts.
    void hold_at_most(std::uint64_t bytes) const;

    // The graph of one mesh, and what of the mesh it is over.
    struct Graph {
        std::shared_ptr<const MeshGraph> graph;
        std::vector<glm::dvec3> places_m;        // of its vertices, ECEF; empty of one that was not built
        glm::dvec3 origin_m{};                   // that its spheres are reckoned from
        std::vector<std::uint32_t> vertex_of;    // of the mesh, for each of the graph; empty: the same
        std::vector<std::uint32_t> triangle_of;  // likewise
        std::uint64_t ground_fingerprint{};      // of the ground that it was built over; 0: of none
    };
    // Builds it. Triangles without an area are left out. ground: the region whose true ground small parts may
    // be dropped onto; null: they may not.
    static Graph graph_of(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration,
                          int threads, const Region* ground = nullptr);

  private:
    static MeshDetail of(const Region& region, double exaggeration, int threads,
                         std::shared_ptr<const std::vector<PlacedMesh>> meshes);
    [[nodiscard]] static PlacedMesh drawn(const PlacedMesh& mesh, const Graph& graph,
                                          const std::vector<std::uint32_t>& clusters);

    std::shared_ptr<const std::vector<PlacedMesh>> meshes_;
    std::vector<Graph> graphs_;
    UndulationField undulation_;  // of the region; empty where nothing is read group by group
    int threads_{1};
    std::size_t built_{};
};

// How many levels the graphs of a region's meshes have at most, level 0 among them. Of a mesh that is not
// baked it is an estimate: each level has two thirds of the triangles of the one before, down to one cluster.
// The region has meshes.
std::size_t mesh_levels(const Region& region);

}  // namespace oro

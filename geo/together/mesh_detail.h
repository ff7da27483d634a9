// A region's meshes at the detail that a view needs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/mesh_graph/mesh_graph.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/region/region.h"

namespace oro {

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
};

// The cluster graphs of a region's meshes (core/mesh_graph/mesh_graph.h). Vertices at one place of the
// lattice that is drawn are one vertex.
class MeshDetail {
  public:
    // Builds them. region: with meshes, which it holds on to. threads: 1 or more; the graphs are the same by
    // any number.
    static MeshDetail of(const Region& region, double exaggeration, int threads);

    // What a view draws: of each mesh as few triangles as keep all within tau_px of where the mesh is seen,
    // or those of one level from everywhere: 0 are all triangles. Its triangles' features are those of the
    // triangles that they began as. camera: of the whole picture.
    [[nodiscard]] MeshCut cut(const Camera& camera, double tau_px, const Air& air,
                              const std::optional<std::uint32_t>& level) const;

    // The graph of a mesh, by its number from 0, and its vertices as drawn, ECEF metres.
    [[nodiscard]] const MeshGraph& graph(std::size_t mesh) const { return graphs_[mesh].graph; }
    [[nodiscard]] std::size_t size() const { return graphs_.size(); }

  private:
    struct Graph {
        MeshGraph graph;
        std::vector<std::uint32_t> vertex_of;    // of the mesh, for each of the graph
        std::vector<std::uint32_t> triangle_of;  // likewise
    };
    static Graph graph_of(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration,
                          int threads);
    [[nodiscard]] static PlacedMesh drawn(const PlacedMesh& mesh, const Graph& graph,
                                          const std::vector<std::uint32_t>& clusters);

    std::shared_ptr<const std::vector<PlacedMesh>> meshes_;
    std::vector<Graph> graphs_;
};

}  // namespace oro

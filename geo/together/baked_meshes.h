// Meshes in a baked file: each with its cluster graph, in chunks of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/container.h"
#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/region/region.h"

namespace oro {

// Where the mesh with that number grows on its way into the file `path`: beside it.
std::string path_of_mesh(const std::string& path, std::size_t number);

// What was written of a mesh.
struct BakedMeshReport {
    std::uint64_t triangles{};        // of the mesh
    std::uint64_t graph_triangles{};  // of all levels
    std::uint64_t levels{};
    std::uint64_t bytes{};        // of triangles, places and graph
    std::uint64_t group_bytes{};  // of the same once more, group by group
    std::uint64_t fact_bytes{};   // of features and what else is known of it, pressed
    double build_s{};             // building its graph
    bool was_there{};             // it was not built: a bake that was broken off had
};

// Builds the graph of a mesh, as it is drawn at no exaggeration, and writes both as a container of their own.
// undulation: N of the region; empty: 0. ground: the region, where small parts may be dropped onto its
// ground; null: they may not. The same mesh gives the same bytes by any number of threads. The graph of a
// mesh of more triangles than most_in_memory grows in scratch files, which lie beside `path` and have no
// names. Errors: those of writing; no room for these files; a mesh that no file holds (mesh_to_bytes()), or
// that needs more memory than there is (check_bake_memory()).
Result<BakedMeshReport> write_baked_mesh(const std::string& path, const PlacedMesh& mesh,
                                         const UndulationField& undulation, int threads,
                                         const Region* ground = nullptr,
                                         std::size_t most_in_memory = 250'000);

// A mesh that write_baked_mesh() has written there for the same mesh over the same ground, whole; else
// nothing. Reads all of it; takes some 3 us a triangle.
std::optional<BakedMeshReport> mesh_baked_before(const std::string& path, const PlacedMesh& mesh,
                                                 const UndulationField& undulation,
                                                 const Region* ground = nullptr);

// The meshes of a baked file, in their order; none where it has none. Their graphs are with them, and
// vertices are where they are drawn: at N of the same region they are drawn there again, to the bit. Reads
// them whole, in one pass. Errors: those of Container; damage; numbers that no mesh has.
Result<std::vector<PlacedMesh>> read_baked_meshes(const Container& container,
                                                  const UndulationField& undulation);

// The same without the triangles of those that the file has group by group: PlacedMesh::streamed reads them.
// The others are read whole.
Result<std::vector<PlacedMesh>> open_baked_meshes(const std::shared_ptr<const Container>& container,
                                                  const UndulationField& undulation);
// All of a mesh that open_baked_meshes() has opened, as read_baked_meshes() reads it. Errors: as it.
Result<PlacedMesh> read_whole_mesh(const PlacedMesh& mesh, const UndulationField& undulation);

// The meshes of a region with all their triangles: its own, or where it reads some group by group those read
// whole. Errors: as read_whole_mesh().
using MeshesOfRegion = std::shared_ptr<const std::vector<PlacedMesh>>;
Result<MeshesOfRegion> whole_meshes(const Region& region);

// Holds the groups of a mesh, by its number, that was read whole against those that follow from its
// triangles, and from the grids of the region where it was built over ground. Errors: they are others.
Result<void> check_streamed_mesh(const Container& container, std::uint32_t number, const PlacedMesh& mesh,
                                 const Region& region);

}  // namespace oro

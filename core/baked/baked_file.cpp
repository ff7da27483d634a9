#include "core/baked/baked_file.h"

#include <algorithm>
#include <utility>

namespace oro {

static bool is_of_mesh(ChunkType type) {
    return type == ChunkType::mesh_facts || type == ChunkType::mesh_triangles ||
           type == ChunkType::mesh_records || type == ChunkType::mesh_payloads;
}

Result<std::vector<BakedGrid>> open_baked_file(const std::string& path) {
    ORO_TRY(const std::shared_ptr<const Container> container, Container::open(path));
    const OpenFile& file = container->file();
    const std::vector<Chunk>& chunks = container->table().chunks;
    std::vector<BakedGrid> grids;
    for (const Chunk& chunk : chunks) {
        if (chunk.type != ChunkType::outline) continue;
        ORO_TRY(RegionFile region, RegionFile::open(container, chunk.grid));
        grids.push_back({std::make_shared<const RegionFile>(std::move(region)), nullptr, chunk.grid});
    }
    if (grids.empty()) return Error{ErrorKind::failed, path, "holds no grid of posts"};
    std::uint32_t meshes = 0;
    while (container->find(ChunkType::mesh_facts, meshes)) ++meshes;
    // Each number below their count once, as no chunk is there twice; and nobody else's chunks.
    for (const Chunk& chunk : chunks) {
        if (is_of_mesh(chunk.type)) {
            if (chunk.grid >= meshes)
                return file.damaged(chunk.offset, "a chunk of mesh " + std::to_string(chunk.grid) +
                                                      ", which is none of its " + std::to_string(meshes));
            continue;
        }
        if (chunk.grid >= grids.size() || chunk.type == ChunkType::window || chunk.type == ChunkType::blocks)
            return file.damaged(chunk.offset, "a chunk of grid " + std::to_string(chunk.grid) +
                                                  ", which is none of its " + std::to_string(grids.size()));
    }
    // Nobody reads clusters without the outline that says what they are.
    for (const Chunk& chunk : chunks)
        if ((chunk.type == ChunkType::groups || chunk.type == ChunkType::meshes) &&
            !container->find(ChunkType::graph, chunk.grid))
            return file.damaged(chunk.offset, "clusters of grid " + std::to_string(chunk.grid) +
                                                  ", whose outline the file lacks");
    for (BakedGrid& grid : grids) {
        if (!container->find(ChunkType::graph, grid.rank)) continue;
        ORO_TRY(ClusterFile clusters, ClusterFile::open(container, grid.rank));
        const ClusterOutline& graph = clusters.outline();
        const PostGrid& posts = grid.region->outline().grid;
        if (graph.fingerprint != grid.region->fingerprint() || graph.posts.rows != posts.rows() ||
            graph.posts.columns != posts.columns())
            return file.damaged(container->find(ChunkType::graph, grid.rank)->offset,
                                "its clusters are of another region");
        grid.clusters = std::make_shared<const ClusterFile>(std::move(clusters));
    }
    return grids;
}

}  // namespace oro

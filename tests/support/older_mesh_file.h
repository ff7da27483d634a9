// A baked file as older programs wrote it: the whole mesh in its bytes, its groups each alone, or no groups.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/container.h"
#include "core/mesh_file/mesh_bytes.h"
#include "core/streamed_mesh/streamed_mesh.h"

namespace oro::test {

// The mesh of number 0 of a file.
inline StoredMesh stored_mesh_in(const std::shared_ptr<const Container>& container) {
    const Chunk chunk = container->chunk(ChunkType::mesh_triangles, 0).value();
    const auto bytes = container->read(chunk, chunk.bytes).value();
    MeshLeaves leaves;
    if (has_leaves_elsewhere(bytes)) leaves = StreamedMesh::open(container, 0).value()->leaves(2).value();
    StoredMesh mesh;
    EXPECT_FALSE(mesh_from_bytes(bytes, mesh, &leaves));
    return mesh;
}

// The bytes of such a file, of one with one mesh. colours: of its vertices.
inline std::string older_mesh_file(const std::string& path, bool has_groups,
                                   std::span<const VertexColour> colours = {}) {
    const auto container = Container::open(path).value();
    const StoredMesh mesh = stored_mesh_in(container);
    const auto streamed = StreamedMesh::open(container, 0).value();
    const MeshRecords& records = streamed->records();
    const StreamedBytes groups = streamed_bytes_of(
        mesh, colours, 1, records.is_town() ? &records.ground_cells : nullptr, nullptr, PayloadForm::alone);
    ChunkTable table;
    std::string chunks;
    for (Chunk chunk : container->table().chunks) {
        std::vector<std::byte> bytes = container->read(chunk, chunk.bytes).value();
        if (chunk.type == ChunkType::mesh_triangles)
            bytes = mesh_to_bytes({mesh.origin, mesh.places, mesh.labels, mesh.label_count, mesh.graph,
                                   mesh.ground_fingerprint})
                        .value();
        if (chunk.type == ChunkType::mesh_records) bytes = groups.records;
        if (chunk.type == ChunkType::mesh_payloads)
            bytes.assign(groups.payloads.begin(), groups.payloads.end());
        if (!has_groups && (chunk.type == ChunkType::mesh_records || chunk.type == ChunkType::mesh_payloads))
            continue;
        chunk.bytes = bytes.size(), chunk.checksum = xxh64(bytes);
        table.chunks.push_back(chunk);
        chunks.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    table.file_bytes = table.place();
    const auto front = table.to_bytes();
    return std::string(reinterpret_cast<const char*>(front.data()), front.size()) + chunks;
}

}  // namespace oro::test

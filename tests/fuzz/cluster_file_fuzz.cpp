// Any bytes as a cluster file over a small grid with a hole. The first byte says how they are taken: as the
// whole file; as chunks whose table, places and checksums are then made right; as the payload of a group; as
// changes of a true file's chunks, made right in the same way. What is read as a
// graph must be sound, and every cut of it must be as many triangles as the original at most. The same is
// asked without the graph in memory, and what draws such a file reads it, too: sound ones are drawn.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"
#include "core/cluster_file/cluster_file.h"
#include "core/cluster_file/cluster_format.h"
#include "core/cluster_frame/cluster_choice.h"
#include "core/cluster_frame/cluster_cut.h"
#include "core/clusters/graph_builder.h"
#include "core/surface/grid_surface.h"
#include "core/terrain/drawn_heights.h"
#include "tests/support/mended_container.h"

namespace {

using namespace oro;
using namespace cluster_format;

constexpr std::int32_t rows = 30, columns = 28;

struct Ground {
    HeightField field;
    DrawnHeights heights;
    GridSurface surface;
    GridBounds bounds;
    HorizonOccluder occluder;
    std::uint64_t fingerprint = 0;
    ChunkTable table;               // of a true file
    std::vector<std::byte> chunks;  // of it

    static HeightField made() {
        HeightField field;
        field.grid.lat = {1200.0, 0.0, 47 * 1200, -1, rows};
        field.grid.lon = {1200.0, 0.0, 8 * 1200, +1, columns};
        for (int i = 0; i < rows * columns; ++i)
            field.H_m.push_back(i % 400 == 399 ? void_height_m : static_cast<float>(i * 7919 % 613));
        return field;
    }
    Ground()
        : field(made()),
          heights(drawn_heights(field, 1.0, 1)),
          surface(heights),
          bounds(field.grid, heights.highest_steps),
          occluder(region_shape(field, 1.0).occluder) {
        const std::string path = name() + "-true";
        if (!write_cluster_graph(path, build_cluster_graph(surface, bounds), {rows, columns}, fingerprint,
                                 true)
                 .ok())
            std::abort();
        std::ifstream in(path, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        table = (*Container::open(path))->table();
        const auto bytes = std::as_bytes(std::span(text)).subspan(table.bytes());
        chunks.assign(bytes.begin(), bytes.end());
        std::filesystem::remove(path);
    }
    static std::string name() {
        return (std::filesystem::temp_directory_path() / ("orograph-oroc-fuzz-" + std::to_string(getpid())))
            .string();
    }
};

void check_line(const Error& error) {
    if (error.what.empty()) std::abort();
    for (const char c : error.line())
        if (static_cast<unsigned char>(c) < 0x20) std::abort();
}

// A table for bytes: of a graph with up to three levels, its groups, and what is left.
ChunkTable table_for(std::vector<std::byte>& bytes) {
    if (bytes.size() < outline_bytes) bytes.resize(outline_bytes);
    const ClusterOutline outline = outline_from_bytes(bytes);
    const std::uint64_t graph = std::min<std::uint64_t>(bytes.size(),
                                                        outline_bytes + outline.clusters % 4 * level_bytes),
                        groups = std::min<std::uint64_t>(bytes.size() - graph,
                                                         std::uint64_t{outline.groups} * record_bytes);
    ChunkTable table{0,
                     {{ChunkType::graph, 0, 0, graph, 0},
                      {ChunkType::groups, 0, 0, groups, 0},
                      {ChunkType::meshes, 0, 0, bytes.size() - graph - groups, 0}}};
    table.file_bytes = table.place();
    return table;
}

// Makes right what a fuzzer cannot guess, so that the numbers behind it are looked at.
std::string mend(std::vector<std::byte> bytes, const ChunkTable& table) {
    const std::span<std::byte> all(bytes);
    const std::uint64_t groups = table.chunks[1].offset - table.bytes(),
                        meshes = table.chunks[2].offset - table.bytes();
    std::uint64_t next = 0;
    for (std::uint32_t i = 0; i < table.chunks[1].bytes / record_bytes; ++i) {
        const std::uint64_t at = groups + std::uint64_t{i} * record_bytes;
        to_little_endian(next, &bytes[at + 40]);
        const std::uint64_t length = std::min<std::uint64_t>(
            from_little_endian<std::uint32_t>(&bytes[at + 56]), table.chunks[2].bytes - next);
        to_little_endian(static_cast<std::uint32_t>(length), &bytes[at + 56]);
        to_little_endian(xxh64(all.subspan(meshes + next, length), i), &bytes[at + 48]);
        to_little_endian(xxh64(all.subspan(at, record_bytes - 8), i), &bytes[at + record_bytes - 8]);
        next += length;
    }
    const std::vector<std::byte> front = table.to_bytes();
    return test::mended(std::string(reinterpret_cast<const char*>(front.data()), front.size()) +
                        std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

// Pairs of a place and a byte.
std::vector<std::byte> changed(std::vector<std::byte> file, std::span<const std::byte> changes) {
    for (std::size_t i = 0; i + 3 <= changes.size(); i += 3) {
        const std::size_t at = from_little_endian<std::uint16_t>(&changes[i]) % file.size();
        file[at] = changes[i + 2];
    }
    return file;
}

void check_payload(std::span<const std::byte> bytes) {
    if (bytes.size() < 2) return;
    GroupPart part;
    part.group.members = std::to_integer<std::uint32_t>(bytes[0]);
    part.group.made = std::to_integer<std::uint32_t>(bytes[1]);
    if (decode_group(bytes.subspan(2), {rows, columns}, 200, part)) return;
    for (const VertexTriangle& triangle : part.triangles) {
        for (const VertexNumber vertex : triangle)
            if (vertex >= static_cast<VertexNumber>(rows * columns)) std::abort();
    }
    if (!encode_group(part, {rows, columns}, 200).ok() && part.made.empty()) std::abort();
}

bool is_of(const Ground& ground, const ClusterOutline& outline) {
    return outline.fingerprint == ground.fingerprint && outline.posts.rows == rows &&
           outline.posts.columns == columns;
}

// As info --check reads the file.
Result<void> checked(const Ground& ground, const ClusterFile& file) {
    const std::vector<std::uint32_t> nodes = ground.surface.leaf_nodes();
    return file.check(ground.surface, ground.bounds,
                      {static_cast<std::uint32_t>(nodes.size()),
                       [&](std::uint32_t leaf) { return ground.surface.leaf(nodes[leaf]); }});
}

// As a picture reads it, from above; tau_px: 0 for all of the original.
Result<void> drawn(const Ground& ground, const std::shared_ptr<const ClusterFile>& file, double tau_px) {
    ORO_TRY(const std::unique_ptr<RegionClusters> region,
            clusters_of_file(file, 0, ground.field, ground.occluder));
    Camera camera;
    camera.width_px = camera.height_px = 100;
    camera.eye = {46.988, 8.011, 20000.0};
    camera.attitude.pitch_deg = -90.0;
    ORO_TRY(const ClusterChoice choice,
            choose_clusters(*region, camera, {0, 0, 100, 100, {0.5, 0.5}}, tau_px, {}, ground.occluder, {}));
    gpu::ClusterBlock block{};
    for (const std::uint32_t cluster : choice.clusters) ORO_CHECK(region->fill(cluster, {}, block));
    return {};
}

void read_all(const Ground& ground, const std::string& path) {
    auto file = ClusterFile::open(path);
    if (!file.ok()) return check_line(file.error());
    GroupPart part;
    for (std::uint32_t i = 0; i < std::min(file->outline().groups, 3U); ++i) {
        const auto read = file->part(i, part);
        if (!read.ok()) check_line(read.error());
    }
    const auto graph = file->graph(ground.surface, ground.bounds);
    const auto check = checked(ground, *file);
    if (check.ok() != graph.ok()) std::abort();
    const auto shared = std::make_shared<const ClusterFile>(std::move(*file));
    for (const double tau_px : {0.0, 1.0, 100.0}) {
        // A graph of another region's posts is refused for that.
        const auto picture = drawn(ground, shared, tau_px);
        if (!picture.ok()) check_line(picture.error());
        if (!picture.ok() && graph.ok() && is_of(ground, shared->outline())) std::abort();
    }
    if (!graph.ok()) return check_line(graph.error());
    std::size_t whole = 0;
    for (const auto& leaf : ground.surface.leaves()) whole += leaf.size();
    for (const double error_m : {0.0, 10.0, 1.0e3, 1.0e9}) {
        const std::size_t drawn = triangles_of_cut(*graph, cut_by_metres(*graph, error_m));
        if (drawn == 0 || drawn > whole) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    static const Ground ground;
    const auto* const from = reinterpret_cast<const std::byte*>(data);
    std::vector<std::byte> bytes(from + 1, from + size);
    std::string file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (data[0] % 4 == 1) {
        const ChunkTable table = table_for(bytes);
        file = mend(std::move(bytes), table);
    } else if (data[0] % 4 == 2) {
        check_payload(bytes);
        return 0;
    } else if (data[0] % 4 == 3) {
        file = mend(changed(ground.chunks, bytes), ground.table);
    }
    const std::string path = Ground::name();
    std::ofstream(path, std::ios::binary) << file;
    read_all(ground, path);
    std::filesystem::remove(path);
    return 0;
}

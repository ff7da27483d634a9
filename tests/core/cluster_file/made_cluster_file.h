// Cluster graphs written and read, and what their tests share.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"
#include "core/cluster_file/cluster_file.h"
#include "core/cluster_file/cluster_format.h"
#include "core/clusters/cluster_split.h"
#include "tests/core/clusters/cluster_terrain.h"
#include "tests/support/test_data.h"

namespace oro::test {
namespace fs = std::filesystem;

inline constexpr std::uint64_t cluster_fingerprint = 0xfedcba9876543210U;

inline PostCounts posts_of(const ClusterTerrain& terrain) {
    return {terrain.heights.rows, terrain.heights.columns};
}

inline std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
inline void put_bytes(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

inline Result<void> write_clusters(const fs::path& path, const ClusterTerrain& terrain,
                                   const ClusterGraph& graph, int threads = 1) {
    return write_cluster_graph(path, graph, posts_of(terrain), cluster_fingerprint, false, threads);
}

inline Result<ClusterGraph> read_clusters(const fs::path& path, const ClusterTerrain& terrain,
                                          int threads = 1) {
    ORO_TRY(const ClusterFile file, ClusterFile::open(path));
    return file.graph(terrain.surface, terrain.bounds, threads);
}

// The same without the graph in memory.
inline Result<void> check_clusters(const fs::path& path, const ClusterTerrain& terrain, int threads = 1) {
    ORO_TRY(const ClusterFile file, ClusterFile::open(path));
    const std::vector<std::uint32_t> nodes = terrain.surface.leaf_nodes();
    return file.check(terrain.surface, terrain.bounds,
                      {static_cast<std::uint32_t>(nodes.size()),
                       [&](std::uint32_t leaf) { return terrain.surface.leaf(nodes[leaf]); }},
                      threads);
}

// What reading says against a file, whole or group by group; empty: nothing.
inline std::string refusal_of(const fs::path& path, const ClusterTerrain& terrain) {
    const auto read = read_clusters(path, terrain);
    const auto checked = check_clusters(path, terrain, 2);
    const std::string line = read.ok() ? "" : read.error().line();
    EXPECT_EQ(checked.ok() ? "" : checked.error().line(), line);
    return line;
}

// To the bit.
inline void expect_same(const ClusterGraph& a, const ClusterGraph& b) {
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.members, b.members);
    ASSERT_EQ(a.clusters.size(), b.clusters.size());
    EXPECT_EQ(std::memcmp(a.clusters.data(), b.clusters.data(), a.clusters.size() * sizeof(Cluster)), 0);
    ASSERT_EQ(a.groups.size(), b.groups.size());
    for (std::size_t i = 0; i < a.groups.size(); ++i) {
        const ClusterGroup &of_a = a.groups[i], &of_b = b.groups[i];
        EXPECT_EQ(std::memcmp(&of_a.error_m, &of_b.error_m, sizeof(double)), 0) << i;
        EXPECT_EQ(std::memcmp(&of_a.centre, &of_b.centre, sizeof(Ecef)), 0) << i;
        EXPECT_EQ(std::memcmp(&of_a.radius_m, &of_b.radius_m, sizeof(double)), 0) << i;
        EXPECT_EQ(of_a.level, of_b.level);
        EXPECT_EQ(of_a.first_member, of_b.first_member);
        EXPECT_EQ(of_a.members, of_b.members);
        EXPECT_EQ(of_a.first_made, of_b.first_made);
        EXPECT_EQ(of_a.made, of_b.made);
        EXPECT_EQ(of_a.complete, of_b.complete);
    }
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t i = 0; i < a.levels.size(); ++i)
        EXPECT_EQ(std::memcmp(&a.levels[i], &b.levels[i], sizeof(GraphLevel)), 0) << i;
}

}  // namespace oro::test

// Meshes and their graphs as bytes: what is read is what was written, and any bytes are that or refused.
#include "core/mesh_file/mesh_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "tests/support/made_space_meshes.h"

namespace oro {
namespace {

using namespace test;

const LatticeSteps origin{8192000000, 1228800000, 10035200000};  // 4,000, 600 and 4,900 km

struct Packed {
    SpaceMesh mesh;
    MeshGraph graph;
    std::vector<LatticeSteps> places;
    std::vector<std::uint32_t> labels;
    std::vector<std::byte> bytes;
};

std::vector<std::byte> bytes_of(const Packed& packed, const MeshGraph& graph) {
    const Result<std::vector<std::byte>> bytes =
        mesh_to_bytes({origin, packed.places, packed.labels, 7, graph});
    EXPECT_TRUE(bytes.ok()) << (bytes.ok() ? "" : bytes.error().line());
    return bytes.ok() ? *bytes : std::vector<std::byte>();
}

Packed packed_of(SpaceMesh mesh, int threads = 2) {
    Packed packed;
    packed.mesh = std::move(mesh);
    for (const glm::dvec3& at : packed.mesh.vertices)
        packed.places.push_back({origin[0] + std::llround(2048.0 * at.x),
                                 origin[1] + std::llround(2048.0 * at.y),
                                 origin[2] + std::llround(2048.0 * at.z)});
    for (std::size_t i = 0; i < packed.mesh.triangles.size(); ++i)
        packed.labels.push_back(static_cast<std::uint32_t>(i / 40 % 7));
    packed.graph =
        build_mesh_graph(packed.mesh.vertices, packed.mesh.triangles, {4.0e6, 6.0e5, 4.9e6}, {threads});
    packed.bytes = bytes_of(packed, packed.graph);
    return packed;
}

// Each triangle of each cluster by its places, and the label of what it began as; in an order of its own.
using Corner = std::array<std::int64_t, 3>;
using Seen = std::pair<std::array<Corner, 3>, std::uint32_t>;
template <class PlaceOf, class LabelOf>
std::vector<std::vector<Seen>> seen_in(const MeshGraph& graph, const PlaceOf& place, const LabelOf& label) {
    std::vector<std::vector<Seen>> all;
    for (const Cluster& cluster : graph.clusters.clusters) {
        std::vector<Seen>& seen = all.emplace_back();
        for (std::uint32_t i = cluster.first_triangle; i < cluster.first_triangle + cluster.triangles; ++i) {
            std::array<Corner, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k) corners[k] = place(graph.clusters.triangles[i][k]);
            std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
            seen.emplace_back(corners, label(graph.original_of[i]));
        }
        std::sort(seen.begin(), seen.end());
    }
    return all;
}

void expect_same_groups(const ClusterGraph& a, const ClusterGraph& b) {
    ASSERT_EQ(a.groups.size(), b.groups.size());
    EXPECT_EQ(a.members, b.members);
    for (std::size_t i = 0; i < a.groups.size(); ++i) {
        const ClusterGroup &one = a.groups[i], &other = b.groups[i];
        ASSERT_EQ(one.level, other.level);
        ASSERT_EQ(one.first_member, other.first_member);
        ASSERT_EQ(one.members, other.members);
        ASSERT_EQ(one.first_made, other.first_made);
        ASSERT_EQ(one.made, other.made);
        ASSERT_EQ(one.error_m, other.error_m);
        ASSERT_EQ(one.centre.m, other.centre.m);
        ASSERT_EQ(one.radius_m, other.radius_m);
    }
    ASSERT_EQ(a.clusters.size(), b.clusters.size());
    for (std::size_t i = 0; i < a.clusters.size(); ++i) {
        ASSERT_EQ(a.clusters[i].first_triangle, b.clusters[i].first_triangle);
        ASSERT_EQ(a.clusters[i].triangles, b.clusters[i].triangles);
        ASSERT_EQ(a.clusters[i].vertices, b.clusters[i].vertices);
        ASSERT_EQ(a.clusters[i].made_by, b.clusters[i].made_by);
        ASSERT_EQ(a.clusters[i].used_by, b.clusters[i].used_by);
    }
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t i = 0; i < a.levels.size(); ++i) {
        EXPECT_EQ(a.levels[i].triangles_in, b.levels[i].triangles_in);
        EXPECT_EQ(a.levels[i].triangles_out, b.levels[i].triangles_out);
        EXPECT_EQ(a.levels[i].groups, b.levels[i].groups);
        EXPECT_EQ(a.levels[i].clusters_out, b.levels[i].clusters_out);
        EXPECT_EQ(a.levels[i].stuck_groups, b.levels[i].stuck_groups);
        EXPECT_EQ(a.levels[i].largest_group, b.levels[i].largest_group);
        EXPECT_EQ(a.levels[i].largest_error_m, b.levels[i].largest_error_m);
        EXPECT_EQ(a.levels[i].locked, b.levels[i].locked);
    }
}

void expect_whole(const Packed& packed) {
    StoredMesh read;
    const std::optional<std::string> wrong = mesh_from_bytes(packed.bytes, read);
    ASSERT_FALSE(wrong) << *wrong;
    EXPECT_EQ(read.origin, origin);
    EXPECT_EQ(read.places.size(), packed.places.size());
    ASSERT_EQ(read.labels.size(), packed.labels.size());
    expect_same_groups(packed.graph.clusters, read.graph.clusters);
    const auto given = seen_in(
        packed.graph, [&](std::uint32_t i) { return packed.places[i]; },
        [&](std::uint32_t i) { return packed.labels[i]; });
    const auto found = seen_in(
        read.graph, [&](std::uint32_t i) { return read.places[i]; },
        [&](std::uint32_t i) { return read.labels[i]; });
    EXPECT_EQ(given, found);
    // What was read is written as the same bytes.
    const Result<std::vector<std::byte>> again =
        mesh_to_bytes({read.origin, read.places, read.labels, read.label_count, read.graph});
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(*again, packed.bytes);
}

// Numbers and order are those that a reader finds, to the bit; the same from scratch files as from memory.
TEST(MeshBytes, TheWriterKnowsWhatIsRead) {
    ScratchMemory scratch(testing::TempDir());
    for (const SpaceMesh& mesh : {hilly_ball(24, 50.0), box_town(10), folded_sheet(30)}) {
        const Packed packed = packed_of(mesh);
        for (ScratchMemory* const where : {static_cast<ScratchMemory*>(nullptr), &scratch}) {
            constexpr std::uint64_t fingerprint = 77;
            const Result<WrittenMesh> written =
                write_mesh({origin, packed.places, packed.labels, 7, packed.graph, fingerprint}, where);
            ASSERT_TRUE(written.ok());
            StoredMesh read;
            ASSERT_FALSE(mesh_from_bytes(written->bytes, read));
            EXPECT_EQ(written->origin, read.origin);
            EXPECT_TRUE(std::ranges::equal(written->places, read.places));
            EXPECT_TRUE(std::ranges::equal(written->labels, read.labels));
            EXPECT_EQ(written->label_count, read.label_count);
            EXPECT_EQ(written->ground_fingerprint, read.ground_fingerprint);
            EXPECT_TRUE(std::ranges::equal(written->original_of, read.graph.original_of));
            EXPECT_TRUE(std::ranges::equal(written->triangles, read.graph.clusters.triangles));
            expect_same_groups(written->clusters, read.graph.clusters);
            ASSERT_EQ(written->given_vertex.size(), packed.places.size());
            for (std::uint32_t i = 0; i < read.places.size(); ++i)
                ASSERT_EQ(packed.places[written->given_vertex[i]], read.places[i]);
        }
    }
    EXPECT_GT(scratch.bytes().most_in_files, 0U);
    EXPECT_EQ(scratch.bytes().in_files, 0U);
}

TEST(MeshBytes, AreReadAsTheyWereWritten) {
    const std::map<std::string, SpaceMesh> meshes{
        {"ball", hilly_ball(24, 50.0)}, {"town", box_town(10)}, {"sheet", folded_sheet(30)}};
    for (const auto& [name, mesh] : meshes) {
        SCOPED_TRACE(name);
        const Packed packed = packed_of(mesh);
        expect_whole(packed);
        const double share =
            static_cast<double>(packed.bytes.size()) / static_cast<double>(packed.mesh.triangles.size());
        std::printf("%s: %zu triangles, %zu at all levels, %.2f bytes a triangle\n", name.c_str(),
                    packed.mesh.triangles.size(), packed.graph.clusters.triangles.size(), share);
        EXPECT_LT(share, 9.0);
    }
}

// Bytes that do not tell the leaves, and these: the same mesh. With others, or without any: refused.
TEST(MeshBytes, WithLeavesElsewhereAreReadWithThem) {
    for (const SpaceMesh& mesh : {hilly_ball(24, 50.0), box_town(10), folded_sheet(30)}) {
        const Packed packed = packed_of(mesh);
        const MeshToStore store{origin, packed.places, packed.labels, 7, packed.graph};
        const Result<WrittenMesh> written = write_mesh(store, nullptr, LeavesIn::payloads);
        ASSERT_TRUE(written.ok());
        EXPECT_TRUE(has_leaves_elsewhere(written->bytes));
        EXPECT_FALSE(has_leaves_elsewhere(packed.bytes));
        EXPECT_LT(2 * written->bytes.size(), packed.bytes.size());
        StoredMesh whole, read;
        ASSERT_FALSE(mesh_from_bytes(packed.bytes, whole));
        EXPECT_EQ(mesh_from_bytes(written->bytes, read).value_or(""), "has its triangles elsewhere");
        const std::span<const VertexTriangle> triangles = whole.graph.clusters.triangles;
        const MeshLeaves leaves{
            whole.places,
            {triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(whole.labels.size())},
            whole.labels};
        MeshLeaves some = leaves;
        ASSERT_FALSE(mesh_from_bytes(written->bytes, read, &some));
        EXPECT_EQ(read.places, whole.places);
        EXPECT_EQ(read.labels, whole.labels);
        EXPECT_EQ(read.graph.original_of, whole.graph.original_of);
        EXPECT_EQ(read.graph.clusters.triangles, whole.graph.clusters.triangles);
        expect_same_groups(read.graph.clusters, whole.graph.clusters);
        const auto refusal = [&](const auto& change) {
            MeshLeaves other = leaves;
            change(other);
            return mesh_from_bytes(written->bytes, read, &other).value_or("");
        };
        EXPECT_NE(refusal([](MeshLeaves& other) { other.triangles.pop_back(); }).find("expected"),
                  std::string::npos);
        EXPECT_NE(refusal([](MeshLeaves& other) { other.places.pop_back(); }).find("expected"),
                  std::string::npos);
        EXPECT_EQ(refusal([](MeshLeaves& other) { other.labels.back() = 7; }),
                  "has groups of other features than it states");
        EXPECT_EQ(refusal([](MeshLeaves& other) { other.triangles[5][1] = other.triangles[5][0]; }),
                  "has a triangle without an area");
    }
}

TEST(MeshBytes, AreTheSameByAnyNumberOfThreads) {
    const std::vector<std::byte> one = packed_of(hilly_ball(16, 40.0), 1).bytes;
    EXPECT_EQ(one, packed_of(hilly_ball(16, 40.0), 3).bytes);
}

// Edges of three triangles, a vertex of many, triangles that face both ways.
TEST(MeshBytes, TakeSoups) {
    constexpr std::uint64_t seed = 7;
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    std::mt19937_64 random(seed);
    SpaceMesh soup;
    for (int i = 0; i < 60; ++i)
        soup.vertices.push_back(on_lattice({static_cast<double>(random() % 1000) / 10.0,
                                            static_cast<double>(random() % 1000) / 10.0,
                                            static_cast<double>(random() % 1000) / 10.0}));
    for (std::uint32_t i = 0; i < 400; ++i) {
        const auto a = static_cast<std::uint32_t>(random() % 60),
                   b = static_cast<std::uint32_t>(random() % 60);
        const std::uint32_t c = i % 3 == 0 ? 0 : static_cast<std::uint32_t>(random() % 60);
        if (a == b || b == c || c == a) continue;
        soup.triangles.push_back({a, b, c});
    }
    // Vertices without a triangle have no place in a file.
    expect_whole(packed_of(soup));
}

// Links as cuts need them, and errors and spheres that grow.
void expect_a_graph(const StoredMesh& mesh) {
    const ClusterGraph& graph = mesh.graph.clusters;
    for (const Cluster& cluster : graph.clusters) {
        ASSERT_LE(cluster.first_triangle + cluster.triangles, graph.triangles.size());
        ASSERT_TRUE(cluster.made_by == no_group || cluster.made_by < graph.groups.size());
        ASSERT_TRUE(cluster.used_by == no_group || cluster.used_by < graph.groups.size());
        if (cluster.made_by != no_group && cluster.used_by != no_group) {
            const ClusterGroup &below = graph.groups[cluster.made_by], &above = graph.groups[cluster.used_by];
            ASSERT_LT(below.level, above.level);
            ASSERT_GE(above.error_m, below.error_m);
            ASSERT_GE(above.radius_m, below.radius_m);
        }
    }
    for (const VertexTriangle& triangle : graph.triangles)
        for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.places.size());
    for (const std::uint32_t original : mesh.graph.original_of) ASSERT_LT(original, mesh.labels.size());
    for (const std::uint32_t label : mesh.labels) ASSERT_LT(label, mesh.label_count);
}

TEST(MeshBytes, DamagedAreRefusedOrAreAGraph) {
    constexpr std::uint64_t seed = 11;
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    std::mt19937_64 random(seed);
    const Packed packed = packed_of(hilly_ball(14, 30.0));
    StoredMesh read;
    int refused = 0, read_any = 0;
    for (int i = 0; i < 600; ++i) {
        std::vector<std::byte> bytes = packed.bytes;
        const std::size_t at = random() % (i % 3 == 0 ? 120 : bytes.size());
        if (i % 7 == 0)
            bytes.resize(at);
        else
            bytes[at] ^= static_cast<std::byte>(1 + random() % 255);
        if (mesh_from_bytes(bytes, read))
            ++refused;
        else
            ++read_any, expect_a_graph(read);
    }
    std::printf("%d refused, %d read\n", refused, read_any);
    EXPECT_GT(refused, 400);
}

}  // namespace
}  // namespace oro

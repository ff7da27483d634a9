// Files whose checksums are right and whose graph is none: each a clear line.
#include <cmath>
#include <optional>
#include <random>

#include "tests/core/cluster_file/made_cluster_file.h"
#include "tests/support/mended_container.h"

namespace oro {
namespace {

using namespace test;
using cluster_format::record_bytes;

class LyingClusterFile : public testing::Test {
  protected:
    LyingClusterFile() : terrain_(rough_field(47.0, 8.0, 110, 120)), graph_(terrain_.graph) {}

    // What reading says of the graph as it is by now.
    std::string said() {
        for (std::uint32_t level = 1; level <= graph_.levels.size(); ++level) tell_level(level);
        const fs::path path = scratch_folder() / "a.oroc";
        const auto written = write_clusters(path, terrain_, graph_);
        return written.ok() ? refusal_of(path, terrain_) : "not written: " + written.error().line();
    }
    void expect_said(const std::string& words) {
        const std::string line = said();
        EXPECT_NE(line.find(words), std::string::npos) << "found: " << line;
        EXPECT_NE(line.find("a.oroc: is damaged at byte "), std::string::npos) << line;
    }
    // The first group of a level.
    std::uint32_t first_of(std::uint32_t level) const {
        std::uint32_t group = 0;
        while (graph_.groups[group].level < level) ++group;
        return group;
    }
    // Puts other triangles in the place of a cluster's.
    void replace(std::uint32_t number, std::vector<VertexTriangle> triangles) {
        put_in_walk_order(terrain_.surface, triangles);
        Cluster& cluster = graph_.clusters[number];
        const auto at = graph_.triangles.begin() + cluster.first_triangle;
        graph_.triangles.insert(graph_.triangles.erase(at, at + cluster.triangles), triangles.begin(),
                                triangles.end());
        const std::uint32_t fewer = cluster.triangles - static_cast<std::uint32_t>(triangles.size());
        cluster.triangles -= fewer;
        cluster.vertices = static_cast<std::uint32_t>(vertices_by_place(terrain_.surface, triangles).size());
        for (std::size_t i = number + 1; i < graph_.clusters.size(); ++i)
            graph_.clusters[i].first_triangle -= fewer;
    }

    ClusterTerrain terrain_;
    ClusterGraph graph_;

  private:
    // What a level says of itself, as its groups are now: so that it is not that which is found.
    void tell_level(std::uint32_t number) {
        GraphLevel& level = graph_.levels[number - 1];
        level.triangles_out = 0;
        level.largest_error_m = 0.0;
        for (const ClusterGroup& group : graph_.groups) {
            if (group.level != number) continue;
            level.largest_error_m = std::max(level.largest_error_m, group.error_m);
            for (std::uint32_t i = group.first_made; i < group.first_made + group.made; ++i)
                level.triangles_out += graph_.clusters[i].triangles;
        }
        if (number < graph_.levels.size()) graph_.levels[number].triangles_in = level.triangles_out;
    }
};

TEST_F(LyingClusterFile, WithNoLieIsRead) {
    EXPECT_EQ(said(), "");
}

TEST_F(LyingClusterFile, ErrorsThatDoNotGrow) {
    graph_.groups[first_of(3)].error_m *= 0.25;
    expect_said("m, but one below it has ");
}

TEST_F(LyingClusterFile, ErrorsBelowZeroOrNoNumber) {
    graph_.groups[2].error_m = -1.0;
    expect_said("the record of group 2 has error -1.000000 m");
    graph_.groups[2].error_m = std::nan("");
    expect_said("the record of group 2 has a number that is not finite");
}

TEST_F(LyingClusterFile, SpheresThatAreTooSmall) {
    const double right_m = graph_.groups[0].radius_m;
    graph_.groups[0].radius_m = 0.9 * right_m;
    expect_said("group 0 has a sphere of ");
    graph_.groups[0].radius_m = right_m;
    const std::uint32_t above = first_of(3);
    graph_.groups[above].centre.m.x += 1.0;
    expect_said("group " + std::to_string(above) + " has a sphere of ");
}

// A way from a group back to it would need a cluster that the group itself, or one above it, made.
TEST_F(LyingClusterFile, GroupsThatUseWhatTheyMade) {
    ClusterGroup& group = graph_.groups[first_of(2)];
    graph_.members[group.first_member + group.members - 1] = group.first_made;
    expect_said("uses cluster " + std::to_string(group.first_made) + ", expected one of level 1");
}

TEST_F(LyingClusterFile, GroupsThatUseWhatIsFarBelow) {
    const ClusterGroup& group = graph_.groups[first_of(3)];
    const std::uint32_t below = graph_.groups[0].first_made;
    graph_.members[group.first_member] = below;
    expect_said("uses cluster " + std::to_string(below) + " of level 1, expected level 2");
}

TEST_F(LyingClusterFile, UsersThatAreOnNoNextLevel) {
    Cluster& cluster = graph_.clusters[graph_.groups[0].first_made];
    cluster.used_by = 0;
    expect_said("the payload of group 0 has a cluster used by group 0, expected one of level 2");
    cluster.used_by = static_cast<std::uint32_t>(graph_.groups.size());
    expect_said(", expected one of level 2");
    cluster.used_by = no_group;
    expect_said(", expected one of level 2");
}

TEST_F(LyingClusterFile, ClustersThatTwoGroupsUse) {
    const ClusterGroup &one = graph_.groups[0], &other = graph_.groups[1];
    const std::uint32_t member = graph_.members[one.first_member];
    graph_.members[other.first_member] = member;
    expect_said("group 1 uses cluster " + std::to_string(member) + ", which says that it is used by 0");
}

TEST_F(LyingClusterFile, UsersThatDoNotKnowOfIt) {
    const std::uint32_t second = first_of(2);
    Cluster* moved = &graph_.clusters[graph_.members[graph_.groups[second].first_member]];
    moved->used_by = second + 1;
    expect_said("which says that it is used by " + std::to_string(second + 1));
}

TEST_F(LyingClusterFile, HolesInTheGround) {
    const std::uint32_t number = graph_.groups[first_of(2)].first_made;
    const auto was = graph_.triangles_of(graph_.clusters[number]);
    replace(number, {was.begin(), was.end() - 1});
    expect_said("group " + std::to_string(first_of(2)) + " made clusters with another border");
}

TEST_F(LyingClusterFile, GroundTwice) {
    const ClusterGroup& group = graph_.groups[0];
    ASSERT_GE(group.made, 2U);
    const auto other = graph_.triangles_of(graph_.clusters[group.first_made + 1]);
    replace(group.first_made, {other.begin(), other.end()});
    expect_said("group 0 made clusters with another border");
}

// A vertex is gone from a straight border between groups, so that the ground would gape there: nothing that a
// map would show.
TEST_F(LyingClusterFile, VerticesGoneFromABorder) {
    const auto two_at = [&](const ClusterGroup& group,
                            std::uint32_t number) -> std::optional<std::vector<VertexTriangle>> {
        const auto of_cluster = graph_.triangles_of(graph_.clusters[number]);
        std::vector<VertexTriangle> all;
        for (std::uint32_t i = group.first_made; i < group.first_made + group.made; ++i) {
            const auto some = graph_.triangles_of(graph_.clusters[i]);
            all.insert(all.end(), some.begin(), some.end());
        }
        std::size_t twice = 0;
        const auto border = rim_of(all, twice);
        const auto turned = [](VertexTriangle t, VertexNumber first) {
            while (t[0] != first) std::rotate(t.begin(), t.begin() + 1, t.end());
            return t;
        };
        const auto at_rim = [&](VertexNumber number_of) {
            const SurfaceVertex v = terrain_.surface.vertex(number_of);
            return v.row == 0 || v.column == 0 || v.row == 109 || v.column == 119;
        };
        // (v, b, c) and (v, c, a), with a, v, b in a line on the border, and no other triangle at v.
        for (const auto& [v, b] : border) {
            if (at_rim(v)) continue;
            const auto around = std::count_if(all.begin(), all.end(), [&](const VertexTriangle& t) {
                return std::find(t.begin(), t.end(), v) != t.end();
            });
            std::vector<VertexTriangle> here, rest;
            for (const VertexTriangle& t : of_cluster)
                (std::find(t.begin(), t.end(), v) != t.end() ? here : rest).push_back(t);
            if (around != 2 || here.size() != 2) continue;
            for (VertexTriangle& t : here) t = turned(t, v);
            if (here[0][1] != b) std::swap(here[0], here[1]);
            if (here[0][1] != b || here[0][2] != here[1][1]) continue;
            const VertexNumber c = here[0][2], a = here[1][2];
            const OriginalSurface& surface = terrain_.surface;
            if (twice_area(surface.vertex(a), surface.vertex(v), surface.vertex(b)) != 0) continue;
            rest.push_back({a, b, c});
            return rest;
        }
        return std::nullopt;
    };
    for (const ClusterGroup& group : terrain_.graph.groups) {
        for (std::uint32_t i = group.first_made; i < group.first_made + group.made; ++i) {
            if (group.level == graph_.levels.size()) continue;
            const auto changed = two_at(group, i);
            if (!changed) continue;
            replace(i, *changed);
            expect_said(" has lost the edge from vertex ");
            return;
        }
    }
    FAIL() << "no such vertex";
}

// Bytes of a file, changed with checksums made right again.
class MendedClusterFile : public LyingClusterFile {
  protected:
    MendedClusterFile() : path_(scratch_folder() / "a.oroc") {
        EXPECT_TRUE(write_clusters(path_, terrain_, graph_).ok());
        bytes_ = bytes_of(path_);
    }
    template <class T>
    void set(std::size_t at, T number) {
        to_little_endian(number, reinterpret_cast<std::byte*>(&bytes_[at]));
    }
    // Byte of a level, and of a group's record.
    [[nodiscard]] std::size_t level(std::size_t number) const {
        return graph_at + cluster_format::outline_bytes + number * cluster_format::level_bytes;
    }
    [[nodiscard]] std::size_t record(std::uint32_t group) const {
        return level(graph_.levels.size()) + group * record_bytes;
    }
    void mend_and_expect(const std::string& words, std::uint32_t group = 0) {
        const auto bytes = std::as_bytes(std::span(bytes_)).subspan(record(group), record_bytes - 8);
        set(record(group) + record_bytes - 8, xxh64(bytes, group));
        put_bytes(path_, mended(bytes_));
        const std::string line = refusal_of(path_, terrain_);
        EXPECT_NE(line.find(words), std::string::npos) << "found: " << line;
        bytes_ = whole_;
    }
    static constexpr std::size_t graph_at = ChunkTable::header_bytes + 3 * ChunkTable::entry_bytes;
    void SetUp() override { whole_ = bytes_; }

  private:
    fs::path path_;
    std::string bytes_, whole_;
};

TEST_F(MendedClusterFile, HeadersThatNoGraphHas) {
    set(16, std::uint64_t{0});
    mend_and_expect("is unfinished");
    set(8, std::uint32_t{2});
    mend_and_expect("is of version 2 of the region format");
    set(graph_at + 8, std::int32_t{1});
    mend_and_expect("the outline of clusters says 1 x 120 posts");
    set(graph_at + 12, std::int32_t{0x7fffffff});
    mend_and_expect("the outline of clusters says 110 x 2147483647 posts");
    set(graph_at + 24, std::uint32_t{0xfffffff0U});
    mend_and_expect("the outline of clusters says 4294967280 groups; bytes of their records: ");
    set(graph_at + 28, std::uint64_t{1} << 40U);
    mend_and_expect("the outline of clusters says 1099511627776 members");
    set(graph_at + 36, std::uint64_t{7});
    mend_and_expect("have triangles: ");
    set(graph_at + 20, static_cast<std::uint32_t>(graph_.clusters.size() + 1));
    mend_and_expect("have clusters: ");
}

TEST_F(MendedClusterFile, LevelsThatNoGraphHas) {
    set(level(0), std::uint64_t{1} << 60U);
    mend_and_expect("level 1: says ");
    set(level(0) + 16, std::uint64_t{1} << 60U);
    mend_and_expect("level 1: says 1152921504606846976 groups");
    set(level(0) + 48, 12345.0);
    mend_and_expect("but its groups have ");
}

TEST_F(MendedClusterFile, RecordsThatNoGraphHas) {
    set(record(1) + 40, std::uint64_t{1} << 62U);
    mend_and_expect("the record of group 1 has its payload at byte 4611686018427387904", 1);
    set(record(1) + 56, std::uint32_t{0xffffffffU});
    mend_and_expect("4294967295 bytes long, but these have ", 1);
    set(record(1) + 60, std::uint32_t{0xffffffffU});
    mend_and_expect("says 4294967295 members", 1);
    set(record(1) + 64, std::uint32_t{0});
    mend_and_expect("made clusters 0 to ", 1);
    set(record(1) + 64, graph_.groups[1].first_made + 1);
    mend_and_expect("made clusters from number ", 1);
    set(record(1) + 68, std::uint32_t{0xffffffffU});
    mend_and_expect("triangles in 4294967295 clusters", 1);
    set(record(1) + 72, std::uint32_t{0xffffffffU});
    mend_and_expect("says 4294967295 triangles in ", 1);
    set(record(1) + 48, std::uint64_t{1});
    mend_and_expect("the payload of group 1 has checksum ", 1);
}

// The graph of a larger grid, held to be one of a smaller.
TEST_F(LyingClusterFile, PostsAndClustersThatAreNotThere) {
    const fs::path path = scratch_folder() / "a.oroc";
    ASSERT_TRUE(write_clusters(path, terrain_, graph_).ok());
    const auto file = ClusterFile::open(path);
    ASSERT_TRUE(file.ok());
    GroupPart top;
    ASSERT_TRUE(file->part(file->outline().groups - 1, top).ok());
    const auto coded = encode_group(top, {110, 120}, file->outline().clusters);
    ASSERT_TRUE(coded.ok());
    ASSERT_EQ(decode_group(*coded, {110, 120}, file->outline().clusters, top), std::nullopt);
    const auto said_of = [&](const PostCounts& posts, std::uint32_t clusters) {
        return decode_group(*coded, posts, clusters, top).value_or("nothing");
    };
    EXPECT_EQ(said_of({100, 120}, file->outline().clusters),
              "has posts in rows 0 to 109 and columns 0 to 119, expected some of 100 x 120");
    EXPECT_EQ(said_of({110, 119}, file->outline().clusters),
              "has posts in rows 0 to 109 and columns 0 to 119, expected some of 110 x 119");
    top.members = {5, file->outline().clusters};
    top.group.members = 2;
    const auto refused = encode_group(top, {110, 120}, file->outline().clusters);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().line().find("uses cluster "), std::string::npos) << refused.error().line();
}

// Any bytes as a group: words, or a group within its limits.
TEST_F(LyingClusterFile, AnyBytesAsAGroup) {
    std::mt19937_64 random(77);
    for (int i = 0; i < 3000; ++i) {
        std::vector<std::byte> bytes(1 + random() % 200);
        for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() & 0xffU);
        GroupPart part;
        part.group.members = static_cast<std::uint32_t>(random() % 6);
        part.group.made = static_cast<std::uint32_t>(random() % 4);
        if (decode_group(bytes, {110, 120}, 300, part)) continue;
        for (const std::uint32_t member : part.members) EXPECT_LT(member, 300U);
        for (const VertexTriangle& triangle : part.triangles) {
            for (const VertexNumber vertex : triangle) EXPECT_LT(vertex, 110U * 120U);
        }
    }
}

}  // namespace
}  // namespace oro

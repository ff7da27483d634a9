// A cluster graph in a file and back: the same to the bit, and never another one in its stead.
#include <random>

#include "tests/core/cluster_file/made_cluster_file.h"

namespace oro {
namespace {

using namespace test;

void expect_round_trip(const ClusterTerrain& terrain) {
    const fs::path path = scratch_folder() / "a.oroc";
    const auto written = write_clusters(path, terrain, terrain.graph);
    ASSERT_TRUE(written.ok()) << written.error().line();
    const auto read = read_clusters(path, terrain);
    ASSERT_TRUE(read.ok()) << read.error().line();
    expect_same(*read, terrain.graph);
}

TEST(ClusterFile, RoughGround) {
    expect_round_trip(ClusterTerrain(rough_field(47.0, 8.0, 260, 230)));
}

TEST(ClusterFile, GroundWithHoles) {
    expect_round_trip(ClusterTerrain(holed_field(200, 190, 4)));
    expect_round_trip(ClusterTerrain(holed_field(150, 300, 9)));
}

// Parts that touch at points alone, and single triangles.
TEST(ClusterFile, GroundOfScraps) {
    HeightField field = rough_field(47.0, 8.0, 90, 80);
    std::mt19937_64 random(12);
    for (float& H_m : field.H_m) {
        if (random() % 4 == 0) H_m = void_height_m;
    }
    expect_round_trip(ClusterTerrain(std::move(field)));
}

TEST(ClusterFile, FlatGroundAndTinyGrids) {
    expect_round_trip(ClusterTerrain(flat_field(100, 120)));
    for (const auto& [rows, columns] : {std::pair{2, 2}, {2, 40}, {40, 2}, {3, 3}, {9, 10}})
        expect_round_trip(ClusterTerrain(rough_field(47.0, 8.0, rows, columns)));
    expect_round_trip(ClusterTerrain(flat_field(20, 20, void_height_m)));
}

// A window's groups are not all whole, and its posts are counted from its own corner.
TEST(ClusterFile, WindowOfARegion) {
    const HeightField field = rough_field(47.0, 8.0, 200, 170);
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    const GridSurface surface(heights, {64, 120, true, true, false, false, false});
    HeightField region = rough_field(47.0, 8.0, 264, 290);
    const GridBounds bounds(region.grid, heights.highest_steps);
    const ClusterGraph graph = build_cluster_graph(surface, bounds);
    const fs::path path = scratch_folder() / "a.oroc";
    ASSERT_TRUE(write_cluster_graph(path, graph, {200, 170}, 1, false).ok());
    const auto file = ClusterFile::open(path);
    ASSERT_TRUE(file.ok()) << file.error().line();
    EXPECT_EQ(file->outline().fingerprint, 1U);
    const auto read = file->graph(surface, bounds);
    ASSERT_TRUE(read.ok()) << read.error().line();
    expect_same(*read, graph);
    EXPECT_GT(std::count_if(graph.groups.begin(), graph.groups.end(),
                            [](const ClusterGroup& group) { return !group.complete; }),
              0);
}

TEST(ClusterFile, DoesNotDependOnThreads) {
    const ClusterTerrain terrain(holed_field(300, 310, 2));
    const fs::path folder = scratch_folder();
    ASSERT_TRUE(write_clusters(folder / "1", terrain, terrain.graph, 1).ok());
    ASSERT_TRUE(write_clusters(folder / "3", terrain, terrain.graph, 3).ok());
    EXPECT_EQ(bytes_of(folder / "1"), bytes_of(folder / "3"));
    const auto read = read_clusters(folder / "3", terrain, 4);
    ASSERT_TRUE(read.ok()) << read.error().line();
    expect_same(*read, terrain.graph);
}

// In any order, each by itself.
TEST(ClusterFile, GivesSingleGroups) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 150, 140));
    const ClusterGraph& graph = terrain.graph;
    const fs::path path = scratch_folder() / "a.oroc";
    ASSERT_TRUE(write_clusters(path, terrain, graph).ok());
    const auto file = ClusterFile::open(path);
    ASSERT_TRUE(file.ok());
    EXPECT_EQ(file->outline().groups, graph.groups.size());
    EXPECT_EQ(file->bytes(), fs::file_size(path));
    GroupPart part;
    for (std::uint32_t i = file->outline().groups; i-- > 0;) {
        const auto read = file->part(i, part);
        ASSERT_TRUE(read.ok()) << read.error().line();
        const ClusterGroup& group = graph.groups[i];
        EXPECT_EQ(file->group(i)->error_m, group.error_m);
        EXPECT_EQ(part.group.level, group.level);
        const auto members = graph.members_of(group);
        EXPECT_EQ(part.members, std::vector<std::uint32_t>(members.begin(), members.end()));
        ASSERT_EQ(part.made.size(), group.made);
        for (std::uint32_t j = 0; j < group.made; ++j) {
            const Cluster& cluster = graph.clusters[group.first_made + j];
            const auto triangles = graph.triangles_of(cluster);
            EXPECT_TRUE(std::equal(triangles.begin(), triangles.end(),
                                   part.triangles.begin() + part.made[j].first_triangle));
            EXPECT_EQ(part.made[j].used_by, cluster.used_by);
            EXPECT_EQ(part.made[j].vertices, cluster.vertices);
        }
    }
}

// Above the leaves less than 7 bits a triangle, records and all. As measured: 6.4 for jacksboro, 6.2 for
// N46E008.
TEST(ClusterFile, TakesFewBytes) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 400, 400));
    const fs::path path = scratch_folder() / "a.oroc";
    ASSERT_TRUE(write_clusters(path, terrain, terrain.graph).ok());
    const auto file = ClusterFile::open(path);
    ASSERT_TRUE(file.ok());
    EXPECT_LT(8.0 * static_cast<double>(file->bytes()), 7.0 * static_cast<double>(file->outline().triangles));
}

TEST(ClusterFile, IsWrittenWholeOrNotAtAll) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 40, 40));
    const fs::path folder = scratch_folder(), path = folder / "a.oroc", partial = folder / "a.oroc.partial";
    put_bytes(path, "old");
    const auto taken = write_clusters(path, terrain, terrain.graph);
    ASSERT_FALSE(taken.ok());
    EXPECT_NE(taken.error().line().find("exists already"), std::string::npos) << taken.error().line();
    EXPECT_EQ(bytes_of(path), "old");
    put_bytes(partial, "a letter");
    const auto theirs = write_cluster_graph(path, terrain.graph, posts_of(terrain), 0, true);
    ASSERT_FALSE(theirs.ok());
    EXPECT_NE(theirs.error().line().find("holds something else"), std::string::npos);
    EXPECT_EQ(bytes_of(partial), "a letter");
    EXPECT_EQ(bytes_of(path), "old");
    put_bytes(partial, "\x89ORO");  // as broken off
    EXPECT_TRUE(write_cluster_graph(path, terrain.graph, posts_of(terrain), 0, true).ok());
    EXPECT_FALSE(fs::exists(partial));
    EXPECT_EQ(refusal_of(path, terrain), "");
    EXPECT_FALSE(write_clusters("/nowhere/a.oroc", terrain, terrain.graph).ok());
}

// A bit at every byte: found before anything is given out.
TEST(ClusterFile, AFlippedBitAnywhereIsFound) {
    const ClusterTerrain terrain(holed_field(34, 36, 5));
    ASSERT_GE(terrain.graph.levels.size(), 3U);
    const fs::path path = scratch_folder() / "a.oroc";
    ASSERT_TRUE(write_clusters(path, terrain, terrain.graph).ok());
    const std::string whole = bytes_of(path);
    std::mt19937_64 random(15);
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ (1 << random() % 8));
        put_bytes(path, changed);
        ASSERT_NE(refusal_of(path, terrain), "") << "byte " << at << " of " << whole.size();
    }
}

TEST(ClusterFile, ACutOrLongerFileIsFound) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 50, 50));
    const fs::path path = scratch_folder() / "a.oroc";
    ASSERT_TRUE(write_clusters(path, terrain, terrain.graph).ok());
    const std::string whole = bytes_of(path);
    for (std::size_t length = 0; length < whole.size(); length += 1 + length / 40) {
        put_bytes(path, whole.substr(0, length));
        ASSERT_NE(refusal_of(path, terrain), "") << length;
    }
    put_bytes(path, whole + '\0');
    EXPECT_NE(refusal_of(path, terrain), "");
    put_bytes(path, whole);
    EXPECT_EQ(refusal_of(path, terrain), "");
}

TEST(ClusterFile, OverOtherGroundItIsRefused) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 60, 70)), other(rough_field(47.0, 8.0, 60, 71));
    HeightField holed = rough_field(47.0, 8.0, 60, 70);
    post_of(holed, 30, 30) = void_height_m;
    const fs::path path = scratch_folder() / "a.oroc";
    ASSERT_TRUE(write_clusters(path, terrain, terrain.graph).ok());
    EXPECT_NE(refusal_of(path, other).find("was made over 60 x 70 posts"), std::string::npos);
    EXPECT_NE(refusal_of(path, ClusterTerrain(std::move(holed))).find("was made over 8142 triangles"),
              std::string::npos);
}

}  // namespace
}  // namespace oro

// A region with its clusters in one file: read as it was written, and refused in one line when it is not.
#include "core/baked/clustered_file.h"

#include <cstdio>
#include <random>

#include "core/baked/bake.h"
#include "core/cluster_frame/region_clusters.h"
#include "tests/core/cluster_file/made_cluster_file.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

class ClusteredFile : public ::testing::Test {
  protected:
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 130, 140)};
    fs::path folder_ = test::scratch_folder();
    fs::path path_ = folder_ / "whole.oro";

    void SetUp() override {
        BakeOptions how;
        how.path = folder_ / "region.oro";
        how.fingerprint = test::cluster_fingerprint;
        how.overwrite = true;
        const auto baked = bake_region(terrain_.field, how);
        ASSERT_TRUE(baked.ok()) << baked.error().line();
        ASSERT_TRUE(write_cluster_graph(folder_ / "clusters", terrain_.graph, test::posts_of(terrain_),
                                        fingerprint_of(CellSplit::by_posts), true)
                        .ok());
        put(path_, test::bytes_of(folder_ / "region.oro"), test::bytes_of(folder_ / "clusters"));
    }
    static std::uint64_t fingerprint_of(CellSplit split) {
        return surface_fingerprint(test::cluster_fingerprint, split);
    }
    static void put(const fs::path& path, const std::string& region, const std::string& clusters) {
        const std::vector<std::byte> header = clustered_header(region.size(), clusters.size());
        test::put_bytes(path, std::string(reinterpret_cast<const char*>(header.data()), header.size()) +
                                  region + clusters);
    }
    // What opening and reading all of it says; "": nothing.
    [[nodiscard]] std::string refusal(const fs::path& path) const {
        const auto opened = open_baked_file(path);
        if (!opened.ok()) return opened.error().line();
        if (const auto read = opened->region->verify(); !read.ok()) return read.error().line();
        if (!opened->clusters) return "no clusters";
        const auto graph = opened->clusters->graph(terrain_.surface, terrain_.bounds);
        return graph.ok() ? "" : graph.error().line();
    }
};

TEST_F(ClusteredFile, IsReadAsItWasWritten) {
    EXPECT_TRUE(looks_like_clustered_file(path_));
    EXPECT_FALSE(looks_like_clustered_file(folder_ / "region.oro"));
    const auto opened = open_baked_file(path_);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    EXPECT_EQ(refusal(path_), "");
    test::expect_same(*opened->clusters->graph(terrain_.surface, terrain_.bounds), terrain_.graph);
    const auto alone = open_baked_file(folder_ / "region.oro");
    ASSERT_TRUE(alone.ok());
    EXPECT_EQ(alone->clusters, nullptr);
    EXPECT_EQ(alone->region->fingerprint(), opened->region->fingerprint());
}

// What frames are made of: the same from the file as from memory.
TEST_F(ClusteredFile, GivesFramesTheSameClusters) {
    const auto opened = open_baked_file(path_);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const HorizonOccluder occluder = region_shape(terrain_.field, 1.0).occluder;
    auto from_file =
        clusters_of_file(opened->clusters, opened->region->fingerprint(), terrain_.field, occluder);
    auto from_graph = clusters_of_graph(terrain_.graph, terrain_.field, occluder);
    ASSERT_TRUE(from_file.ok() && from_graph.ok());
    for (std::uint32_t cluster = 0; cluster < terrain_.graph.clusters.size(); ++cluster) {
        gpu::ClusterBlock a{}, b{};
        const auto counts = (*from_file)->fill(cluster, {}, a), same = (*from_graph)->fill(cluster, {}, b);
        ASSERT_TRUE(counts.ok() && same.ok());
        EXPECT_EQ(*counts, *same);
        EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << cluster;
        EXPECT_EQ((*from_file)->maker(cluster), terrain_.graph.clusters[cluster].made_by);
    }
    EXPECT_FALSE(clusters_of_file(opened->clusters, 1, terrain_.field, occluder).ok());
}

// Any byte of it, and any end.
TEST_F(ClusteredFile, DamageIsToldInOneLine) {
    constexpr unsigned seed = 331;
    std::mt19937_64 random(seed);
    const std::string whole = test::bytes_of(path_);
    const fs::path damaged = folder_ / "damaged.oro";
    const auto expect_refused = [&](const std::string& bytes, const std::string& what) {
        test::put_bytes(damaged, bytes);
        const std::string line = refusal(damaged);
        EXPECT_NE(line, "") << "seed " << seed << ", " << what;
        EXPECT_EQ(line.find('\n'), std::string::npos);
        EXPECT_NE(line.find("damaged.oro"), std::string::npos) << line;
    };
    for (std::size_t i = 0; i < 240; ++i) {
        const std::size_t at = i < 40 ? i : random() % whole.size();
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        expect_refused(bytes, "byte " + std::to_string(at));
    }
    for (int i = 0; i < 40; ++i) {
        const std::size_t end = i < 8 ? static_cast<std::size_t>(i) * 6 : random() % whole.size();
        if (end >= 8) expect_refused(whole.substr(0, end), "cut off at byte " + std::to_string(end));
    }
    expect_refused(whole + "x", "a byte more");
}

// Parts that are whole, of two regions.
TEST_F(ClusteredFile, ClustersOfAnotherRegionAreRefused) {
    ASSERT_TRUE(write_cluster_graph(folder_ / "others", terrain_.graph, test::posts_of(terrain_),
                                    test::cluster_fingerprint + 1, true)
                    .ok());
    put(path_, test::bytes_of(folder_ / "region.oro"), test::bytes_of(folder_ / "others"));
    EXPECT_NE(refusal(path_).find("its clusters are of another region"), std::string::npos) << refusal(path_);
}

// The same posts, whose cells are split otherwise than the region's: its errors would be those of other
// triangles.
TEST_F(ClusteredFile, ClustersOfOtherDiagonalsAreRefused) {
    ASSERT_EQ(terrain_.field.grid.split, CellSplit::by_posts);
    ASSERT_TRUE(write_cluster_graph(folder_ / "older", terrain_.graph, test::posts_of(terrain_),
                                    fingerprint_of(CellSplit::all_fall), true)
                    .ok());
    put(path_, test::bytes_of(folder_ / "region.oro"), test::bytes_of(folder_ / "older"));
    EXPECT_NE(refusal(path_).find("its clusters are of another region"), std::string::npos) << refusal(path_);
}

}  // namespace
}  // namespace oro

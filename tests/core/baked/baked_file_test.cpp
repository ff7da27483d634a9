// Several grids, or a grid with its clusters, in one file: read as they were written, and refused in one line
// when they are not.
#include "core/baked/baked_file.h"

#include <cstdio>
#include <random>

#include "core/baked/bake.h"
#include "core/cluster_frame/region_clusters.h"
#include "tests/core/cluster_file/made_cluster_file.h"
#include "tests/support/mended_container.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

class BakedFile : public ::testing::Test {
  protected:
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 130, 140)};
    fs::path folder_ = test::scratch_folder();
    fs::path path_ = folder_ / "whole.oro", region_ = folder_ / "region.oro",
             clusters_ = folder_ / "clusters";

    void SetUp() override {
        bake(terrain_.field, region_, test::cluster_fingerprint);
        write_clusters(clusters_, test::cluster_fingerprint);
        join({{region_, 0}, {clusters_, 0}});
    }
    static void bake(const HeightField& field, const fs::path& path, std::uint64_t fingerprint) {
        BakeOptions how;
        how.path = path;
        how.fingerprint = fingerprint;
        how.overwrite = true;
        const auto baked = bake_region(field, how);
        ASSERT_TRUE(baked.ok()) << baked.error().line();
    }
    void write_clusters(const fs::path& path, std::uint64_t fingerprint) const {
        ASSERT_TRUE(
            write_cluster_graph(path, terrain_.graph, test::posts_of(terrain_), fingerprint, true).ok());
    }
    void join(const std::vector<ContainerPart>& parts) const {
        std::string bytes;
        const auto joined = join_containers(parts, [&](std::span<const std::byte> more) {
            bytes.append(reinterpret_cast<const char*>(more.data()), more.size());
            return Result<void>();
        });
        ASSERT_TRUE(joined.ok()) << joined.error().line();
        test::put_bytes(path_, bytes);
    }
    // What opening and reading all of it says; "": nothing.
    [[nodiscard]] std::string refusal(const fs::path& path) const {
        const auto opened = open_baked_file(path);
        if (!opened.ok()) return opened.error().line();
        for (const BakedGrid& grid : *opened) {
            if (const auto read = grid.region->verify(); !read.ok()) return read.error().line();
            if (!grid.clusters) continue;
            const auto graph = grid.clusters->graph(terrain_.surface, terrain_.bounds);
            if (!graph.ok()) return graph.error().line();
        }
        return "";
    }
    [[nodiscard]] std::string refusal_of(const std::string& bytes) const {
        test::put_bytes(folder_ / "damaged.oro", bytes);
        return refusal(folder_ / "damaged.oro");
    }
    // Any byte of it, and any end.
    void expect_damage_to_be_reported() const {
        constexpr unsigned seed = 331;
        std::mt19937_64 random(seed);
        const std::string whole = test::bytes_of(path_);
        const auto expect_refused = [&](const std::string& bytes, const std::string& what) {
            const std::string line = refusal_of(bytes);
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
        for (std::size_t i = 0; i < 40; ++i) {
            const std::size_t end = i < 8 ? i * 6 : random() % whole.size();
            expect_refused(whole.substr(0, end), "cut off at byte " + std::to_string(end));
        }
        expect_refused(whole + "x", "a byte more");
    }
};

TEST_F(BakedFile, HasTheClustersThatWereWritten) {
    const auto opened = open_baked_file(path_);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    ASSERT_EQ(opened->size(), 1U);
    EXPECT_EQ(refusal(path_), "");
    const BakedGrid& grid = opened->front();
    test::expect_same(*grid.clusters->graph(terrain_.surface, terrain_.bounds), terrain_.graph);
    EXPECT_EQ(grid.region->bytes(), fs::file_size(region_));
    EXPECT_EQ(grid.clusters->bytes(), fs::file_size(clusters_));
    const auto alone = open_baked_file(region_);
    ASSERT_TRUE(alone.ok());
    EXPECT_EQ(alone->front().clusters, nullptr);
    EXPECT_EQ(alone->front().region->fingerprint(), grid.region->fingerprint());
}

// What frames are made of: the same from the file as from memory.
TEST_F(BakedFile, GivesFramesTheSameClusters) {
    const auto opened = open_baked_file(path_);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const BakedGrid& grid = opened->front();
    const HorizonOccluder occluder = region_shape(terrain_.field, 1.0).occluder;
    auto from_file = clusters_of_file(grid.clusters, grid.region->fingerprint(), terrain_.field, occluder);
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
    EXPECT_FALSE(clusters_of_file(grid.clusters, 1, terrain_.field, occluder).ok());
}

TEST_F(BakedFile, HasSeveralGridsInTheirOrder) {
    const fs::path other = folder_ / "other.oro";
    bake(test::rough_field(46.0, 9.0, 150, 40), other, 5);
    join({{region_, 1}, {other, 0}});
    const auto opened = open_baked_file(path_);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    ASSERT_EQ(opened->size(), 2U);
    EXPECT_EQ((*opened)[0].rank, 1U);
    EXPECT_EQ((*opened)[0].region->outline().grid.rows(), 130);
    EXPECT_EQ((*opened)[1].rank, 0U);
    EXPECT_EQ((*opened)[1].region->fingerprint(), 5U);
    EXPECT_EQ((*opened)[1].region->bytes(), fs::file_size(other));
    EXPECT_EQ(refusal(path_), "");
    EXPECT_NE(RegionFile::open(path_).error().line().find("holds 2 grids of posts"), std::string::npos);
    expect_damage_to_be_reported();
    // Grids without an order.
    join({{region_, 2}, {other, 0}});
    EXPECT_NE(refusal(path_).find("a chunk of grid 2, which is none of its 2"), std::string::npos)
        << refusal(path_);
    join({{region_, 0}, {other, 0}});
    EXPECT_NE(refusal(path_).find("has a chunk twice"), std::string::npos) << refusal(path_);
}

TEST_F(BakedFile, DamageIsToldInOneLine) {
    expect_damage_to_be_reported();
}

// Parts that are whole, of two regions; and clusters alone.
TEST_F(BakedFile, ClustersOfAnotherRegionAreRefused) {
    write_clusters(folder_ / "others", test::cluster_fingerprint + 1);
    join({{region_, 0}, {folder_ / "others", 0}});
    EXPECT_NE(refusal(path_).find("its clusters are of another region"), std::string::npos) << refusal(path_);
    EXPECT_NE(refusal(clusters_).find("holds no grid of posts"), std::string::npos) << refusal(clusters_);
}

// Groups and meshes that no outline speaks of would be read by nobody, whatever their checksums.
TEST_F(BakedFile, ClustersWithoutTheirOutlineAreRefused) {
    const std::string whole = test::bytes_of(path_);
    ChunkTable table = (*Container::open(path_))->table();
    std::string bodies;
    std::erase_if(table.chunks, [](const Chunk& chunk) { return chunk.type == ChunkType::graph; });
    for (const Chunk& chunk : table.chunks) bodies += whole.substr(chunk.offset, chunk.bytes);
    table.file_bytes = table.place();
    const std::vector<std::byte> begin = table.to_bytes();
    const std::string line =
        refusal_of(std::string(reinterpret_cast<const char*>(begin.data()), begin.size()) + bodies);
    EXPECT_NE(line.find("clusters of grid 0, whose outline the file lacks"), std::string::npos) << line;
}

// A part is copied whole or not at all.
TEST_F(BakedFile, DamagedPartsAreNotJoined) {
    std::string bytes = test::bytes_of(region_);
    bytes[bytes.size() - 5] = static_cast<char>(bytes[bytes.size() - 5] ^ 1);
    test::put_bytes(region_, bytes);
    const std::vector<ContainerPart> parts{{region_, 0}};
    const auto joined = join_containers(parts, [](std::span<const std::byte>) { return Result<void>(); });
    ASSERT_FALSE(joined.ok());
    EXPECT_NE(joined.error().line().find("the chunk of heights has checksum"), std::string::npos);
}

// The header alone differs: each part that is read is as whole as before.
TEST_F(BakedFile, ClustersOfAFileThatIsChangedMeanwhileAreNotRead) {
    const auto opened = open_baked_file(path_);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const ClusterFile& clusters = *opened->front().clusters;
    GroupPart part;
    ASSERT_TRUE(clusters.part(0, part).ok());
    std::string bytes = test::bytes_of(path_);
    test::set_number(bytes, test::chunk_of(path_, ChunkType::outline).offset + 160, -20'000.0F);
    test::put_bytes(path_, test::mended(bytes));
    const auto expect_changed = [&](const auto& read) {
        ASSERT_FALSE(read.ok());
        EXPECT_NE(read.error().line().find("was changed at byte 0"), std::string::npos)
            << read.error().line();
    };
    expect_changed(clusters.part(0, part));
    expect_changed(clusters.group(0));
    expect_changed(clusters.groups());
}

}  // namespace
}  // namespace oro

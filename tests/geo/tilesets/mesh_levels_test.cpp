// Large things of meshes in 3D Tiles: levels that replace each other, each within its geometricError.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/geo/tilesets/level_tiles.h"
#include "tests/support/made_space_meshes.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using namespace test;

constexpr unsigned levels_seed = 20261130;
constexpr std::size_t whole_triangles = 256;

// 9,024 triangles, closed, 100 m wide.
PlacedMesh ball() {
    return placed_mesh(hilly_ball(48, 50.0), {46.58, 8.02, 1500.0}, "ball");
}
const LevelTiles& levels_of_ball() {
    static const LevelTiles levels(ball(), whole_triangles, 4);
    return levels;
}

TEST(MeshLevels, ASurveyHasLevels) {
    const LevelTiles& levels = levels_of_ball();
    expect_levels(levels, 3);
    for (const ReadTile& tile : levels.tiles) {
        EXPECT_LE(tile.features.empty() ? 0 : tile.triangles.size(), 4 * whole_triangles);
        if (tile.features.empty()) continue;
        ASSERT_EQ(tile.normals.size(), tile.posts_m.size());
        EXPECT_EQ(tile.feature_names, std::vector<std::string>{"ball"});
    }
    EXPECT_EQ(levels.written.meshes.tiles, 85U);
    const ReadTile& root = levels.tiles[static_cast<std::size_t>(levels.root)];
    const ReadTile& above = levels.tiles[static_cast<std::size_t>(root.parent)];
    EXPECT_EQ(above.refine, "ADD");
    EXPECT_TRUE(above.uri.empty());
    // The ball is 105 m high and wide at most.
    EXPECT_GT(above.error_m, 100.0);
    EXPECT_LT(above.error_m, 182.0);
}

// 100,000 random places of the ball, and as many drawn ones, in 20 cuts; and two mutants.
TEST(MeshLevels, PlacesAreWithinTheirErrorsInAnyCut) {
    const LevelTiles& levels = levels_of_ball();
    std::mt19937 random(levels_seed);
    const LevelCheck check = check_levels(levels, 20, 5000, 1.0, random);
    print_check(check, levels_seed, 20);
    EXPECT_EQ(check.places, 100000U);
    EXPECT_EQ(check.places_over, 0U);
    EXPECT_EQ(check.drawn_over, 0U);
    const LevelCheck halved = check_levels(levels, 20, 1000, 0.5, random);
    EXPECT_GT(halved.places_over, 0U);
    EXPECT_GT(halved.drawn_over, 0U);
}

TEST(MeshLevels, WhatIsClosedIsClosedInAnyCut) {
    const LevelTiles& levels = levels_of_ball();
    std::mt19937 random(levels_seed);
    std::size_t mixed = 0;
    for (int i = 0; i < 12; ++i) {
        std::vector<int> cut = levels.random_cut_of_levels(random);
        EXPECT_EQ(open_edges(levels, cut), 0U);
        mixed += levels.depth_of(cut.front()) != levels.depth_of(cut.back()) ? 1 : 0;
        if (cut.size() == 1) continue;
        cut.pop_back();
        EXPECT_GT(open_edges(levels, cut), 0U);
    }
    EXPECT_GT(mixed, 1U);
}

// 20 km: vertices of its larger tiles do not fit on the lattice of 2^-11 m with 24 bits.
TEST(MeshLevels, OfAWideSheetAreWithinTheirErrors) {
    SpaceMesh sheet;
    constexpr std::uint32_t across = 51;
    for (std::uint32_t row = 0; row < across; ++row)
        for (std::uint32_t column = 0; column < across; ++column)
            sheet.vertices.emplace_back(400.0 * column, 400.0 * row,
                                        30.0 * std::sin(0.4 * row) * std::cos(0.3 * column));
    for (std::uint32_t row = 0; row + 1 < across; ++row)
        for (std::uint32_t column = 0; column + 1 < across; ++column) {
            const std::uint32_t a = row * across + column, b = a + across;
            sheet.triangles.push_back({a, a + 1, b + 1});
            sheet.triangles.push_back({a, b + 1, b});
        }
    const LevelTiles levels(placed_mesh(sheet, {46.4, 8.05, 500.0}, ""), 100);
    expect_levels(levels, 3);
    std::mt19937 random(levels_seed);
    const LevelCheck check = check_levels(levels, 10, 500, 1.0, random);
    EXPECT_EQ(check.places_over, 0U);
    EXPECT_EQ(check.drawn_over, 0U);
}

// Tiles of the ball may have so few triangles that those above the smallest parts, which must keep their
// borders, have none: then nothing is said to be drawn.
TEST(MeshLevels, WhatNeedsTooManyTrianglesIsNotDrawn) {
    const LevelTiles levels(ball(), whole_triangles, 2, 40);
    std::size_t empty = 0, leaves = 0;
    for (int i = levels.root; i < static_cast<int>(levels.tiles.size()); ++i) {
        const ReadTile& tile = levels.tiles[static_cast<std::size_t>(i)];
        leaves += tile.children.empty() ? tile.triangles.size() : 0;
        if (!tile.uri.empty()) continue;
        ++empty;
        EXPECT_EQ(tile.children.size(), 4U);
        EXPECT_GT(tile.error_m, 170.0);
    }
    EXPECT_GT(empty, 4U);
    EXPECT_EQ(leaves, 9024U);
    std::mt19937 random(levels_seed);
    const LevelCheck check = check_levels(levels, 3, 300, 1.0, random);
    EXPECT_EQ(check.places_over, 0U);
    EXPECT_EQ(check.drawn_over, 0U);
}

TEST(MeshLevels, AreTheSameByAnyNumberOfThreads) {
    const LevelTiles one(ball(), whole_triangles, 1);
    const LevelTiles& other = levels_of_ball();
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(one.folder)) {
        if (!entry.is_regular_file()) continue;
        EXPECT_TRUE(all_bytes(entry.path()) ==
                    all_bytes(other.folder / fs::relative(entry.path(), one.folder)))
            << entry.path();
        ++files;
    }
    EXPECT_GT(files, 20U);
}

}  // namespace
}  // namespace oro

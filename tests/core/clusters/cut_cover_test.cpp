// Every cut covers what the original covers: once, with edges that meet.
#include <gtest/gtest.h>

#include <string>

#include "tests/core/clusters/cut_cover.h"

namespace oro {
namespace {

using namespace test;

void expect_covers(const ClusterTerrain& terrain, std::uint64_t seed) {
    const Whole whole = whole_of(terrain.surface);
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    for (int i = 0; i < 12; ++i) {
        const double error_m = i == 0 ? 0.0 : i == 1 ? 1.0e9 : 0.05 * std::pow(1.0e5, 0.1 * (i - 2));
        SCOPED_TRACE(error_m);
        expect_cover(terrain, whole, cut_by_metres(terrain.graph, error_m));
    }
    for (int i = 0; i < 12; ++i) {
        const double share = std::uniform_real_distribution<double>(0.2, 1.0)(random);
        SCOPED_TRACE(share);
        expect_cover(terrain, whole, cut_of(terrain.graph, random_stands(terrain.graph, random, share)));
    }
}

TEST(ClusterCutCover, RoughGroundIsCoveredOnceByAnyCut) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 201, 173));
    expect_covers(terrain, 20261);
    // There is much between the original and the coarsest.
    EXPECT_EQ(triangles_of(terrain.graph, cut_by_metres(terrain.graph, 0.0)).size(), 2U * 200U * 172U);
    EXPECT_LE(triangles_of(terrain.graph, cut_by_metres(terrain.graph, 1.0e9)).size(), 128U);
    EXPECT_GT(terrain.graph.levels.size(), 10U);
}

// Discrete cuts: all clusters of a level, and no other.
TEST(ClusterCutCover, EachLevelCoversAllOnce) {
    for (const bool holes : {false, true}) {
        const ClusterTerrain terrain(holes ? holed_field(120, 150, 4) : rough_field(47.0, 8.0, 201, 173));
        const Whole whole = whole_of(terrain.surface);
        const auto levels = static_cast<std::uint32_t>(terrain.graph.levels.size());
        std::size_t last = 0, clusters = 0;
        for (std::uint32_t level = 0; level <= levels; ++level) {
            SCOPED_TRACE(level);
            const auto cut = cut_by_level(terrain.graph, level);
            expect_cover(terrain, whole, cut);
            for (const std::uint32_t cluster : cut) {
                const std::uint32_t maker = terrain.graph.clusters[cluster].made_by;
                EXPECT_EQ(maker == no_group ? 0U : terrain.graph.groups[maker].level, level);
            }
            const std::size_t triangles = triangles_of_cut(terrain.graph, cut);
            EXPECT_TRUE(level == 0 || triangles <= last);
            last = triangles;
            clusters += cut.size();
        }
        EXPECT_EQ(clusters, terrain.graph.clusters.size());
        EXPECT_EQ(cut_by_level(terrain.graph, levels + 7), cut_by_level(terrain.graph, levels));
    }
}

TEST(ClusterCutCover, SoIsGroundWithHoles) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const ClusterTerrain terrain(holed_field(120, 150, seed));
        expect_covers(terrain, seed);
        EXPECT_LT(triangles_of(terrain.graph, cut_by_metres(terrain.graph, 1.0e9)).size(), 3000U);
    }
}

TEST(ClusterCutCover, SoAreTinyGrids) {
    for (const auto& [rows, columns] : {std::pair{2, 2}, {2, 4}, {4, 2}, {3, 3}, {9, 9}, {10, 9}, {2, 300}}) {
        SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns));
        const ClusterTerrain terrain(rough_field(47.0, 8.0, rows, columns));
        expect_covers(terrain, 5);
    }
}

TEST(ClusterCutCover, NothingButVoidsIsNothing) {
    HeightField field = flat_field(40, 40);
    std::fill(field.H_m.begin(), field.H_m.end(), void_height_m);
    const ClusterTerrain terrain(std::move(field));
    EXPECT_TRUE(terrain.graph.clusters.empty());
    EXPECT_TRUE(cut_by_metres(terrain.graph, 10.0).empty());
}

// A place at random is in one triangle, asked of all of them.
TEST(ClusterCutCover, PlacesAtRandomAreInOneTriangle) {
    const ClusterTerrain terrain(holed_field(90, 80, 8));
    std::mt19937_64 random(88);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const double error_m : {3.0, 30.0, 300.0}) {
        const auto triangles = triangles_of(terrain.graph, cut_by_metres(terrain.graph, error_m));
        for (int i = 0; i < 2000; ++i) {
            const double row = unit(random) * 89.0, column = unit(random) * 79.0;
            int holding = 0;
            for (const VertexTriangle& triangle : triangles) {
                bool in = true;
                for (std::size_t j = 0; j < 3; ++j) {
                    const SurfaceVertex a = terrain.surface.vertex(triangle[j]);
                    const SurfaceVertex b = terrain.surface.vertex(triangle[(j + 1) % 3]);
                    in = in &&
                         (b.column - a.column) * (row - a.row) - (b.row - a.row) * (column - a.column) > 0.0;
                }
                holding += in ? 1 : 0;
            }
            EXPECT_EQ(holding, terrain.original(row, column) ? 1 : 0) << row << " " << column;
        }
    }
}

}  // namespace
}  // namespace oro

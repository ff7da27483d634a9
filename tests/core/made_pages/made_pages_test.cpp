// Must hold: pages of made terrain that are made when they are asked for are those of pages in memory, but
// for errors and lod spheres, which are never smaller and nested as the choice of levels needs it.
#include "core/made_pages/made_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/made_posts.h"

namespace oro {
namespace {

constexpr int page_nodes = static_cast<int>(gpu::meshlets_per_side);

// An undulation with a slope and a bend, as steep as N is anywhere.
UndulationField some_undulation() {
    UndulationField field;
    field.lat = {4.0, 0.0, 200, -1, 60};
    field.lon = {4.0, 0.0, -20, 1, 120};
    for (int row = 0; row < 60; ++row)
        for (int column = 0; column < 120; ++column)
            field.N_m.push_back(
                static_cast<float>(40.0 + 3.0 * std::sin(0.7 * row) + 4.0 * std::cos(0.5 * column)));
    return field;
}

struct MadeCase {
    const char* name;
    std::int64_t posts_per_deg;
    int rows, columns;
    std::uint32_t octaves, gain, cell_shift;
    int low_m, high_m;
    MadeKind kind{MadeKind::fbm};
};

struct MadeGround {
    MadeTerrain terrain;
    HeightField made, in_memory;
};
MadeGround ground_of(const MadeCase& of) {
    MadeGround ground;
    MadeTerrain& terrain = ground.terrain;
    terrain.kind = of.kind;
    terrain.seed = 11;
    terrain.posts_per_deg = of.posts_per_deg;
    terrain.octaves = of.octaves;
    terrain.gain = of.gain;
    terrain.cell_shift = of.cell_shift;
    terrain.low = of.low_m * 2048;
    terrain.high = of.high_m * 2048;
    terrain.west = 8 * terrain.posts_per_deg;
    terrain.east = terrain.west + of.columns - 1;
    terrain.south = 46 * terrain.posts_per_deg;
    terrain.north = terrain.south + of.rows - 1;
    PostGrid grid;
    const auto per_deg = static_cast<double>(of.posts_per_deg);
    grid.lat = {per_deg, 0.0, terrain.north, -1, of.rows};
    grid.lon = {per_deg, 0.0, terrain.west, 1, of.columns};
    ground.made = made_field(terrain, grid, some_undulation());
    ground.in_memory.grid = grid;
    ground.in_memory.undulation = some_undulation();
    for (const std::int32_t step : test::heights_of(terrain))
        ground.in_memory.H_m.push_back(static_cast<float>(made_step_m * step));
    return ground;
}

std::unique_ptr<RegionPages> pages_of(const HeightField& field) {
    return dynamic_cast<const MadePostSource&>(*field.posts).pages(field);
}

// All nodes of a level, with their places in space.
struct SphereNode {
    bool there{};
    double error_m{}, lod_radius_m{};
    glm::dvec3 centre{0.0};
};
struct NodesOfLevel {
    int rows{}, columns{};
    std::vector<SphereNode> nodes;
    const SphereNode& at(int row, int column) const {
        return nodes[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
};
NodesOfLevel nodes_of(const RegionPages& pages, int level) {
    NodesOfLevel all;
    const LevelGrid grid = level_grid(pages.facts().grid, level);
    all.rows = grid.row.nodes();
    all.columns = grid.column.nodes();
    all.nodes.resize(static_cast<std::size_t>(all.rows) * static_cast<std::size_t>(all.columns));
    const auto block = std::make_unique<gpu::PageBlock>();
    for (int row = 0; row < grid.pages().rows; ++row)
        for (int column = 0; column < grid.pages().columns; ++column) {
            const PageIndex page{row, column, level};
            EXPECT_TRUE(pages.load(page, *block).ok());
            const auto record = pages.record(page);
            EXPECT_TRUE(record.ok());
            for (int i = 0; i < page_nodes * page_nodes; ++i) {
                const int r = row * page_nodes + i / page_nodes, c = column * page_nodes + i % page_nodes;
                if (r >= all.rows || c >= all.columns) continue;
                const gpu::MeshletBounds& node = block->meshlets[i];
                all.nodes[static_cast<std::size_t>(r) * static_cast<std::size_t>(all.columns) +
                          static_cast<std::size_t>(c)] = {
                    node.radius >= 0.0F, static_cast<double>(node.error_m),
                    static_cast<double>(node.lod_radius),
                    record->summary.origin_ecef.m + record->summary.ecef_from_page * glm::dvec3(node.centre)};
            }
        }
    return all;
}

// A node is no better, and its sphere no smaller, than those below it and beside these.
int not_nested(const NodesOfLevel& above, const NodesOfLevel& below) {
    int wrong = 0;
    for (int row = 0; row < above.rows; ++row)
        for (int column = 0; column < above.columns; ++column) {
            const SphereNode& node = above.at(row, column);
            for (int r = 2 * row - 1; r <= 2 * row + 2; ++r)
                for (int c = 2 * column - 1; c <= 2 * column + 2; ++c) {
                    const bool corner =
                        (r < 2 * row || r > 2 * row + 1) && (c < 2 * column || c > 2 * column + 1);
                    if (corner || r < 0 || c < 0 || r >= below.rows || c >= below.columns) continue;
                    const SphereNode& other = below.at(r, c);
                    const bool holds =
                        node.error_m >= other.error_m * (1.0 + 5e-6) &&
                        node.lod_radius_m >= glm::distance(node.centre, other.centre) + other.lod_radius_m;
                    wrong += holds ? 0 : 1;
                }
        }
    return wrong;
}

class MadePagesTest : public ::testing::TestWithParam<MadeCase> {};

TEST_P(MadePagesTest, AreThoseInMemoryWithErrorsThatAreNoSmallerAndNested) {
    const MadeGround ground = ground_of(GetParam());
    const auto made = pages_of(ground.made), truth = pages_in_memory(ground.in_memory, 1.0, 2);
    ASSERT_EQ(made->levels(), truth->levels());
    const auto block = std::make_unique<gpu::PageBlock>(), true_block = std::make_unique<gpu::PageBlock>();
    NodesOfLevel below;
    for (int level = 0; level < made->levels(); ++level) {
        const PageLayout layout = made->layout(level);
        for (int row = 0; row < layout.rows; ++row)
            for (int column = 0; column < layout.columns; ++column) {
                const PageIndex page{row, column, level};
                ASSERT_TRUE(made->load(page, *block).ok());
                ASSERT_TRUE(truth->load(page, *true_block).ok());
                ASSERT_EQ(std::memcmp(block->heights, true_block->heights, sizeof block->heights), 0)
                    << level << ": " << row << ", " << column;
                ASSERT_EQ(std::memcmp(block->sw_ne, true_block->sw_ne, sizeof block->sw_ne), 0)
                    << level << ": " << row << ", " << column;
                const auto record = made->record(page), true_record = truth->record(page);
                ASSERT_TRUE(record.ok() && true_record.ok());
                EXPECT_GE(record->reach_m * 1.0001,
                          glm::distance(record->summary.centre_m, true_record->summary.centre_m) +
                              true_record->summary.radius_m);
                EXPECT_EQ(record->summary.triangles, true_record->summary.triangles);
            }
        const NodesOfLevel here = nodes_of(*made, level), measured = nodes_of(*truth, level);
        std::vector<double> ratios;
        int smaller = 0, unlike = 0;
        for (std::size_t i = 0; i < here.nodes.size(); ++i) {
            unlike += here.nodes[i].there != measured.nodes[i].there ? 1 : 0;
            if (!here.nodes[i].there) continue;
            smaller += here.nodes[i].error_m < measured.nodes[i].error_m ? 1 : 0;
            if (measured.nodes[i].error_m > 0.0)
                ratios.push_back(here.nodes[i].error_m / measured.nodes[i].error_m);
        }
        std::ranges::sort(ratios);
        if (!ratios.empty())
            std::printf("%s, level %d: %zu nodes, error %.2f to %.2f (median %.2f) of the measured one\n",
                        GetParam().name, level, ratios.size(), ratios.front(), ratios.back(),
                        ratios[ratios.size() / 2]);
        EXPECT_EQ(smaller, 0) << "level " << level;
        EXPECT_EQ(unlike, 0) << "level " << level;
        EXPECT_EQ(level > 0 ? not_nested(here, below) : 0, 0) << "level " << level;
        below = here;
    }
}

// Pages by bounds alone, over which a window draws at first.
TEST(PagesByBounds, HaveErrorsThatAreNoSmallerAndNested) {
    for (const MadeKind kind : {MadeKind::fbm, MadeKind::ridged}) {
        const MadeGround ground = ground_of({"", 3600, 600, 701, 9, 536, 22, 0, 3000, kind});
        const std::uint64_t before = blocks_measured_here();
        const auto bounds = made_posts_of(ground.made)->pages_by_bounds(ground.made);
        const auto truth = pages_in_memory(ground.in_memory, 1.0, 2);
        NodesOfLevel below;
        for (int level = 0; level < bounds->levels(); ++level) {
            const NodesOfLevel here = nodes_of(*bounds, level), measured = nodes_of(*truth, level);
            int smaller = 0;
            for (std::size_t i = 0; i < here.nodes.size(); ++i)
                smaller += here.nodes[i].there && here.nodes[i].error_m < measured.nodes[i].error_m ? 1 : 0;
            EXPECT_EQ(smaller, 0) << "level " << level;
            EXPECT_EQ(level > 0 ? not_nested(here, below) : 0, 0) << "level " << level;
            below = here;
        }
        EXPECT_EQ(blocks_measured_here(), before);
    }
}

// Rough to the posts; smooth at the posts; cut off at its highest and lowest heights; with ends within quads.
INSTANTIATE_TEST_SUITE_P(Made, MadePagesTest,
                         ::testing::Values(MadeCase{"rough", 1200, 1409, 1537, 14, 536, 22, -200, 4000},
                                           MadeCase{"smooth", 3600, 600, 701, 9, 536, 22, 0, 3000},
                                           MadeCase{"often cut off", 1200, 1201, 1201, 12, 850, 18, 0, 900},
                                           MadeCase{"ridged", 1200, 1409, 1537, 14, 536, 22, -200, 4000,
                                                    MadeKind::ridged},
                                           MadeCase{"ridged, often cut off", 1200, 1201, 1201, 12, 850, 18, 0,
                                                    900, MadeKind::ridged}),
                         [](const auto& one) { return std::string("Number") + std::to_string(one.index); });

}  // namespace
}  // namespace oro

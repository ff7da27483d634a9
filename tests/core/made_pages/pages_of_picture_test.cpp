// Must hold: pages of made terrain that are for one picture alone draw the same nodes in it, stitched the
// same way, as pages that are for any; and their errors are never smaller there.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <tuple>

#include "core/frame/frame_plan.h"
#include "core/made_pages/made_pages.h"
#include "tests/core/frame/simulated_frame.h"

namespace oro {
namespace {

// Levels 1 to 3 are measured against all posts, 4 to 6 against coarse octaves at every fourth. N is 0.
HeightField made_ground() {
    MadeTerrain terrain;
    terrain.seed = 3;
    terrain.octaves = 10;
    terrain.low = -200 * 2048;
    terrain.high = 4000 * 2048;
    terrain.posts_per_deg = 1200;
    terrain.west = 8 * 1200;
    terrain.east = terrain.west + 2047;
    terrain.south = 46 * 1200;
    terrain.north = terrain.south + 2047;
    PostGrid grid;
    grid.lat = {1200.0, 0.0, terrain.north, -1, terrain.rows()};
    grid.lon = {1200.0, 0.0, terrain.west, 1, terrain.columns()};
    return made_field(terrain, grid, {});
}

// Level, row and column over the level.
using NodeKey = std::tuple<int, int, int>;
struct DrawnFrame {
    std::map<NodeKey, std::uint32_t> seen;  // edges of nodes that show
    std::map<NodeKey, float> error_m;       // of all nodes of the frame's pages
    std::size_t pages{};
};

DrawnFrame drawn_frame_of(const RegionPages& pages, const FrameView& view) {
    std::map<std::array<int, 3>, std::unique_ptr<gpu::PageBlock>> blocks;
    const auto block_of = [&](const PageIndex& page) -> gpu::PageBlock& {
        auto& block = blocks[{page.level, page.row, page.column}];
        if (!block) {
            block = std::make_unique<gpu::PageBlock>();
            EXPECT_TRUE(pages.load(page, *block).ok());
        }
        return *block;
    };
    const auto plan = plan_grid(
        pages,
        [&](const PageIndex& page) { return reinterpret_cast<std::uintptr_t>(block_of(page).meshlets); },
        view);
    EXPECT_TRUE(plan.ok());
    constexpr int side = static_cast<int>(gpu::meshlets_per_side);
    const auto key_of = [&](std::uint32_t page, std::uint32_t node) {
        const PageIndex& index = plan->page_indices[page];
        const int number = static_cast<int>(node);
        return NodeKey{index.level, index.row * side + number / side, index.column * side + number % side};
    };
    DrawnFrame frame;
    frame.pages = plan->page_indices.size();
    for (std::uint32_t page = 0; page < frame.pages; ++page)
        for (std::uint32_t node = 0; node < 256; ++node)
            frame.error_m[key_of(page, node)] = block_of(plan->page_indices[page]).meshlets[node].error_m;
    for (const auto& node : gpu::SimulatedFrame(*plan).choose())
        if (node.is_seen) frame.seen[key_of(node.page, node.meshlet)] = node.edges;
    return frame;
}

TEST(PagesOfPicture, DrawTheNodesOfPagesForAnyPicture) {
    const HeightField field = made_ground();
    const MadePostSource& source = *made_posts_of(field);
    const auto any = source.pages(field);
    constexpr unsigned seed = 53;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::size_t nodes = 0, pages = 0, pages_of_any = 0, coarse = 0;
    for (int eye = 0; eye < 5; ++eye) {
        Camera camera;
        camera.eye = {46.1 + 1.5 * share(random), 8.1 + 1.5 * share(random),
                      3000.0 + 20'000.0 * share(random)};
        camera.attitude = {.heading_deg = 360.0 * share(random), .pitch_deg = -2.0 - 40.0 * share(random)};
        camera.vertical_fov_deg = 10.0 + 40.0 * share(random);
        camera.width_px = 640;
        camera.height_px = 360;
        const FrameView view{camera, Tile{.width_px = 640, .height_px = 360}, eye % 2 == 0 ? 1.0 : 3.0};
        const auto own = source.pages(field, view);
        const DrawnFrame expected = drawn_frame_of(*any, view), found = drawn_frame_of(*own, view);
        EXPECT_EQ(found.seen, expected.seen) << "seed " << seed << ", eye " << eye;
        for (const auto& [node, edges] : found.seen) {
            EXPECT_GE(found.error_m.at(node), expected.error_m.at(node))
                << "seed " << seed << ", eye " << eye;
            coarse += found.error_m.at(node) > expected.error_m.at(node) ? 1 : 0;
        }
        nodes += expected.seen.size();
        pages += found.pages;
        pages_of_any += expected.pages;
    }
    std::printf(
        "5 eyes: %zu nodes seen, %zu of them by coarser posts; %zu pages, %zu of pages for any picture\n",
        nodes, coarse, pages, pages_of_any);
    EXPECT_GT(nodes, 2000U);
    EXPECT_GT(coarse, 100U);
}

}  // namespace
}  // namespace oro

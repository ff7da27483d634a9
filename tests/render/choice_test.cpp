// The GPU's choice of levels against core's own, and what is drawn while pages are missing or memory is
// short.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "core/lod/levels.h"
#include "tests/core/lod/pyramid_region.h"
#include "tests/support/drawn/drawn_scene.h"

namespace oro {
namespace {

constexpr int width_px = 320, height_px = 200;

Camera sized(Camera camera) {
    camera.width_px = width_px;
    camera.height_px = height_px;
    return camera;
}

using NodeKey = std::array<int, 3>;  // level, row, column, over the level

NodeKey node_of(const FramePlan& plan, std::uint32_t node) {
    constexpr int side = static_cast<int>(gpu::meshlets_per_side);
    const PageIndex& page = plan.grids[0].page_indices[node / gpu::meshlets_per_page];
    const int in_page = static_cast<int>(node % gpu::meshlets_per_page);
    return {page.level, page.row * side + in_page / side, page.column * side + in_page % side};
}

class Choice : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {};

// Nodes that the GPU's bits choose equal those of core; edges of all that can be seen are the same.
TEST_P(Choice, IsThatOfCore) {
    constexpr unsigned seed = 301;
    std::mt19937_64 random(seed);
    const test::Region regions[] = {test::Region(test::patchy_field(500, 453)),
                                    test::Region(test::patchy_field(900, 700))};
    std::size_t nodes = 0, pixels = 0, coarse = 0;
    for (const test::Region& region : regions) {
        test::DrawnScene drawn(*gpu_, pages_in_memory(region.field, 1.0, 2), GetParam(), width_px, height_px);
        for (int i = 0; i < 60; ++i) {
            const Camera camera = sized(test::random_camera(random, region));
            const double tau_px = test::taus_px[i % 3];
            const test::DrawnFrame frame = drawn.draw(camera, tau_px);
            std::map<NodeKey, std::uint32_t> wanted;
            for (const DrawnNode& node :
                 select_nodes(region.pyramid, camera, test::whole_picture(camera), tau_px).nodes)
                wanted[{node.level, node.row, node.column}] = node.edges;
            const auto accepted = *drawn.renderer().read_accepted(frame.plan.grids[0].pages.size());
            const auto edges = *drawn.renderer().read_edges(frame.plan.grids[0].pages.size());
            std::map<NodeKey, bool> accepts;
            for (std::uint32_t n = 0; n < frame.plan.grids[0].pages.size() * gpu::meshlets_per_page; ++n)
                accepts[node_of(frame.plan, n)] = (accepted[n / 32] >> (n % 32) & 1U) != 0;
            std::size_t chosen = 0;
            for (const auto& [node, is_accepted] : accepts) {
                const auto above = accepts.find({node[0] + 1, node[1] / 2, node[2] / 2});
                const bool drawn_here = is_accepted && !(above != accepts.end() && above->second);
                chosen += drawn_here ? 1 : 0;
                ASSERT_EQ(drawn_here, wanted.contains(node))
                    << "camera " << i << " level " << node[0] << " node " << node[1] << "," << node[2];
            }
            ASSERT_EQ(chosen, wanted.size()) << "camera " << i;
            ASSERT_EQ(frame.report.counts.nodes_chosen, wanted.size());
            nodes += chosen;
            for (const std::uint32_t id : frame.ids) {
                if (id == 0) continue;
                const std::uint32_t n = (id - 1) / gpu::meshlet_triangles;
                const NodeKey key = node_of(frame.plan, n);
                ASSERT_EQ(edges[n / 8] >> (n % 8 * 4) & 15U, wanted.at(key)) << "camera " << i;
                ++pixels;
                coarse += key[0] > 0 ? 1 : 0;
            }
        }
    }
    std::printf(
        "seed %u: 120 cameras, %zu nodes chosen as by core, edges the same in %zu pixels, %zu of them of "
        "coarser levels\n",
        seed, nodes, pixels, coarse);
    EXPECT_GT(nodes, 10000U);
    EXPECT_GT(pixels, 500000U);
    EXPECT_GT(coarse, 100000U);
}

// Room for some of the pages only: from far to near and back the picture is the same as with room for all.
TEST_P(Choice, AndThePictureAreTheSameWithLittleMemory) {
    const HeightField field = test::patchy_field(1300, 1500);
    test::DrawnScene all(*gpu_, pages_in_memory(field, 1.0, 2), GetParam(), width_px, height_px);
    // Packed, such a page of no whole metres takes some 49,000 bytes.
    const std::uint64_t little =
        test::asked_heights() == HeightStorage::packed ? 48U * 50'000U : 44 * sizeof(gpu::PageBlock);
    test::DrawnScene few(*gpu_, pages_in_memory(field, 1.0, 2), GetParam(), width_px, height_px, little);
    std::size_t pages = 0;
    const std::uint64_t sent_before = few.scene().grids()[0].store().bytes_sent();
    for (int i = 0; i <= 24; ++i) {
        Camera camera;
        camera.width_px = width_px;
        camera.height_px = height_px;
        const double share = std::abs(1.0 - i / 12.0);  // 1 .. 0 .. 1
        camera.eye = {46.45 + 0.01 * i, 8.6 + 0.01 * i, 3500.0 * std::pow(86.0, share)};
        camera.attitude = {15.0 * i, -10.0 - 75.0 * share, 0.0};
        const test::DrawnFrame one = all.draw(camera, 1.0), other = few.draw(camera, 1.0);
        ASSERT_TRUE(other.plan.grids[0].missing.empty())
            << "frame " << i << " needs " << one.plan.grids[0].pages.size() << " pages";
        ASSERT_EQ(one.ids, other.ids) << "frame " << i;
        ASSERT_LE(few.scene().grids()[0].store().bytes(), little);
        pages = std::max(pages, one.plan.grids[0].pages.size());
    }
    std::printf(
        "at most %zu pages in a frame, %zu on the GPU with room for all, %zu with little; %llu bytes sent\n",
        pages, all.scene().grids()[0].store().size(), few.scene().grids()[0].store().size(),
        static_cast<unsigned long long>(few.scene().grids()[0].store().bytes_sent() - sent_before));
    EXPECT_GT(all.scene().grids()[0].store().size(), few.scene().grids()[0].store().capacity())
        << "or the test is too easy";
    EXPECT_GT(few.scene().grids()[0].store().bytes_sent(), all.scene().grids()[0].store().bytes_sent());
}

// Whatever pages are missing, coarser ones stand in: nothing of the ground is lost.
TEST_P(Choice, CoarserPagesStandInForMissingOnes) {
    constexpr unsigned seed = 302;
    std::mt19937_64 random(seed);
    const HeightField field = test::patchy_field(900, 700);
    test::DrawnScene drawn(*gpu_, pages_in_memory(field, 1.0, 2), GetParam(), width_px, height_px);
    const auto ground_of = [](const std::vector<std::uint32_t>& ids) {
        return ids.size() - static_cast<std::size_t>(std::count(ids.begin(), ids.end(), 0U));
    };
    std::size_t stood_in = 0;
    for (int i = 0; i < 40; ++i) {
        Camera camera;
        camera.width_px = width_px;
        camera.height_px = height_px;
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        camera.eye = {46.5 + 0.2 * unit(random), 8.2 + 0.2 * unit(random), 4000.0 + 4000.0 * unit(random)};
        camera.attitude = {360.0 * unit(random), -90.0 + 20.0 * unit(random), 0.0};
        const test::DrawnFrame whole = drawn.draw(camera, 1.0);
        ASSERT_EQ(ground_of(whole.ids), whole.ids.size()) << "camera " << i << " sees more than ground";
        const std::size_t hidden = random();
        GridScene& grid = drawn.scene().grids()[0];
        const FrameView view{camera, test::whole_picture(camera), 1.0};
        const auto plan = plan_grid(
            grid.pages(),
            [&](const PageIndex& page) -> std::uint64_t {
                const std::size_t hash =
                    static_cast<std::size_t>(page.level * 31 + page.row * 7 + page.column) * 2654435761U;
                const bool top = page.level == grid.pages().levels() - 1;
                return !top && (hash ^ hidden) % 3 == 0 ? 0 : grid.store().address(page);
            },
            view, grid.store().coding());
        ASSERT_TRUE(plan.ok());
        stood_in += plan->missing.size();
        ASSERT_TRUE(drawn.renderer().draw(FramePlan{view, {*plan}}, {}).ok());
        const auto ids = *drawn.renderer().read_ids(width_px, height_px);
        ASSERT_EQ(ground_of(ids), ids.size())
            << "camera " << i << ", " << plan->missing.size() << " pages missing";
    }
    std::printf("seed %u: 40 cameras, %zu pages missing, no pixel of ground lost\n", seed, stood_in);
    EXPECT_GT(stood_in, 100U);
}

INSTANTIATE_TEST_SUITE_P(Paths, Choice, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });

}  // namespace
}  // namespace oro

// Must hold: pages of made terrain that are for one picture, or for some, draw the same nodes in these where
// the oracle sees their ground, stitched the same way, as pages that are for any; and their errors are never
// smaller there.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <tuple>
#include <vector>

#include "core/frame/frame_plan.h"
#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"
#include "tests/core/frame/simulated_frame.h"
#include "tests/core/made_pages/made_ground.h"

namespace oro {
namespace {

// Level, row and column over the level.
using NodeKey = std::tuple<int, int, int>;
struct DrawnFrame {
    std::map<NodeKey, std::uint32_t> seen;  // edges of nodes that neither frustum nor horizon hides
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

const TrueGround& true_ground() {
    static const HeightField field = made_ground();
    static const TrueSurface surface(field, 1.0, 1);
    static const TrueGround ground(surface);
    return ground;
}
const TrueGround& true_ridged_ground() {
    static const HeightField field = made_ground(MadeKind::ridged);
    static const TrueSurface surface(field, 1.0, 1);
    static const TrueGround ground(surface);
    return ground;
}

// Those of a frame's nodes whose ground the oracle sees through some of the picture's pixels.
std::map<NodeKey, std::uint32_t> nodes_that_show(const DrawnFrame& frame, const FrameView& view,
                                                 const TrueGround& ground = true_ground()) {
    const Oracle oracle(ground, sight_from(view.camera.eye));
    std::map<NodeKey, std::uint32_t> shown;
    for (double y = 1.5; y < view.camera.height_px; y += 6.0)
        for (double x = 1.5; x < view.camera.width_px; x += 6.0) {
            const auto hit = oracle.first_hit(view.camera.ecef_direction_at({x, y}), 1.0e6);
            if (!hit || hit->from_below) continue;
            for (int level = 0; level < 10; ++level) {
                const auto node =
                    frame.seen.find({level, hit->row >> (level + 3), hit->column >> (level + 3)});
                if (node != frame.seen.end()) shown.insert(*node);
            }
        }
    return shown;
}

class PagesOfPictureOf : public ::testing::TestWithParam<MadeKind> {};

TEST_P(PagesOfPictureOf, DrawTheNodesOfPagesForAnyPicture) {
    const bool is_ridged = GetParam() == MadeKind::ridged;
    const RegionPages& any = is_ridged ? ridged_pages_for_any() : pages_for_any();
    const TrueGround& ground = is_ridged ? true_ridged_ground() : true_ground();
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
        // Of a ground of its own: what is measured for one picture is known to the next.
        const HeightField fresh = made_ground(GetParam());
        const auto own = made_posts_of(fresh)->pages(fresh, {{view}, {}});
        const DrawnFrame expected = drawn_frame_of(any, view), found = drawn_frame_of(*own, view);
        const auto shown = nodes_that_show(expected, view, ground);
        EXPECT_EQ(nodes_that_show(found, view, ground), shown) << "seed " << seed << ", eye " << eye;
        for (const auto& [node, edges] : shown) {
            EXPECT_GE(found.error_m.at(node), expected.error_m.at(node))
                << "seed " << seed << ", eye " << eye;
            coarse += found.error_m.at(node) > expected.error_m.at(node) ? 1 : 0;
        }
        nodes += shown.size();
        pages += found.pages;
        pages_of_any += expected.pages;
    }
    std::printf(
        "5 eyes: %zu nodes seen, %zu of them by coarser posts; %zu pages, %zu of pages for any picture\n",
        nodes, coarse, pages, pages_of_any);
    EXPECT_GT(nodes, 1000U);
    // Bounds of crests decide nothing from so near.
    if (!is_ridged) {
        EXPECT_GT(coarse, 50U);
    }
}
INSTANTIATE_TEST_SUITE_P(Made, PagesOfPictureOf, ::testing::Values(MadeKind::fbm, MadeKind::ridged));

// How many nodes a picture draws otherwise, or with a smaller error, by pages for some pictures than by pages
// for any.
std::size_t nodes_drawn_otherwise(const RegionPages& own, const FrameView& view, std::size_t& nodes) {
    const DrawnFrame expected = drawn_frame_of(pages_for_any(), view), found = drawn_frame_of(own, view);
    std::size_t otherwise = 0;
    const auto expected_nodes = nodes_that_show(expected, view), found_nodes = nodes_that_show(found, view);
    for (const auto& [node, edges] : expected_nodes) {
        const auto same = found_nodes.find(node);
        const bool is_same = same != found_nodes.end() && same->second == edges &&
                             found.error_m.at(node) >= expected.error_m.at(node);
        otherwise += is_same ? 0 : 1;
    }
    for (const auto& [node, edges] : found_nodes) otherwise += expected_nodes.contains(node) ? 0 : 1;
    nodes += expected_nodes.size();
    return otherwise;
}

Camera camera_over_made_ground(double lat_deg, double lon_deg, double heading_deg) {
    Camera camera;
    camera.eye = {lat_deg, lon_deg, 5000.0};
    camera.attitude = {.heading_deg = heading_deg, .pitch_deg = -8.0};
    camera.vertical_fov_deg = 30.0;
    camera.width_px = 320;
    camera.height_px = 180;
    return camera;
}
FrameView view_of(const Camera& camera, double tau_px) {
    return {camera, Tile{.width_px = camera.width_px, .height_px = camera.height_px}, tau_px};
}

// Frames of a film: an eye that flies north and turns.
std::vector<FrameView> flight() {
    std::vector<FrameView> frames;
    for (int i = 0; i < 6; ++i)
        frames.push_back(view_of(camera_over_made_ground(46.3 + 0.2 * i, 8.7, 60.0 * i), 1.0));
    return frames;
}
// Parts of a panorama: an eye that looks all around.
std::vector<FrameView> all_around() {
    std::vector<FrameView> parts;
    for (int i = 0; i < 8; ++i) parts.push_back(view_of(camera_over_made_ground(46.8, 8.9, 45.0 * i), 2.0));
    return parts;
}

TEST(PagesOfPicture, DrawTheNodesOfPagesForAnyInEachOfSeveralPictures) {
    for (const std::vector<FrameView>& pictures : {flight(), all_around()}) {
        const HeightField fresh = made_ground();
        const auto own = made_posts_of(fresh)->pages(fresh, {pictures, {}});
        std::size_t nodes = 0;
        for (const FrameView& view : pictures) {
            EXPECT_EQ(nodes_drawn_otherwise(*own, view, nodes), 0U);
        }
        std::printf("%zu pictures: %zu nodes seen\n", pictures.size(), nodes);
        EXPECT_GT(nodes, 1000U);
    }
}

// What is culled is not measured: pages for all but one of the pictures do not do for that one. So the test
// above would see what is left out of one of them.
TEST(PagesOfPicture, DoNotDoForAPictureThatTheyAreNotFor) {
    const std::vector<FrameView> pictures = flight();
    const HeightField fresh = made_ground();
    const auto of_others = made_posts_of(fresh)->pages(fresh, {{pictures.begin(), pictures.end() - 1}, {}});
    std::size_t nodes = 0;
    EXPECT_GT(nodes_drawn_otherwise(*of_others, pictures.back(), nodes), 10U);
}

// One picture after the other, each of pages of its own, as `shot` with several views: what earlier ones have
// measured makes later ones no worse.
TEST(PagesOfPicture, DrawTheNodesOfPagesForAnyAfterOtherPictures) {
    const HeightField field = made_ground();
    std::size_t nodes = 0;
    for (const FrameView& view : flight()) {
        const auto own = made_posts_of(field)->pages(field, {{view}, {}});
        EXPECT_EQ(nodes_drawn_otherwise(*own, view, nodes), 0U);
    }
    EXPECT_GT(nodes, 1000U);
}

}  // namespace
}  // namespace oro

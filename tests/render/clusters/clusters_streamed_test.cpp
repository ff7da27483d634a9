// Frames of clusters that do not wait for those that they lack.
#include <algorithm>
#include <cstdio>
#include <random>

#include "core/base/parallel.h"
#include "tests/support/drawn/cluster_scene.h"
#include "tests/support/drawn/cracks.h"
#include "tests/support/drawn/streamed_frames.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int streamed_px = test::crack_side_px;

class StreamedClusters : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 260, 310)};

    test::DrawnScene scene(std::uint64_t bytes, std::uint64_t main_bytes = GroupCache::no_limit) {
        return scene_of(terrain_, bytes, main_bytes);
    }
    test::DrawnScene scene_of(const test::ClusterTerrain& terrain, std::uint64_t bytes,
                              std::uint64_t main_bytes = GroupCache::no_limit) {
        test::DrawnScene drawn(*gpu_, pages_in_memory(terrain.field, 1.0, 2), GetParam(), streamed_px,
                               streamed_px);
        test::draw_by_clusters(*gpu_, terrain, drawn.scene(), bytes, {}, main_bytes);
        return drawn;
    }
    static std::size_t ground_in(const std::vector<std::uint32_t>& ids) {
        return ids.size() - static_cast<std::size_t>(std::ranges::count(ids, 0U));
    }
    // Numbers in the graph of what each pixel shows; of background none that is there.
    static std::vector<std::uint32_t> clusters_of(const test::DrawnFrame& frame) {
        std::vector<std::uint32_t> numbers;
        for (const std::uint32_t id : frame.ids)
            numbers.push_back(
                id == 0 ? no_group
                        : frame.plan.grids[0].clusters.drawn[(id - 1) / gpu::cluster_triangles].number);
        return numbers;
    }
    // No background within the terrain, and ground from the first frame that has any pages.
    void expect_whole(const Camera& camera, const test::DrawnFrame& frame) {
        EXPECT_TRUE(frame.plan.grids[0].clusters.on || frame.plan.grids[0].pages.empty());
        if (test::ground_may_be_over_the_eye(terrain_, camera, frame.plan)) return;
        ++looked_at_;
        EXPECT_LT(test::pixel_of_a_hole(camera, frame.ids), 0)
            << "background within the terrain; eye " << camera.eye.lat_deg << "," << camera.eye.lon_deg
            << " h " << camera.eye.h_m << ", " << frame.plan.grids[0].clusters.missing << " missing";
    }
    int looked_at_{0};  // frames
};

constexpr std::uint64_t slot_bytes = sizeof(gpu::ClusterBlock);

// Whatever has come, no frame has a hole; the last is the picture of a scene that waited, to the byte.
TEST_P(StreamedClusters, HaveNoCracksAndEndAsThoseThatAreWaitedFor) {
    constexpr unsigned seed = 341;
    std::mt19937_64 random(seed);
    test::DrawnScene waits = scene(std::uint64_t{64} << 20U), streams = scene(std::uint64_t{64} << 20U);
    int frames = 0, coarser = 0;
    std::size_t ground = 0;
    for (int i = 0; i < 25; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const Camera camera = test::random_camera(random, terrain_.field);
        const double tau_px = i % 3 == 0 ? 4.0 : 1.0;
        const test::StreamedFrames streamed = test::stream_frames(
            streams, camera, tau_px, [&](const test::DrawnFrame& frame) { expect_whole(camera, frame); });
        EXPECT_TRUE(streamed.last.plan.is_settled());
        const auto picture = *streams.renderer().read_picture(streamed_px, streamed_px);
        const test::DrawnFrame waited = waits.draw(camera, tau_px);
        EXPECT_EQ(waited.ids, streamed.last.ids);
        EXPECT_EQ(*waits.renderer().read_picture(streamed_px, streamed_px), picture);
        frames += streamed.frames;
        coarser += streamed.coarser;
        ground += ground_in(waited.ids);
    }
    std::printf("seed %u: 25 eyes, %d frames, %d of them coarser, %d looked at, %zu pixels of ground\n", seed,
                frames, coarser, looked_at_, ground);
    EXPECT_GT(coarser, 3);
    EXPECT_GT(looked_at_, frames / 3);
    EXPECT_GT(ground, 20000U);
}

// With room for the largest cut, and the coarsest clusters, frames come to the same pictures.
TEST_P(StreamedClusters, NeedNoMoreMemoryThanTheirCut) {
    constexpr unsigned seed = 342;
    std::mt19937_64 random(seed);
    test::DrawnScene waits = scene(std::uint64_t{64} << 20U);
    std::vector<Camera> cameras;
    std::size_t most = 0;
    for (int i = 0; i < 12; ++i) {
        cameras.push_back(test::random_camera(random, terrain_.field));
        most = std::max(most, waits.draw(cameras.back(), 1.0).plan.grids[0].clusters.drawn.size());
    }
    const auto clusters = clusters_of_graph(terrain_.graph, terrain_.field,
                                            waits.scene().grids()[0].pages().facts().shape.occluder);
    const std::uint64_t bytes = (most + (*clusters)->roots().size()) * slot_bytes;
    test::DrawnScene streams = scene(bytes);
    for (const Camera& camera : cameras) {
        const test::StreamedFrames streamed = test::stream_frames(
            streams, camera, 1.0, [&](const test::DrawnFrame& frame) { expect_whole(camera, frame); });
        EXPECT_TRUE(streamed.last.plan.is_settled()) << "seed " << seed;
        EXPECT_EQ(waits.draw(camera, 1.0).ids, streamed.last.ids) << "seed " << seed;
        EXPECT_LE(streams.scene().grids()[0].clusters()->store().bytes(), bytes);
    }
}

// With little room for groups that were read these are read again, and the pictures are the same, to the
// byte: streamed or waited for. What is held is no more than that room, or than a frame of that eye needs.
TEST_P(StreamedClusters, HoldNoMoreGroupsThanTheyMayOrAFrameNeeds) {
    constexpr unsigned seed = 344;
    constexpr std::uint64_t main_bytes = 400'000, held_bytes = 300'000, gpu_bytes = std::uint64_t{64} << 20U;
    std::mt19937_64 random(seed);
    test::DrawnScene free = scene(gpu_bytes), waits = scene(gpu_bytes, main_bytes),
                     streams = scene(gpu_bytes, main_bytes);
    const auto held = [](test::DrawnScene& drawn) {
        return drawn.scene().grids()[0].clusters()->groups().bytes();
    };
    EXPECT_EQ(waits.scene().grids()[0].clusters()->groups().most_bytes(), held_bytes);
    std::vector<Camera> cameras;
    for (int i = 0; i < 8; ++i) cameras.push_back(test::random_camera(random, terrain_.field));
    for (int i = 0; i < 24; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const Camera& camera = cameras[static_cast<std::size_t>(i) % cameras.size()];
        test::DrawnScene once = scene(gpu_bytes);
        const test::StreamedFrames alone = test::stream_frames(once, camera, 1.0, [](const auto&) {});
        EXPECT_TRUE(alone.last.plan.is_settled());
        const std::uint64_t needed = held(once);
        const test::DrawnFrame whole = free.draw(camera, 1.0);
        const auto picture = *free.renderer().read_picture(streamed_px, streamed_px);
        const test::DrawnFrame waited = waits.draw(camera, 1.0);
        EXPECT_EQ(waited.ids, whole.ids);
        EXPECT_EQ(*waits.renderer().read_picture(streamed_px, streamed_px), picture);
        EXPECT_LE(held(waits), held_bytes + needed);
        const test::StreamedFrames streamed =
            test::stream_frames(streams, camera, 1.0, [&](const test::DrawnFrame& frame) {
                expect_whole(camera, frame);
                EXPECT_LE(held(streams), held_bytes + needed);
            });
        EXPECT_TRUE(streamed.last.plan.is_settled());
        EXPECT_EQ(streamed.last.ids, whole.ids);
        EXPECT_EQ(*streams.renderer().read_picture(streamed_px, streamed_px), picture);
    }
    EXPECT_GT(held(free), 2 * held_bytes) << "the room binds";
}

// With less a coarser cut is drawn, whole, and the plan says so: streamed or waited for.
TEST_P(StreamedClusters, AreCoarserWithTooLittleMemory) {
    constexpr unsigned seed = 343;
    for (const std::size_t slots : {std::size_t{1}, std::size_t{24}}) {
        std::mt19937_64 random(seed);
        test::DrawnScene few = scene(slots * slot_bytes), waits = scene(slots * slot_bytes);
        int too_little = 0;
        for (int i = 0; i < 12; ++i) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
            const Camera camera = test::random_camera(random, terrain_.field);
            const test::StreamedFrames streamed = test::stream_frames(
                few, camera, 0.5, [&](const test::DrawnFrame& frame) { expect_whole(camera, frame); });
            const test::DrawnFrame waited = waits.draw(camera, 0.5);
            expect_whole(camera, waited);
            for (const FramePlan* const plan : {&streamed.last.plan, &waited.plan}) {
                EXPECT_EQ(plan->is_settled(), plan->grids[0].clusters.without_room == 0);
                EXPECT_EQ(plan->shows_all(), plan->grids[0].clusters.without_room == 0);
                EXPECT_LE(plan->grids[0].clusters.drawn.size(), slots);
            }
            too_little += waited.plan.grids[0].clusters.without_room > 0 ? 1 : 0;
            EXPECT_LE(few.scene().grids()[0].clusters()->store().bytes(), slots * slot_bytes);
        }
        EXPECT_GT(too_little, 3) << slots;
        EXPECT_GT(waits.scene().grids()[0].clusters()->most_without_room(), 0U);
    }
}

// A wall hides most of the region. Where frames tell what they show, each pixel has what it has in the end
// with fewer of the groups; the settled picture is the same, to the byte.
TEST_P(StreamedClusters, BringWhatShowsBeforeWhatIsHidden) {
    constexpr std::uint64_t gpu_bytes = std::uint64_t{64} << 20U, main_bytes = 800'000;
    constexpr double tau_px = 0.125;
    HeightField field = test::rough_field(47.0, 8.0, 700, 310);
    for (int row = 590; row < 593; ++row)
        for (int column = 0; column < 310; ++column) test::post_of(field, row, column) = 8000.0F;
    const test::ClusterTerrain walled(std::move(field));
    Camera camera;
    camera.width_px = camera.height_px = streamed_px;
    camera.vertical_fov_deg = 50.0;
    camera.eye = {47.0 - 640.0 / 1200.0, 8.0 + 130.0 / 1200.0, 4000.0};
    camera.attitude = {5.0, -10.0, 0.0};
    test::DrawnScene waits = scene_of(walled, gpu_bytes);
    const std::vector<std::uint32_t> whole = clusters_of(waits.draw(camera, tau_px));
    const auto picture = *waits.renderer().read_picture(streamed_px, streamed_px);
    // Groups that are here when the pixels are those of the end, and stay so.
    const auto groups_until = [&](bool tells) {
        test::DrawnScene streams = scene_of(walled, gpu_bytes, main_bytes);
        std::size_t groups = 0;
        const auto look = [&](const test::DrawnFrame& frame) {
            if (clusters_of(frame) != whole)
                groups = 0;
            else if (groups == 0)
                groups = streams.scene().grids()[0].clusters()->groups().size();
        };
        const auto streamed = test::stream_frames(streams, camera, tau_px, look, {}, tells, 2000);
        EXPECT_TRUE(streamed.last.plan.is_settled());
        EXPECT_EQ(*streams.renderer().read_picture(streamed_px, streamed_px), picture);
        return groups;
    };
    const std::size_t with_feedback = groups_until(true), without_feedback = groups_until(false);
    std::printf("%zu groups until all is there that shows, %zu where nothing is told\n", with_feedback,
                without_feedback);
    EXPECT_GT(with_feedback, 0U);
    // More readers read what is hidden, too, for want of other work; the order itself is the business of
    // StreamedChoices and ClusterStreams.
    if (thread_count() <= 4) {
        EXPECT_LT(5 * with_feedback, 4 * without_feedback);
    }
}

// An eye that moves always lacks some clusters. With blocks as the fallback no frame is coarser than tau asks for,
// though clusters that were left out alone would take the ground above them along, up to the coarsest. Those
// that come in the end are the cut.
TEST_P(StreamedClusters, FallBackToBlocksWhereTheCutLacksSome) {
    constexpr unsigned seed = 345;
    std::mt19937_64 random(seed);
    constexpr std::uint64_t gpu_bytes = std::uint64_t{64} << 20U;
    test::DrawnScene blocks = scene(gpu_bytes), clusters = scene(gpu_bytes);
    blocks.scene().set_fallback_to_blocks(true);
    int by_blocks = 0, by_clusters = 0;
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const Camera camera = test::random_camera(random, terrain_.field);
        const test::StreamedFrames streamed =
            test::stream_frames(blocks, camera, 1.0, [&](const test::DrawnFrame& frame) {
                const GridPlan& plan = frame.plan.grids[0];
                EXPECT_EQ(plan.clusters.on, plan.clusters.missing == 0 && !plan.pages.empty());
                (plan.clusters.on ? by_clusters : by_blocks) += 1;
                if (!plan.missing.empty()) return;
                EXPECT_LT(test::pixel_of_a_hole(camera, frame.ids), 0);
            });
        EXPECT_TRUE(streamed.last.plan.is_settled());
        EXPECT_EQ(clusters.draw(camera, 1.0).ids, streamed.last.ids);
    }
    std::printf("seed %u: %d frames by blocks, %d by clusters\n", seed, by_blocks, by_clusters);
    EXPECT_GE(by_blocks, 5);
    EXPECT_GE(by_clusters, 5);
}

INSTANTIATE_TEST_SUITE_P(Paths, StreamedClusters, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });

}  // namespace
}  // namespace oro

// Must hold: 68 tiles with 64 MB of terrain on the GPU, from 300 km to the ground and back: within the
// budget, settled, and the same picture as with no limit.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "core/baked/bake.h"
#include "core/baked/baked_file.h"
#include "core/baked/file_pages.h"
#include "core/cluster_frame/region_clusters.h"
#include "core/terrain/ground.h"
#include "geo/opening/open_region.h"
#include "geo/region/region.h"
#include "tests/support/drawn/cracks.h"
#include "tests/support/drawn/streamed_frames.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

class Memory : public test::GpuTest {};

TEST_F(Memory, OfSixtyFourMegabytesIsEnoughForSixtyEightTiles) {
    const auto data = test::real_data("poland");
    if (!data) GTEST_SKIP() << "needs poland";
    RegionRequest request;
    request.paths = {data->string()};
    request.box = *parse_tile_range("N50E012:N55E023");
    auto region = open_region(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    const std::filesystem::path file = test::scratch_folder() / "poland.oro";
    BakeOptions options;
    options.path = file.string();
    options.overwrite = true;
    options.threads = 2;
    const auto baked = bake_region(region->grids[0].field, options);
    ASSERT_TRUE(baked.ok()) << baked.error().line();
    auto opened = RegionFile::open(file.string());
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const auto shared = std::make_shared<const RegionFile>(std::move(opened).value());

    constexpr int width_px = 640, height_px = 360;
    constexpr std::uint64_t budget = 64'000'000;
    test::DrawnScene all(*gpu_, pages_of_file(shared), RasterPath::compute, width_px, height_px,
                         std::uint64_t{1} << 30U);
    test::DrawnScene few(*gpu_, pages_of_file(shared), RasterPath::compute, width_px, height_px, budget);
    constexpr int steps = 24;
    for (int i = 0; i <= steps; ++i) {
        const double share = std::abs(1.0 - 2.0 * i / steps);  // 1 .. 0 .. 1
        Camera camera;
        camera.width_px = width_px;
        camera.height_px = height_px;
        camera.eye = {51.2 + 2.6 * i / steps, 13.5 + 8.5 * i / steps, 0.0};
        const double ground_m =
            ground_h_m(region->grids[0].field, camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0);
        camera.eye.h_m = ground_m + 2.0 * std::pow(1.5e5, share);
        camera.attitude = {15.0 * i, -2.0 - 50.0 * share, 0.0};
        const test::DrawnFrame free = all.draw(camera, 1.0), bound = few.draw(camera, 1.0);
        ASSERT_TRUE(bound.plan.grids[0].missing.empty()) << "frame " << i << " is not settled";
        ASSERT_EQ(free.ids, bound.ids) << "frame " << i;
        ASSERT_LE(few.scene().grids()[0].store().bytes(), budget);
    }
    std::printf(
        "68 tiles, %d frames from 300 km to 2 m and back: %.1f MB on the GPU with a budget of 64, %.1f "
        "without\n",
        steps + 1, static_cast<double>(few.scene().grids()[0].store().bytes()) * 1e-6,
        static_cast<double>(all.scene().grids()[0].store().bytes()) * 1e-6);
    EXPECT_GT(all.scene().grids()[0].store().size(), few.scene().grids()[0].store().capacity())
        << "or the test is too easy";
    std::filesystem::remove(file);
}

// From 300 km over one end of a region to 2 m over its middle, and up again to the other end.
Camera on_the_way(const HeightField& field, int step, int steps, int width_px, int height_px) {
    const PostGrid& grid = field.grid;
    const double share = std::abs(1.0 - 2.0 * step / steps);  // 1 .. 0 .. 1
    const double way = 0.15 + 0.7 * step / steps;
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.eye = {grid.lat.at_deg(0) + way * (grid.lat.at_deg(grid.rows() - 1) - grid.lat.at_deg(0)),
                  grid.lon.at_deg(0) + way * (grid.lon.at_deg(grid.columns() - 1) - grid.lon.at_deg(0)), 0.0};
    const double ground_m = ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0);
    camera.eye.h_m = ground_m + 2.0 * std::pow(1.5e5, share);
    camera.attitude = {15.0 * step, -2.0 - 50.0 * share, 0.0};
    return camera;
}

// A file that is baked beforehand, for that takes long: OROGRAPH_TEST_CLUSTERS names it
// (orograph bake --mesh clusters). Frames that wait and, in the end, frames that do not.
std::uint64_t bytes_of(test::DrawnScene& drawn) {
    return drawn.scene().grids()[0].store().bytes() + drawn.scene().grids()[0].clusters()->store().bytes();
}

// Frames that do not wait.
struct FlownWay {
    int frames{}, coarser{}, looked_at{}, holes{};
};

// From where the flight came to the next eye. settled: ids of what is to be seen there.
void fly_on(test::DrawnScene& flown, const Camera& camera, const std::vector<std::uint32_t>& settled,
            std::uint64_t budget, FlownWay& way) {
    // Where the data end there is background below ground.
    const bool is_whole = test::pixel_of_a_hole(camera, settled) < 0;
    const test::StreamedFrames streamed =
        test::stream_frames(flown, camera, 1.0, [&](const test::DrawnFrame& frame) {
            EXPECT_EQ(frame.plan.grids[0].clusters.without_room, 0U);
            EXPECT_LE(bytes_of(flown), budget);
            way.looked_at += is_whole ? 1 : 0;
            way.holes += is_whole && test::pixel_of_a_hole(camera, frame.ids) >= 0 ? 1 : 0;
        });
    ASSERT_TRUE(streamed.last.plan.is_settled()) << "eye at " << camera.eye.h_m << " m";
    ASSERT_EQ(settled, streamed.last.ids) << "eye at " << camera.eye.h_m << " m";
    way.frames += streamed.frames;
    way.coarser += streamed.coarser;
}

TEST_F(Memory, OfSixtyFourMegabytesIsEnoughForClusters) {
    const char* const path = std::getenv("OROGRAPH_TEST_CLUSTERS");
    if (!path) GTEST_SKIP() << "needs a baked file with clusters";
    const auto grids = open_baked_file(path);
    ASSERT_TRUE(grids.ok()) << grids.error().line();
    const BakedGrid& opened = grids->front();
    ASSERT_TRUE(opened.clusters);
    const auto field = field_in_memory(*opened.region);
    ASSERT_TRUE(field.ok()) << field.error().line();
    constexpr int width_px = 640, height_px = 360;
    constexpr std::uint64_t budget = 64'000'000;
    const auto scene_of = [&](std::uint64_t bytes) {
        auto drawn = std::make_unique<test::DrawnScene>(*gpu_, pages_of_file(opened.region),
                                                        RasterPath::compute, width_px, height_px, bytes / 2);
        auto graph = clusters_of_file(opened.clusters, opened.region->fingerprint(), *field,
                                      drawn->scene().grids()[0].pages().facts().shape.occluder);
        EXPECT_TRUE(graph.ok()) << graph.error().line();
        auto made = ClusterScene::create(*gpu_, std::move(graph).value(), bytes / 2);
        EXPECT_TRUE(made.ok()) << made.error().line();
        drawn->scene().draw_clusters(std::move(made).value());
        return drawn;
    };
    const auto all = scene_of(std::uint64_t{1} << 30U), few = scene_of(budget), flown = scene_of(budget);
    constexpr int steps = 24;
    std::size_t ground = 0;
    FlownWay way;
    for (int i = 0; i <= steps; ++i) {
        const Camera camera = on_the_way(*field, i, steps, width_px, height_px);
        const test::DrawnFrame free = all->draw(camera, 1.0), bound = few->draw(camera, 1.0);
        ASSERT_TRUE(bound.plan.grids[0].clusters.on);
        ASSERT_TRUE(bound.plan.grids[0].missing.empty()) << "frame " << i << " is not settled";
        ASSERT_EQ(free.ids, bound.ids) << "frame " << i;
        ASSERT_LE(bytes_of(*few), budget);
        fly_on(*flown, camera, free.ids, budget, way);
        if (HasFatalFailure()) return;
        ground += bound.ids.size() - static_cast<std::size_t>(std::ranges::count(bound.ids, 0U));
    }
    std::printf(
        "%s: %d frames from 300 km to 2 m and back, %zu pixels of ground: %.1f MB on the GPU with a budget "
        "of "
        "64, %.1f without; %zu of %zu clusters sent again\n",
        path, steps + 1, ground, static_cast<double>(bytes_of(*few)) * 1e-6,
        static_cast<double>(bytes_of(*all)) * 1e-6,
        static_cast<std::size_t>(few->scene().grids()[0].clusters()->store().bytes_sent() -
                                 all->scene().grids()[0].clusters()->store().bytes_sent()) /
            sizeof(gpu::ClusterBlock),
        static_cast<std::size_t>(all->scene().grids()[0].clusters()->store().bytes_sent()) /
            sizeof(gpu::ClusterBlock));
    std::printf(
        "without waiting: %d frames, %d of them coarser, %.1f MB on the GPU; %d holes in the %d that were "
        "looked at\n",
        way.frames, way.coarser, static_cast<double>(bytes_of(*flown)) * 1e-6, way.holes, way.looked_at);
    EXPECT_GT(ground, 100'000U);
    EXPECT_EQ(way.holes, 0);
    EXPECT_GT(way.looked_at, steps);
}

}  // namespace
}  // namespace oro

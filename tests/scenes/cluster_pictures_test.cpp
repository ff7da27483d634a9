// Must hold of pictures that are drawn by clusters: no background shines through, and nothing is farther than
// tau from where it truly is.
#include <algorithm>
#include <array>
#include <cstdio>
#include <random>

#include "core/base/parallel.h"
#include "core/measure/picture_errors.h"
#include "core/truth/view_set.h"
#include "geo/opening/open_region.h"
#include "geo/region/region.h"
#include "render/frame/depth_picture.h"
#include "tests/support/asked_count.h"
#include "tests/support/drawn/cluster_scene.h"
#include "tests/support/drawn/cracks.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/drawn/streamed_frames.h"
#include "tests/support/real_views.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

class ClusterPictures : public test::GpuTest {
  protected:
    // The middle of a tile of the Alps, 601 x 601 posts, for most of the time goes into its graph; nothing
    // where it is not here.
    static std::optional<HeightField> tile() {
        const auto data = test::real_data("alps");
        if (!data) return std::nullopt;
        RegionRequest request;
        request.paths = {data->string()};
        request.box = BoundingBox{8.25, 46.25, 8.75, 46.75};
        auto region = open_region(request);
        EXPECT_TRUE(region.ok()) << region.error().line();
        return std::move(region->grids[0].field);
    }

    void fly(const test::ClusterTerrain& terrain, RasterPath path, std::uint64_t bytes, int cameras,
             unsigned seed) {
        constexpr int side_px = test::crack_side_px;
        const auto scene_of = [&](std::uint64_t cluster_bytes) {
            auto drawn = std::make_unique<test::DrawnScene>(*gpu_, pages_in_memory(terrain.field, 1.0, 2),
                                                            path, side_px, side_px);
            test::draw_by_clusters(*gpu_, terrain, drawn->scene(), cluster_bytes);
            return drawn;
        };
        const auto waits = scene_of(std::uint64_t{256} << 20U), streams = scene_of(bytes);
        std::mt19937_64 random(seed);
        int frames = 0, coarser = 0, looked_at = 0, settled = 0;
        for (int i = 0; i < cameras; ++i) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
            const Camera camera = test::random_camera(random, terrain.field);
            const test::StreamedFrames streamed =
                test::stream_frames(*streams, camera, 1.0, [&](const test::DrawnFrame& frame) {
                    if (test::ground_may_be_over_the_eye(terrain, camera, frame.plan)) return;
                    ++looked_at;
                    EXPECT_LT(test::pixel_of_a_hole(camera, frame.ids), 0)
                        << frame.plan.grids[0].clusters.missing << " missing";
                });
            frames += streamed.frames;
            coarser += streamed.coarser;
            EXPECT_LE(streams->scene().grids()[0].clusters()->store().bytes(), bytes);
            if (streamed.last.plan.grids[0].clusters.without_room > 0) continue;
            EXPECT_TRUE(streamed.last.plan.is_settled());
            EXPECT_EQ(waits->draw(camera, 1.0).ids, streamed.last.ids);
            ++settled;
        }
        std::printf(
            "within N46E008, %s path, %.1f MB for clusters, seed %u: %d eyes, %d frames, %d coarser, %d "
            "looked at, "
            "%d settled\n",
            name_of(path).c_str(), static_cast<double>(bytes) * 1e-6, seed, cameras, frames, coarser,
            looked_at, settled);
        EXPECT_GT(coarser, cameras / 4);
        EXPECT_GT(looked_at, frames / 3);
    }

    void look_for_holes(const char* name, const test::ClusterTerrain& terrain, RasterPath path, int cameras,
                        unsigned seed) {
        constexpr int side_px = test::crack_side_px;
        test::DrawnScene drawn(*gpu_, pages_in_memory(terrain.field, 1.0, 2), path, side_px, side_px);
        test::draw_by_clusters(*gpu_, terrain, drawn.scene(), std::uint64_t{256} << 20U);
        std::mt19937_64 random(seed);
        std::size_t ground = 0;
        int holes = 0;
        for (int i = 0; i < cameras && holes < 6; ++i) {
            const Camera camera = test::random_camera(random, terrain.field);
            const double tau_px = i % 5 == 0 ? 4.0 : 1.0;
            const test::DrawnFrame frame = drawn.draw(camera, tau_px);
            ASSERT_TRUE(frame.plan.grids[0].clusters.on || frame.plan.grids[0].pages.empty());
            ground += static_cast<std::size_t>(side_px * side_px - std::ranges::count(frame.ids, 0U));
            const int hole = test::pixel_of_a_hole(camera, frame.ids);
            if (hole < 0) continue;
            ++holes;
            ADD_FAILURE() << name << ", camera " << i << ": background within the terrain at pixel "
                          << hole % side_px << "," << hole / side_px << "; eye " << camera.eye.lat_deg << ","
                          << camera.eye.lon_deg << " h " << camera.eye.h_m << " tau " << tau_px;
        }
        std::printf(
            "%s, %s path, seed %u: %d cameras, %zu pixels of ground, pictures with background in them: %d\n",
            name, name_of(path).c_str(), seed, cameras, ground, holes);
        EXPECT_GT(ground, static_cast<std::size_t>(cameras) * 1000U);
    }
};

int camera_count() {
    return test::asked_count("OROGRAPH_TEST_CAMERAS", 500);
}

TEST_F(ClusterPictures, HaveNoCracks) {
    const test::ClusterTerrain made(test::rough_field(47.0, 8.0, 500, 600));
    for (const RasterPath path : {RasterPath::mesh, RasterPath::compute})
        look_for_holes("made terrain", made, path, camera_count() / 4, 321);
}

TEST_F(ClusterPictures, OfTheAlpsHaveNoCracks) {
    auto field = tile();
    if (!field) GTEST_SKIP() << "needs the tiles of the Alps";
    const test::ClusterTerrain alps(std::move(*field));
    for (const RasterPath path : {RasterPath::mesh, RasterPath::compute})
        look_for_holes("within N46E008", alps, path, camera_count() / 4, 322);
}

// Frames of a flight that do not wait, and with room for few clusters besides: no crack while any are
// missing, and the picture that waiting gives in the end.
TEST_F(ClusterPictures, HaveNoCracksWhileTheyStream) {
    auto field = tile();
    if (!field) GTEST_SKIP() << "needs the tiles of the Alps";
    const test::ClusterTerrain alps(std::move(*field));
    for (const RasterPath path : {RasterPath::mesh, RasterPath::compute}) {
        fly(alps, path, std::uint64_t{64} << 20U, camera_count() / 25, 323);
        fly(alps, path, 400 * sizeof(gpu::ClusterBlock), camera_count() / 25, 324);
    }
}

TEST_F(ClusterPictures, AreWithinTau) {
    auto field = tile();
    if (!field) GTEST_SKIP() << "needs the tiles of the Alps";
    constexpr int width_px = 256, height_px = 144;
    const test::ClusterTerrain alps(std::move(*field));
    auto made = Scene::create(*gpu_, pages_in_memory(alps.field, 1.0, 2), {std::uint64_t{512} << 20U, 0});
    ASSERT_TRUE(made.ok()) << made.error().line();
    Scene scene = std::move(made).value();
    test::draw_by_clusters(*gpu_, alps, scene, std::uint64_t{256} << 20U);
    const TrueSurface surface(alps.field, 1.0, thread_count());
    DepthPainter painter(*gpu_, RasterPath::compute);
    const int views = test::view_count(5);
    double largest_over_px = -1.0;
    std::uint64_t triangles = 0, pixels = 0;
    for (const Camera& camera : made_cameras(test::real_view_seed, alps.field, views, width_px, height_px)) {
        const Sight sight = sight_from(camera.eye);
        const TruePicture truth(surface, sight, camera, thread_count());
        for (const double tau_px : {0.5, 1.0, 2.0, 4.0}) {
            DepthPictureOptions options;
            options.tau_px = tau_px;
            const auto picture = painter.draw(scene, camera, {}, options);
            ASSERT_TRUE(picture.ok()) << picture.error().line();
            const PictureErrors errors =
                picture_errors(truth, picture->points, picture->skylines(), thread_count());
            const double over_px = errors.largest_px() - tau_px;
            largest_over_px = std::max(largest_over_px, over_px - errors.slack_px);
            triangles += picture->report.counts.triangles_drawn;
            pixels += errors.ground.drawn;
            EXPECT_LE(over_px, errors.slack_px)
                << "tau " << tau_px << ", eye " << camera.eye.lat_deg << "," << camera.eye.lon_deg << " h "
                << camera.eye.h_m << " heading " << camera.attitude.heading_deg << ": displacement "
                << errors.ground.summary_displacement_px.largest << " px, seen "
                << errors.seen.summary_px.largest << " px, skyline " << errors.skyline.summary_px.largest
                << " px";
        }
    }
    std::printf(
        "within N46E008, seed %llu, %d views at tau 0.5, 1, 2, 4: %llu pixels of ground, %llu triangles, "
        "largest "
        "error less tau and what drawing rounds off: %.3f px\n",
        static_cast<unsigned long long>(test::real_view_seed), views, static_cast<unsigned long long>(pixels),
        static_cast<unsigned long long>(triangles), largest_over_px);
    EXPECT_GT(pixels, static_cast<std::uint64_t>(views) * width_px * height_px);
}

}  // namespace
}  // namespace oro

// What a pixel is coloured from: the mean of the ground that it covers, against 64 samples of the finest
// posts.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "apps/view/style.h"
#include "core/frame/casters.h"
#include "core/lod/ground_means.h"
#include "render/frame/picture_renderer.h"
#include "tests/styles/region_with_means.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/drawn/made_renderer.h"
#include "tests/support/drawn/region_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

constexpr int width_px = 96, height_px = 72, samples = 64;

class Footprint : public test::GpuTest {
  protected:
    void SetUp() override {
        const auto alps = test::real_data("alps");
        if (!alps) GTEST_SKIP() << "needs alps";
        GpuTest::SetUp();
        ASSERT_NO_FATAL_FAILURE(
            test::open_with_means(*gpu_, {(*alps / "N46E007.SRTMGL3.hgt.zip").string()}, region_, scene_));
        FrameRendererOptions options;
        options.extent = {width_px, height_px};
        options.several_samples = true;
        options.path = RasterPath::compute;
        auto renderer = FrameRenderer::create(*gpu_, options);
        ASSERT_TRUE(renderer.ok()) << renderer.error().line();
        renderer_.emplace(std::move(*renderer));
        options.several_samples = false;
        options.smooth_edges = true;
        auto single = FrameRenderer::create(*gpu_, options);
        ASSERT_TRUE(single.ok()) << single.error().line();
        single_.emplace(std::move(*single));
    }
    void TearDown() override {
        renderer_.reset();
        single_.reset();
        scene_.reset();
        GpuTest::TearDown();
    }

    gpu::FrameStyle style(const char* name, double azimuth_deg, double elevation_deg) {
        View view;
        view.style = name;
        view.sun = SunDirection{azimuth_deg, elevation_deg};
        auto style = load_style(view, region_.grids[0].field);
        EXPECT_TRUE(style.ok()) << style.error().line();
        return style->frame;
    }

    std::vector<std::uint8_t> picture(const Camera& camera, gpu::FrameStyle style, gpu::uint footprint,
                                      double tau_px, int count) {
        style.footprint = footprint;
        scene_->set_footprint_spacing(means_spacing_px(style));
        FrameRenderer& renderer = count == 1 ? *single_ : *renderer_;
        for (int i = 0; i < count; ++i) {
            auto plan = scene_->settled_plan(
                {camera, {0, 0, camera.width_px, camera.height_px, sample_place(i, count)}, tau_px});
            EXPECT_TRUE(plan.ok()) << plan.error().line();
            const auto drawn = renderer.draw(std::move(*plan), style, static_cast<std::uint32_t>(i),
                                             static_cast<std::uint32_t>(count));
            EXPECT_TRUE(drawn.ok()) << drawn.error().line();
        }
        auto rgba = renderer.read_picture(static_cast<std::uint32_t>(camera.width_px),
                                          static_cast<std::uint32_t>(camera.height_px));
        EXPECT_TRUE(rgba.ok());
        return std::move(*rgba);
    }

    // Mean difference of pixels that are all ground, 8-bit codes.
    static double difference(const std::vector<std::uint8_t>& one, const std::vector<std::uint8_t>& truth) {
        double sum = 0.0, count = 0.0;
        for (std::size_t i = 0; i < truth.size(); i += 4) {
            if (truth[i + 3] != 255 || one[i + 3] != 255) continue;
            for (std::size_t k = i; k < i + 3; ++k) sum += std::abs(one[k] - truth[k]);
            count += 3.0;
        }
        EXPECT_GT(count, 3000.0);
        return sum / count;
    }

    // Pixels, all ground, with a channel that differs by more than this; and how many there are in all.
    static std::pair<int, int> far_off(const std::vector<std::uint8_t>& one,
                                       const std::vector<std::uint8_t>& truth, int codes) {
        int off = 0, all = 0;
        for (std::size_t i = 0; i < truth.size(); i += 4) {
            if (truth[i + 3] != 255 || one[i + 3] != 255) continue;
            int most = 0;
            for (std::size_t k = i; k < i + 3; ++k) most = std::max(most, std::abs(one[k] - truth[k]));
            off += most > codes ? 1 : 0;
            ++all;
        }
        return {off, all};
    }

    // At tau 1 and 0, with smooth edges as pictures have them; beside them what the ground in each pixel's
    // middle gives.
    double hold(const char* what, const Camera& camera, const gpu::FrameStyle& style, double bound) {
        const auto truth = picture(camera, style, gpu::footprint_finest, 0.0, samples);
        const double point = difference(picture(camera, style, gpu::footprint_point, 1.0, 1), truth);
        for (const double tau_px : {1.0, 0.0}) {
            const double mean = difference(picture(camera, style, gpu::footprint_mean, tau_px, 1), truth);
            EXPECT_LE(mean, bound) << what << ", tau " << tau_px;
            std::printf("%-28s tau %.0f: %.2f codes (the middle alone %.2f)\n", what, tau_px, mean, point);
        }
        return point;
    }

    static Camera over(double lat_deg, double lon_deg, double h_m, double heading_deg, double pitch_deg,
                       double fov_deg) {
        return Camera{{lat_deg, lon_deg, h_m}, {heading_deg, pitch_deg, 0.0}, fov_deg, width_px, height_px};
    }
    // The middle of a picture, two thirds of its width and height: fewer pixels, each of as much ground.
    static Camera middle_of(Camera camera) {
        const double half = std::tan(0.5 * camera.vertical_fov_deg * std::numbers::pi / 180.0);
        camera.vertical_fov_deg = 2.0 * std::atan(half * 2.0 / 3.0) * 180.0 / std::numbers::pi;
        camera.width_px = 2 * width_px / 3;
        camera.height_px = 2 * height_px / 3;
        return camera;
    }

    Region region_{std::vector<RegionGrid>(1)};
    std::optional<Scene> scene_;
    std::optional<FrameRenderer> renderer_;
    std::optional<FrameRenderer> single_;
};

// 60 km up a pixel has 8 x 6 posts.
TEST_F(Footprint, IsTheMeanOfSixtyFourSamples) {
    const gpu::FrameStyle natural = style("natural", 315.0, 38.0);
    const double point =
        hold("natural, straight down", middle_of(over(46.5, 7.5, 60000.0, 0.0, -90.0, 45.0)), natural, 2.0);
    EXPECT_GT(point, 3.0) << "what is held here is no trouble";
    hold("natural, oblique", over(46.2, 7.5, 20000.0, 0.0, -30.0, 30.0), natural, 2.0);
    hold("natural, low", over(46.1, 7.5, 4500.0, 0.0, -6.0, 30.0), natural, 2.0);
    hold("natural, from 97 km", over(45.8, 7.5, 60000.0, 0.0, -38.0, 40.0), natural, 2.0);
    hold("natural, low sun", middle_of(over(46.4, 7.5, 40000.0, 0.0, -70.0, 45.0)),
         style("natural", 270.0, 15.0), 2.0);
}

// One line towards the sun tells of one place; of the many posts in a far pixel most may see it otherwise.
TEST_F(Footprint, ShadowsOfFarGroundAreNoSpeckle) {
    const Camera far = over(45.8, 7.5, 60000.0, 0.0, -38.0, 40.0);
    for (const auto& [azimuth_deg, elevation_deg, most_off, most_codes] :
         {std::array{315.0, 38.0, 0.015, 2.0}, std::array{250.0, 25.0, 0.03, 2.6}}) {
        gpu::FrameStyle natural = style("natural", azimuth_deg, elevation_deg);
        ASSERT_EQ(natural.shadows, 1U);
        scene_->set_shadow_request(shadow_request(natural));
        const auto truth = picture(far, natural, gpu::footprint_finest, 0.0, samples);
        const auto one = picture(far, natural, gpu::footprint_mean, 1.0, 1);
        natural.shadows = 0;
        const auto unshadowed = picture(far, natural, gpu::footprint_mean, 1.0, 1);
        const auto [off, all] = far_off(one, truth, 20);
        const double mean = difference(one, truth);
        std::printf(
            "sun at %.0f deg: %d of %d pixels more than 20 codes off, %.2f in the mean (without "
            "shadows %d, %.2f)\n",
            elevation_deg, off, all, mean, far_off(unshadowed, truth, 20).first,
            difference(unshadowed, truth));
        EXPECT_LE(off, most_off * all);
        EXPECT_LE(mean, most_codes);
    }
}

TEST_F(Footprint, HoldsForMaps) {
    const Camera down = middle_of(over(46.5, 7.5, 60000.0, 0.0, -90.0, 45.0));
    for (const char* name : {"haze", "hypsometric", "plain", "relief", "contours", "hillshade", "aspect"})
        hold(name, down, style(name, 315.0, 45.0), 2.0);
    // Strong contrasts, whichever squares make a pixel: it is 5 to 15 posts wide.
    for (const double h_m : {40000.0, 60000.0, 100000.0, 130000.0})
        hold("slope", middle_of(over(46.5, 7.5, h_m, 0.0, -90.0, 45.0)), style("slope", 315.0, 45.0), 2.0);
}

// They ask for more pages than other colours; not for more than there is room for.
TEST_F(Footprint, SlopesTakeLargerSquaresWhereMemoryIsShort) {
    const Camera down = middle_of(over(46.5, 7.5, 60000.0, 0.0, -90.0, 45.0));
    const double fine_px = means_spacing_px(style("slope", 315.0, 45.0));
    const auto pages = [&](int memory_mb, double spacing_px) {
        MemoryOptions memory;
        memory.gpu_memory_mb = memory_mb;
        auto scene = test::create_scene(*gpu_, region_, {.memory = memory, .means = true});
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        scene->set_footprint_spacing(spacing_px);
        const auto plan = scene->settled_plan({down, test::whole_picture(down), 1.0});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        EXPECT_TRUE(plan->grids[0].missing.empty()) << memory_mb << " MB, squares of " << spacing_px << " px";
        return plan->grids[0].pages.size();
    };
    const std::size_t coarse = pages(200, gpu::means_spacing_px), fine = pages(200, fine_px);
    std::printf("%zu pages, %zu for slopes\n", coarse, fine);
    EXPECT_GT(fine, coarse);
    EXPECT_EQ(pages(15, fine_px), coarse);
}

// Rows of posts that are turned from east.
TEST_F(Footprint, HoldsOnTurnedRows) {
    const auto geotiff = test::real_data("geotiff");
    if (!geotiff) GTEST_SKIP() << "needs geotiff";
    ASSERT_NO_FATAL_FAILURE(test::open_with_means(
        *gpu_, {(*geotiff / "N46E008_EPSG21781_i16_rotated_nodata_edges.tif").string()}, region_, scene_));
    for (const double heading_deg : {0.0, 120.0, 240.0})
        hold("natural, on turned rows",
             over(46.5 - 0.3 * std::cos(heading_deg * std::numbers::pi / 180.0),
                  8.5 - 0.4 * std::sin(heading_deg * std::numbers::pi / 180.0), 20000.0, heading_deg, -30.0,
                  30.0),
             style("natural", 315.0, 38.0), 2.0);
}

// A GPU has programs of their own for near ground and the sky, for what is more code, and for the turns of
// lines to the sun; a processor one for each of the two.
TEST_F(Footprint, IsTheSameByOneProgramOrSeveral) {
    const gpu::FrameStyle natural = style("natural", 315.0, 20.0);
    scene_->set_shadow_request(shadow_request(natural));
    const Camera low = over(46.1, 7.5, 4500.0, 0.0, -6.0, 30.0);       // near ground, far ground, sky
    const Camera lake = over(46.60, 7.72, 2500.0, 20.0, -25.0, 60.0);  // ... and water
    const Camera beyond = over(46.9, 7.9, 9000.0, 30.0, -30.0, 60.0);  // ... and what is outside the data
    const auto all = [&] {
        std::vector<std::vector<std::uint8_t>> pictures;
        for (const Camera& camera : {low, lake, beyond})
            pictures.push_back(picture(camera, natural, gpu::footprint_mean, 1.0, 1));
        return pictures;
    };
    const auto one = all();
    FrameRendererOptions options;
    options.extent = {width_px, height_px};
    options.path = RasterPath::compute;
    options.smooth_edges = options.as_on_gpu = true;
    single_.emplace(test::made_renderer(*gpu_, options));
    EXPECT_EQ(all(), one);
    EXPECT_NE(picture(low, natural, gpu::footprint_point, 1.0, 1), one.front());
    gpu::FrameStyle other = natural;
    other.shadows = 0;
    EXPECT_NE(picture(low, other, gpu::footprint_mean, 1.0, 1), one.front()) << "or nothing lies in shadow";
    other = natural;
    other.water.on = 0;
    EXPECT_NE(picture(lake, other, gpu::footprint_mean, 1.0, 1), one[1]) << "or there is no lake";
}

// What lines to the sun pass over without a look depends on where it stands.
TEST_F(Footprint, ShadowsFollowTheSunInOneRenderer) {
    const Camera low = over(46.1, 7.5, 4500.0, 0.0, -6.0, 30.0);
    const gpu::FrameStyle noon = style("natural", 180.0, 60.0), evening = style("natural", 270.0, 8.0);
    scene_->set_shadow_request(shadow_request(evening));
    const auto fresh = picture(low, evening, gpu::footprint_mean, 1.0, 1);
    const auto at_noon = picture(low, noon, gpu::footprint_mean, 1.0, 1);
    EXPECT_NE(at_noon, fresh);
    EXPECT_EQ(picture(low, evening, gpu::footprint_mean, 1.0, 1), fresh);
}

// Where posts are larger than pixels a map has the angle of its posts, as gdaldem gives it.
TEST_F(Footprint, LeavesAnglesOfLargePosts) {
    const Camera near = middle_of(over(46.5, 7.5, 8000.0, 0.0, -90.0, 20.0));
    for (const char* name : {"hillshade", "slope", "aspect"}) {
        const gpu::FrameStyle one = style(name, 315.0, 45.0);
        const auto mean = picture(near, one, gpu::footprint_mean, 1.0, 1);
        // Posts are found by another way; the last bit may round otherwise.
        EXPECT_LE(difference(mean, picture(near, one, gpu::footprint_point, 1.0, 1)), 0.03) << name;
    }
}

TEST_F(Footprint, HoldsForRandomViews) {
    constexpr unsigned seed = 20261122;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int i = 0; i < 3; ++i) {
        const double h_m = between(7000.0, 22000.0), pitch_deg = between(-90.0, -40.0);
        const Camera camera = middle_of(
            over(between(46.4, 46.6), between(7.4, 7.6), h_m, between(0.0, 360.0), pitch_deg, 25.0));
        char what[80];
        std::snprintf(what, sizeof what, "%.0f m up, pitch %.0f", h_m, pitch_deg);
        const double azimuth_deg = between(0.0, 360.0), elevation_deg = between(15.0, 60.0);
        hold(what, camera, style("plain", azimuth_deg, elevation_deg), 2.0);
        hold(what, camera, style("natural", azimuth_deg, elevation_deg), 2.0);
    }
}

}  // namespace
}  // namespace oro

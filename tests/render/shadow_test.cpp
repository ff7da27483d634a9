// Cast shadows: from beyond the picture, by a round Earth, the same bytes by either way of drawing and in
// tiles, and nothing changed where there are none. (Against the oracle: tests/scenes/shadow_test.cpp.)
#include <cmath>
#include <cstdlib>

#include "core/base/parallel.h"
#include "render/frame/picture_renderer.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

gpu::FrameStyle lit_from(double azimuth_deg, double elevation_deg) {
    const SineCosine a = sine_cosine_deg(azimuth_deg), e = sine_cosine_deg(elevation_deg);
    gpu::FrameStyle style{};
    style.tint_count = 1;
    style.tints[0].colour = gpu::vec3(0.8F);
    style.sun_enu = gpu::vec3(e.cosine * a.sine, e.cosine * a.cosine, e.sine);
    style.ambient = 0.2F;
    style.relief = 1.0F;
    style.haze_distance_m = 1e9F;
    style.sky_scale_height_m = 8000.0F;
    style.shadows = 1;
    return style;
}

class CastShadows : public test::GpuTest {
  protected:
    std::vector<std::uint8_t> draw(const HeightField& field, const Camera& camera,
                                   const gpu::FrameStyle& style, RasterPath path = RasterPath::compute,
                                   int tile_px = 0) {
        auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2), {std::uint64_t{128} << 20U, 0});
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        PictureOptions options;
        options.path = path;
        options.largest_tile_px = tile_px;
        std::vector<std::uint8_t> rows;
        const auto report = render_picture(*gpu_, *scene, camera, style, options,
                                           [&](std::span<const std::uint8_t> row) -> Result<void> {
                                               rows.insert(rows.end(), row.begin(), row.end());
                                               return {};
                                           },
                                           {});
        EXPECT_TRUE(report.ok()) << report.error().line();
        EXPECT_TRUE(report->settled);
        return rows;
    }

    // An eye 300 m over the middle of the north of a region that looks north and down.
    static Camera northward(const HeightField& field, double lat_deg, double h_m) {
        Camera camera;
        camera.eye = {lat_deg, 0.5 * (field.grid.west_deg() + field.grid.east_deg()), h_m};
        camera.attitude = {0.0, -30.0, 0.0};
        camera.vertical_fov_deg = 40.0;
        camera.width_px = camera.height_px = 64;
        return camera;
    }
};

// A ridge 80 km south of an eye that looks north over a plain, the sun 1.5 degrees above it. Worked by hand:
// the line from the plain is 80,000 tan(1.5 deg) = 2,095 m up there, and on a round Earth 80,000^2 / (2 x
// 6,367,000) = 503 m more. (81 to 82 km to what is seen: 2,130 m and 520 m.) The disc's
// lower edge is 380 m below its middle there.
TEST_F(CastShadows, ComeFromBehindTheEyeOverARoundEarth) {
    const auto ridge = [](float height_m) {
        return test::made_field(46.3, 8.0, 1200.0, 1200, 400, [height_m](double lat_deg, double) {
            constexpr double south_deg = 46.2 - 80.0 / 111.17;
            const double off_m = std::abs(lat_deg - south_deg) * 111170.0;
            return static_cast<float>(std::max(0.0, height_m - 0.5 * off_m));
        });
    };
    const gpu::FrameStyle style = lit_from(180.0, 1.5);
    gpu::FrameStyle without = style;
    without.shadows = 0;
    const auto middle = [](const std::vector<std::uint8_t>& rgb) { return rgb[3 * (40 * 64 + 32)]; };
    const HeightField high = ridge(2950.0F), low = ridge(2200.0F);
    const std::uint8_t lit = middle(draw(high, northward(high, 46.2, 300.0), without));
    EXPECT_LT(middle(draw(high, northward(high, 46.2, 300.0), style)), lit) << "2,950 m are in the way";
    EXPECT_EQ(middle(draw(low, northward(low, 46.2, 300.0), style)), lit)
        << "2,200 m would be on a flat Earth alone";
}

TEST_F(CastShadows, AreTheSameBytesHoweverTheyAreDrawn) {
    const HeightField field = test::rough_field(46.9, 8.1, 500, 500);
    Camera camera = northward(field, 46.6, 4000.0);
    camera.width_px = 96;
    const gpu::FrameStyle style = lit_from(230.0, 12.0);
    const std::vector<std::uint8_t> whole = draw(field, camera, style);
    gpu::FrameStyle without = style;
    without.shadows = 0;
    EXPECT_NE(whole, draw(field, camera, without)) << "or there is no shadow";
    EXPECT_EQ(whole, draw(field, camera, style)) << "drawn again";
    const std::vector<std::uint8_t> tiled = draw(field, camera, style, RasterPath::compute, 24);
    ASSERT_EQ(whole.size(), tiled.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < whole.size(); ++i)
        different += std::abs(int{whole[i]} - int{tiled[i]}) > 1 ? 1U : 0U;
    // A tile's projection rounds on its own: a place at the edge of a shadow may fall to the other side.
    EXPECT_LE(different, whole.size() / 500) << "in tiles";
    if (gpu_->report().mesh_shader) {
        EXPECT_EQ(whole, draw(field, camera, style, RasterPath::mesh)) << "by mesh shaders";
    }
}

// A straight valley with walls that rise `slope` metres a metre: in its bottom the horizon at an angle a from
// its run rises by atan(slope |sin a|), so that the mean of its squared cosine over all directions is 1 /
// sqrt(1 + slope^2).
TEST_F(CastShadows, LeaveAValleyTheShareOfTheSkyThatItSees) {
    constexpr double slope = 0.75, share = 0.8;
    const HeightField valley = test::made_field(0.5, 8.0, 1200.0, 1200, 1025, [](double, double lon_deg) {
        const double middle_deg = 8.0 + 512.0 / 1200.0;  // post 512: a corner of nodes of all levels up to 6
        return static_cast<float>(slope * std::abs(lon_deg - middle_deg) * 111319.5);
    });
    Camera camera;
    camera.eye = {0.0, 8.0 + 512.0 / 1200.0, 3000.0};
    camera.attitude = {0.0, -89.9, 0.0};
    camera.vertical_fov_deg = 1.0;
    camera.width_px = camera.height_px = 33;
    gpu::FrameStyle style = lit_from(180.0, 45.0);
    style.tints[0].colour = gpu::vec3(1.0F);
    style.ambient = 1.0F;
    style.relief = 1e-6F;
    style.shadows = 0;
    style.sky_openness = 1;
    const std::vector<std::uint8_t> rgb = draw(valley, camera, style);
    const double code = rgb[3 * (16 * 33 + 16)] / 255.0;
    const double light = std::pow((code + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
    EXPECT_NEAR(light, share, 0.01);
    style.sky_openness = 0;
    EXPECT_EQ(draw(valley, camera, style)[3 * (16 * 33 + 16)], 255) << "without it all of the sky";
}

// A sun by night casts nothing, and is no error.
TEST_F(CastShadows, AreNoneByNight) {
    const HeightField field = test::rough_field(46.9, 8.1, 300, 300);
    gpu::FrameStyle style = lit_from(230.0, -20.0);
    style.sun_hidden = 1.0F;
    gpu::FrameStyle without = style;
    without.shadows = 0;
    const Camera camera = northward(field, 46.7, 4000.0);
    EXPECT_EQ(draw(field, camera, style), draw(field, camera, without));
}

}  // namespace
}  // namespace oro

// Cast shadows: from beyond the picture, by a round Earth, the same bytes by either way of drawing and in
// tiles, and nothing changed where there are none. (Against the oracle: tests/scenes/shadow_test.cpp.)
#include <cmath>
#include <cstdlib>
#include <numbers>

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

// A wall of one row, 60 m high: 60 / tan(10 deg) = 340 m of the ground beside it have its shadow, 3.7 rows.
// Level ground begins its lines in cells of 32 posts, in which there is no wall; rough ground in cells of
// one, of which the smooth surface makes a lower wall.
TEST_F(CastShadows, OfAWallLieOnTheGroundBesideIt) {
    constexpr double north_deg = 46.3, rows_per_degree = 1200.0, wall_row = 513.0,
                     row_m = 111170.0 / rows_per_degree;
    for (const double rough_m : {0.0, 0.3}) {
        const HeightField field = test::made_field(
            north_deg, 8.0, rows_per_degree, 1025, 400, [rough_m](double lat_deg, double lon_deg) {
                const double row = (north_deg - lat_deg) * rows_per_degree,
                             rows_off = std::abs(row - wall_row);
                const double rough = rough_m * std::sin(12.9898 * std::round(row) +
                                                        78.233 * std::round(lon_deg * rows_per_degree));
                return static_cast<float>(std::max(rough, 60.0 * (1.0 - rows_off)));
            });
        const gpu::FrameStyle style = lit_from(180.0, 10.0);
        gpu::FrameStyle without = style;
        without.shadows = 0;
        for (const double rows : {1.5, 2.5, 3.5, 4.0, 6.0}) {
            Camera camera = northward(field, north_deg - (wall_row - rows) / rows_per_degree, 500.0);
            camera.attitude = {0.0, -89.9, 0.0};
            camera.vertical_fov_deg = 2.0;
            const auto middle = [](const std::vector<std::uint8_t>& rgb) { return rgb[3 * (32 * 64 + 32)]; };
            const std::uint8_t lit = middle(draw(field, camera, without)),
                               shown = middle(draw(field, camera, style));
            if (rows < 3.6)
                EXPECT_LT(shown, lit) << rows * row_m << " m from the wall, rough " << rough_m;
            else
                EXPECT_EQ(shown, lit) << rows * row_m << " m from the wall, rough " << rough_m;
        }
    }
}

// A crest 1,000 m over a plain, the sun behind it, 30 degrees high: 1,732 m away its shadow ends, and the
// sun's disc is uncovered over 2 x 0.00465 x 1,000 / sin(30 deg)^2 = 37 m. Worked from the angle between the
// crest and the sun's middle, and the share of a disc above a straight edge: 1/2 + (x sqrt(1 - x^2) +
// asin(x)) / pi, x in radii.
TEST_F(CastShadows, EndInAPenumbraAsWideAsTheSun) {
    constexpr double crest_deg = 46.1, crest_m = 1000.0, sun_deg = 30.0, sun_rad = 0.00465, eye_h_m = 220.0;
    const HeightField field = test::made_field(46.2, 8.0, 1200.0, 240, 240, [](double lat_deg, double) {
        const double off_m = std::abs(lat_deg - crest_deg) * 111170.0;
        return static_cast<float>(std::max(0.0, crest_m - 2.0 * off_m));
    });
    const double radius_m = meridian_radius_m(crest_deg), away_m = 1732.0;
    Camera camera;
    camera.eye = {crest_deg + away_m / radius_m * 180.0 / std::numbers::pi, 8.1, eye_h_m};
    camera.attitude = {0.0, -89.9, 0.0};
    camera.vertical_fov_deg = 20.0;
    camera.width_px = 16;
    camera.height_px = 96;
    const gpu::FrameStyle style = lit_from(180.0, sun_deg);
    gpu::FrameStyle without = style;
    without.shadows = 0;
    const auto light = [&](const std::vector<std::uint8_t>& rgb, int row) {
        const auto column = static_cast<std::size_t>(camera.width_px / 2);
        const std::size_t at = 3 * (static_cast<std::size_t>(row) * 16 + column);
        return std::pow((rgb[at] / 255.0 + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
    };
    const std::vector<std::uint8_t> lit = draw(field, camera, without), cast = draw(field, camera, style);
    const double least = light(cast, camera.height_px - 1), most = light(lit, 0);
    ASSERT_LT(least, 0.5 * most) << "the crest's shadow";
    const glm::dmat3 enu_from_ecef = glm::transpose(ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg));
    int within = 0;
    for (int row = 0; row < camera.height_px; ++row) {
        const glm::dvec3 down = enu_from_ecef * camera.ecef_direction_at({8.5, row + 0.5});
        const double from_crest_m = away_m - eye_h_m * down.y / down.z;
        const double crest_rad =
            std::atan((crest_m - from_crest_m * from_crest_m / (2.0 * radius_m)) / from_crest_m);
        const double x = std::clamp((sun_deg * std::numbers::pi / 180.0 - crest_rad) / sun_rad, -1.0, 1.0);
        const double share = 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / std::numbers::pi;
        EXPECT_NEAR((light(cast, row) - least) / (most - least), share, 0.03) << from_crest_m << " m";
        if (std::abs(x) < 1.0) ++within;
    }
    EXPECT_GT(within, 40) << "rows in the penumbra";
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

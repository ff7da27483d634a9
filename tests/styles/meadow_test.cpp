// Grass near the eye: where it stands, that it does not change how light a meadow is, and who does not see
// it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "apps/legend/legend.h"
#include "render/frame/picture_renderer.h"
#include "tests/styles/drawn_style.h"
#include "tests/support/asked_count.h"

namespace oro {
namespace {

struct GrassAsked {
    bool grass{true};
    bool trees{false};
    SunDirection sun{180.0, 50.0};
};
struct GrassDrawing {
    RasterPath path{RasterPath::compute};
    int samples{1};
    OcclusionUse occlusion{OcclusionUse::if_it_pays};
    int largest_tile_px{PictureOptions{}.largest_tile_px};
};

class MeadowPictures : public test::StyleTest {
  protected:
    static constexpr int width_px = 192, height_px = 144;
    static constexpr double meadow_H_m = 2250.0;  // by the rule, the snow line being at 2,990 m

    // Ground that rises towards the north by `rise`, with square cells of 30 m, so high in its middle.
    static Region slope(double middle_H_m, double rise) {
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = test::square_field(
            46.5, 8.0, 30.0, 129, [&](int row, int) { return middle_H_m + rise * 30.0 * (64 - row); });
        return region;
    }

    static std::string style_text(const GrassAsked& asked) {
        std::ifstream file(test::bundled_data() / "styles" / "natural.json");
        std::string text((std::istreambuf_iterator<char>(file)), {});
        const std::string growth = "{ \"trees\": true, \"grass\": true }";
        const std::size_t at = text.find(growth);
        EXPECT_NE(at, std::string::npos);
        if (at == std::string::npos) return text;
        const auto word = [](bool on) { return std::string(on ? "true" : "false"); };
        return text.replace(at, growth.size(),
                            "{ \"trees\": " + word(asked.trees) + ", \"grass\": " + word(asked.grass) + " }");
    }
    static gpu::FrameStyle natural(const Region& region, const GrassAsked& asked = {}) {
        const auto style = style_of(style_text(asked), ".json", Camera{}, region.grids[0].field, asked.sun);
        EXPECT_TRUE(style.ok()) << style.error().line();
        return style->frame;
    }

    // In the middle of a region, so high over its ground, whose middle lies so high.
    static Camera eye_over(double middle_H_m, double above_m, double pitch_deg = -6.0) {
        Camera camera;
        camera.eye = {46.5, 8.0, middle_H_m + above_m};
        camera.attitude = {0.0, pitch_deg, 0.0};
        camera.width_px = width_px;
        camera.height_px = height_px;
        return camera;
    }

    std::vector<std::uint8_t> picture(const Region& region, const Camera& camera,
                                      const gpu::FrameStyle& style, const GrassDrawing& how = {}) {
        auto scene = test::create_scene(*gpu_, region, {.means = true});
        EXPECT_TRUE(scene.ok());
        if (!scene.ok()) return {};
        std::vector<std::uint8_t> rgb;
        PictureOptions options;
        options.path = how.path;
        options.samples = how.samples;
        options.occlusion = how.occlusion;
        options.largest_tile_px = how.largest_tile_px;
        const auto report =
            render_picture(*gpu_, *scene, camera, style, options, [&](std::span<const std::uint8_t> row) {
                rgb.insert(rgb.end(), row.begin(), row.end());
                return Result<void>();
            });
        EXPECT_TRUE(report.ok()) << report.error().line();
        return rgb;
    }

    static bool is_unlike(const std::vector<std::uint8_t>& one, const std::vector<std::uint8_t>& other,
                          std::size_t pixel) {
        return !std::equal(&one[3 * pixel], &one[3 * pixel] + 3, &other[3 * pixel]);
    }
    static std::size_t unlike_px(const std::vector<std::uint8_t>& one,
                                 const std::vector<std::uint8_t>& other) {
        EXPECT_EQ(one.size(), other.size());
        std::size_t count = 0;
        for (std::size_t i = 0; i < std::min(one.size(), other.size()) / 3; ++i)
            count += is_unlike(one, other, i) ? 1U : 0U;
        return count;
    }
    // The mean codes of red, green and blue over some rows.
    static std::array<double, 3> mean_codes(const std::vector<std::uint8_t>& rgb, int first_row,
                                            int end_row) {
        std::array<double, 3> sum{};
        for (int i = first_row * width_px; i < end_row * width_px; ++i)
            for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[3 * static_cast<std::size_t>(i) + c];
        for (double& one : sum) one /= (end_row - first_row) * width_px;
        return sum;
    }
};

TEST_F(MeadowPictures, ShowBladesOnAMeadow) {
    const Region region = slope(meadow_H_m, 0.1);
    const Camera eye = eye_over(meadow_H_m, 1.7);
    const auto without = picture(region, eye, natural(region, {.grass = false})),
               with = picture(region, eye, natural(region));
    // Of the lower half, which is ground within 60 m.
    EXPECT_GT(unlike_px(without, with), width_px * height_px / 3U);
    // The same once more, to the byte.
    EXPECT_EQ(with, picture(region, eye, natural(region)));
}

// Off: as before there was any, to the byte; and on where there is no meadow or no eye near it.
TEST_F(MeadowPictures, ShowNoneWhereNoneGrows) {
    const Region meadow = slope(meadow_H_m, 0.1), snow = slope(3500.0, 0.1), steep = slope(meadow_H_m, 1.8);
    const auto expect_none = [&](const Region& region, const Camera& camera) {
        EXPECT_EQ(picture(region, camera, natural(region, {.grass = false})),
                  picture(region, camera, natural(region)));
    };
    expect_none(snow, eye_over(3500.0, 1.7));
    expect_none(steep, eye_over(meadow_H_m, 1.7));
    expect_none(meadow, eye_over(meadow_H_m, 75.0));
}

// But for rims that another program rounds otherwise.
TEST_F(MeadowPictures, AreTheSameByBothWaysOfDrawing) {
    const Region region = slope(meadow_H_m, 0.1);
    const Camera eye = eye_over(meadow_H_m, 1.7);
    const gpu::FrameStyle style = natural(region);
    for (const int count : {1, 3})
        EXPECT_LE(unlike_px(picture(region, eye, style, {.path = RasterPath::mesh, .samples = count}),
                            picture(region, eye, style, {.path = RasterPath::compute, .samples = count})),
                  8U + width_px * height_px / 2000U);
}

// Grass is as light as the meadow without it, whose edge at 60 m does not show: near, and from where it fades
// on.
TEST_F(MeadowPictures, AreAsLightAsTheirMeadow) {
    const Region region = slope(meadow_H_m, 0.1);
    for (const SunDirection& sun : {SunDirection{180.0, 50.0}, SunDirection{270.0, 25.0},
                                    SunDirection{0.0, 40.0}, SunDirection{90.0, 60.0}}) {
        for (const double pitch_deg : {-5.0, -15.0, -35.0}) {
            const Camera eye = eye_over(meadow_H_m, 1.7, pitch_deg);
            const auto mean = [&](bool grass) {
                return mean_codes(picture(region, eye, natural(region, {.grass = grass, .sun = sun})),
                                  height_px * 6 / 10, height_px);
            };
            const auto with = mean(true), without = mean(false);
            std::printf("sun %.0f,%.0f, pitch %.0f: grass %.1f %.1f %.1f, meadow %.1f %.1f %.1f\n",
                        sun.azimuth_deg, sun.elevation_deg, pitch_deg, with[0], with[1], with[2], without[0],
                        without[1], without[2]);
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(with[c], without[c], 5.0)
                    << "channel " << c << ", sun " << sun.azimuth_deg << ", " << sun.elevation_deg;
        }
    }
}

// Wind has the clock's time: a second later blades stand elsewhere, and at the same time the picture is the
// same.
TEST_F(MeadowPictures, MoveByTheClock) {
    const Region region = slope(meadow_H_m, 0.1);
    const Camera eye = eye_over(meadow_H_m, 1.7);
    gpu::FrameStyle still = natural(region), windy = still;
    EXPECT_EQ(still.materials.wind, 0.0F);
    windy.materials.wind = 1.0F;
    windy.materials.wind_time_s = 43'200.0F;
    const auto one = picture(region, eye, windy);
    EXPECT_EQ(one, picture(region, eye, windy));
    EXPECT_GT(unlike_px(one, picture(region, eye, still)), width_px * height_px / 10U);
    windy.materials.wind_time_s += 1.0F;
    EXPECT_GT(unlike_px(one, picture(region, eye, windy)), width_px * height_px / 10U);
}

// Brute force: tiles of a picture leave out what they do not show, and so does ground that hides it; no blade
// is lost by either that covers a pixel. From random eyes over hills.
TEST_F(MeadowPictures, LoseNoBladeThatCoversAPixel) {
    constexpr unsigned seed = 20261128;
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Region region{std::vector<RegionGrid>(1)};
    const auto H_m = [](double row, double column) {
        return meadow_H_m + 4.0 * std::sin(row * 1.1) * std::cos(column * 0.9) + 3.0 * (64.0 - row);
    };
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 129, H_m);
    gpu::FrameStyle style = natural(region, {.trees = true}),
                    bare = natural(region, {.grass = false, .trees = true});
    // Shadows of a whole picture and of its tiles differ by what they round.
    style.shadows = style.sky_openness = bare.shadows = bare.sky_openness = 0;
    style.smooth_edges = bare.smooth_edges = 0;
    std::size_t of_grass_px = 0;
    const int eyes = test::asked_count("OROGRAPH_GRASS_EYES", 4);
    for (int i = 0; i < eyes; ++i) {
        Camera one = eye_over(0.0, 0.0);
        const double north_m = number(-300.0, 300.0), east_m = number(-300.0, 300.0);
        one.eye = {46.5 + north_m / 111'000.0, 8.0 + east_m / 76'600.0,
                   H_m(64.0 - north_m / 30.0, 64.0 + east_m / 30.0) + 0.5 + std::exp(number(-1.0, 2.5))};
        one.attitude = {number(0.0, 360.0), number(-40.0, 5.0), number(-10.0, 10.0)};
        one.vertical_fov_deg = number(15.0, 70.0);
        const auto all = picture(region, one, style, {.occlusion = OcclusionUse::off});
        EXPECT_EQ(unlike_px(picture(region, one, style, {.occlusion = OcclusionUse::on}), all), 0U)
            << "seed " << seed << ", eye " << i;
        EXPECT_LE(
            unlike_px(picture(region, one, style, {.occlusion = OcclusionUse::off, .largest_tile_px = 48}),
                      all),
            width_px * height_px / 400U)
            << "seed " << seed << ", eye " << i;
        of_grass_px += unlike_px(picture(region, one, bare), all);
    }
    EXPECT_GT(of_grass_px, std::size_t{10000} * static_cast<std::size_t>(eyes) / 4U);
}

// Who asks for depths sees the ground, coloured as without grass.
TEST_F(MeadowPictures, AreNoGround) {
    const Region region = slope(meadow_H_m, 0.1);
    Style with{}, without{};
    with.frame = natural(region);
    without.frame = natural(region, {.grass = false});
    const auto one = drawn(region, eye_over(meadow_H_m, 1.7), with, true),
               other = drawn(region, eye_over(meadow_H_m, 1.7), without, true);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->rgba, other->rgba);
    EXPECT_EQ(one->depths, other->depths);
}

TEST_F(MeadowPictures, AreSaidToBeInvented) {
    const Region region = slope(meadow_H_m, 0.1);
    View view;
    view.camera = eye_over(meadow_H_m, 1.7);
    const auto says = [&](bool grass) {
        Style style{};
        style.frame = natural(region, {.grass = grass});
        const std::vector<std::string> lines = legend_lines(view, region, style);
        return std::ranges::count(lines,
                                  "Grass within 60 m: invented, by a rule, where the ground cover is meadow");
    };
    EXPECT_EQ(says(true), 1);
    EXPECT_EQ(says(false), 0);
    Style style{};
    style.frame = natural(region, {.grass = true});
    const std::string fields = "Fields with hedges, and clefts of rock: invented, by a rule";
    EXPECT_EQ(std::ranges::count(legend_lines(view, region, style), fields), 1);
    style.frame.materials.on = 0;
    EXPECT_EQ(std::ranges::count(legend_lines(view, region, style), fields), 0);
}

TEST_F(MeadowPictures, AreAskedForByAStyle) {
    const Region region = slope(meadow_H_m, 0.1);
    const auto read = [&](const std::string& growth) {
        std::string text = style_text({});
        const std::string own = "{ \"trees\": false, \"grass\": true }";
        text.replace(text.find(own), own.size(), growth);
        return style_of(text, ".json", Camera{}, region.grids[0].field);
    };
    const auto on_of = [&](const std::string& growth) {
        const auto style = read(growth);
        EXPECT_TRUE(style.ok()) << growth;
        return style.ok() ? style->frame.materials.on : 0;
    };
    EXPECT_EQ(on_of("{ \"trees\": true, \"grass\": true }"), 7U);
    EXPECT_EQ(on_of("{ \"trees\": false, \"grass\": true }"), 5U);
    EXPECT_EQ(on_of("{ \"trees\": true, \"grass\": false }"), 3U);
    // As styles had it before there was grass.
    EXPECT_EQ(on_of("{ \"trees\": true }"), 3U);
    const auto wrong = read("{ \"trees\": true, \"grass\": 60 }");
    ASSERT_FALSE(wrong.ok());
    EXPECT_NE(wrong.error().line().find("grass"), std::string::npos);
}

}  // namespace
}  // namespace oro

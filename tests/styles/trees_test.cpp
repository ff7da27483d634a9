// Single trees: where they stand, that both ways of drawing show the same, and who does not see them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "render/frame/picture_renderer.h"
#include "tests/styles/drawn_style.h"
#include "tests/support/asked_count.h"

namespace oro {
namespace {

class TreePictures : public test::StyleTest {
  protected:
    static constexpr int width_px = 192, height_px = 144;

    // Ground that rises towards the north by `rise`, with square cells of 30 m, so high in its middle.
    static Region slope(double middle_H_m, double rise) {
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = test::square_field(
            46.5, 8.0, 30.0, 129, [&](int row, int) { return middle_H_m + rise * 30.0 * (64 - row); });
        return region;
    }

    static std::string natural_text(bool trees) {
        std::ifstream file(test::bundled_data() / "styles" / "natural.json");
        std::string text((std::istreambuf_iterator<char>(file)), {});
        const std::string growth = ",\n  \"growth\": { \"trees\": true, \"grass\": true }";
        const std::size_t at = text.find(growth);
        EXPECT_NE(at, std::string::npos);
        if (at == std::string::npos) return text;
        return text.replace(at, growth.size(), trees ? ",\n  \"growth\": { \"trees\": true }" : "");
    }
    static gpu::FrameStyle natural(const Region& region, bool trees,
                                   const SunDirection& sun = {180.0, 50.0}) {
        const auto style = style_of(natural_text(trees), ".json", Camera{}, region.grids[0].field, sun);
        EXPECT_TRUE(style.ok()) << style.error().line();
        return style->frame;
    }

    // From the south, 60 m over the middle.
    static Camera camera(double middle_H_m) {
        Camera camera;
        camera.eye = {46.4985, 8.0, middle_H_m + 60.0};
        camera.attitude = {0.0, -5.0, 0.0};
        camera.width_px = width_px;
        camera.height_px = height_px;
        return camera;
    }

    std::vector<std::uint8_t> picture(const Region& region, const Camera& camera,
                                      const gpu::FrameStyle& style, RasterPath path, int sample_count = 1,
                                      OcclusionUse occlusion = OcclusionUse::if_it_pays,
                                      double tau_px = PictureOptions{}.tau_px) {
        auto scene = test::create_scene(*gpu_, region, {.means = true});
        EXPECT_TRUE(scene.ok());
        if (!scene.ok()) return {};
        std::vector<std::uint8_t> rgb;
        PictureOptions options;
        options.path = path;
        options.samples = sample_count;
        options.occlusion = occlusion;
        options.tau_px = tau_px;
        const auto report =
            render_picture(*gpu_, *scene, camera, style, options, [&](std::span<const std::uint8_t> row) {
                rgb.insert(rgb.end(), row.begin(), row.end());
                return Result<void>();
            });
        EXPECT_TRUE(report.ok()) << report.error().line();
        return rgb;
    }

    // The mean of a rectangle of a picture, whose sides may lie within pixels; green, codes.
    static double mean_code(const std::vector<std::uint8_t>& rgb, double left, double top, double right,
                            double bottom) {
        double sum = 0.0;
        for (int y = static_cast<int>(top); y < bottom; ++y)
            for (int x = static_cast<int>(left); x < right; ++x) {
                const double wide = std::min(right, x + 1.0) - std::max(left, static_cast<double>(x));
                const double high = std::min(bottom, y + 1.0) - std::max(top, static_cast<double>(y));
                sum += wide * high * rgb[3 * static_cast<std::size_t>(y * width_px + x) + 1];
            }
        return sum / ((right - left) * (bottom - top));
    }
    // By how many codes squares of a picture differ from the same ground in one that shows it larger.
    static double largest_change(const std::vector<std::uint8_t>& from, const std::vector<std::uint8_t>& to,
                                 double larger, int side) {
        double most = 0.0;
        const auto there = [&](int at, int size) { return 0.5 * size + larger * (at - 0.5 * size); };
        for (int y = side; y + 2 * side <= height_px; y += side)
            for (int x = side; x + 2 * side <= width_px; x += side)
                most =
                    std::max(most, std::abs(mean_code(to, there(x, width_px), there(y, height_px),
                                                      there(x + side, width_px), there(y + side, height_px)) -
                                            mean_code(from, x, y, x + side, y + side)));
        return most;
    }

    // A slope of forest, seen from the south, so far away that its crowns have no leaves.
    struct SlopeView {
        double middle_H_m, rise, above_m;
        SunDirection sun;
        bool across{false};  // the slope falls towards the west
    };
    static Region slope_of(const SlopeView& view) {
        if (!view.across) return slope(view.middle_H_m, view.rise);
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 129, [&](int, int column) {
            return view.middle_H_m + view.rise * 30.0 * (column - 64);
        });
        return region;
    }
    // Of one colour: forests have lighter and darker parts.
    static gpu::FrameStyle of_one_colour(const Region& region, const SunDirection& sun) {
        gpu::FrameStyle style = natural(region, true, sun);
        for (auto& material : style.materials.of) material.patches = {};
        return style;
    }
    std::vector<std::uint8_t> picture_of(const SlopeView& view, const Region& region,
                                         const gpu::FrameStyle& style, double tau_px) {
        constexpr double away_m = 1400.0;
        Camera from_south = camera(view.middle_H_m);
        from_south.eye = {46.5 - away_m / 111'000.0, 8.0, view.middle_H_m + view.above_m};
        from_south.attitude = {0.0, -std::atan(view.above_m / away_m) * 180.0 / std::numbers::pi, 0.0};
        from_south.vertical_fov_deg = 8.0;
        return picture(region, from_south, style, RasterPath::compute, 1, OcclusionUse::if_it_pays, tau_px);
    }
    // The mean over a picture of what is made of each code of green.
    template <typename OfCode>
    static double mean_green(const std::vector<std::uint8_t>& rgb, const OfCode& of_code) {
        double sum = 0.0;
        for (std::size_t i = 1; i < rgb.size(); i += 3) sum += of_code(static_cast<double>(rgb[i]));
        return 3.0 * sum / static_cast<double>(rgb.size());
    }

    static std::size_t unlike_px(const std::vector<std::uint8_t>& one,
                                 const std::vector<std::uint8_t>& other) {
        EXPECT_EQ(one.size(), other.size());
        std::size_t count = 0;
        for (std::size_t i = 0; i + 2 < std::min(one.size(), other.size()); i += 3)
            count += std::equal(one.begin() + static_cast<std::ptrdiff_t>(i),
                                one.begin() + static_cast<std::ptrdiff_t>(i + 3),
                                other.begin() + static_cast<std::ptrdiff_t>(i))
                         ? 0U
                         : 1U;
        return count;
    }
};

// A slope of 30 degrees at 1,100 m is forest by the rule of materials, the snow line being at 2,990 m.
TEST_F(TreePictures, ShowTreesOnForest) {
    const Region region = slope(1100.0, 0.58);
    const std::vector<std::uint8_t> without =
        picture(region, camera(1100.0), natural(region, false), RasterPath::compute);
    const std::vector<std::uint8_t> with =
        picture(region, camera(1100.0), natural(region, true), RasterPath::compute);
    EXPECT_GT(unlike_px(without, with), width_px * height_px / 3U);
    // The same once more, to the byte.
    EXPECT_EQ(with, picture(region, camera(1100.0), natural(region, true), RasterPath::compute));
}

// Above all forest not a byte changes.
TEST_F(TreePictures, ShowNoneAboveTheForest) {
    const Region region = slope(3300.0, 0.3);
    EXPECT_EQ(picture(region, camera(3300.0), natural(region, false), RasterPath::compute),
              picture(region, camera(3300.0), natural(region, true), RasterPath::compute));
}

// A wooded slope from 500 m, with its trees and, by a tau that lets none be drawn, without: as light in the
// mean, wherever the sun stands. Found: with the sun behind the eye drawn trees were three times as light as
// ground of their colour, and against it half as light; later 9 to 12 % lighter.
TEST_F(TreePictures, AreAsLightAsTheirForestFromFar) {
    const Region region = slope(1100.0, 0.58);
    Camera from_south = camera(1100.0);
    from_south.eye = {46.4945, 8.0, 1300.0};
    from_south.attitude = {0.0, -18.0, 0.0};
    from_south.vertical_fov_deg = 20.0;
    const auto mean_code = [&](const SunDirection& sun, double tau_px) {
        gpu::FrameStyle style = natural(region, true, sun);
        const auto rgb =
            picture(region, from_south, style, RasterPath::compute, 1, OcclusionUse::if_it_pays, tau_px);
        double sum = 0.0;
        for (std::size_t i = 1; i < rgb.size(); i += 3) sum += rgb[i];
        return 3.0 * sum / static_cast<double>(rgb.size());
    };
    for (const SunDirection& sun : {SunDirection{180.0, 20.0}, SunDirection{180.0, 55.0},
                                    SunDirection{270.0, 35.0}, SunDirection{20.0, 55.0}}) {
        const double near = mean_code(sun, 1.0), far = mean_code(sun, 200.0);
        std::printf("sun %.0f,%.0f: trees %.1f, forest %.1f\n", sun.azimuth_deg, sun.elevation_deg, near,
                    far);
        EXPECT_NEAR(near, far, 10.0) << sun.azimuth_deg << ", " << sun.elevation_deg;
    }
}

// Where crowns have no leaves any more, and so where trees end, far forest is as light as they are: by kind,
// slope and sun. Found: lighter by up to 20 codes of 255, in the median by 9, with patches of colour that
// trees had not; later, where ground falls across the line of sight, by up to 24.
TEST_F(TreePictures, AreAsLightWhereTheyEnd) {
    const std::vector<SlopeView> views{
        {1580.0, 0.4, 280.0, {180.0, 15.0}},       {1580.0, 0.6, 280.0, {225.0, 35.0}},
        {1580.0, 0.8, 700.0, {180.0, 60.0}},       {1580.0, 0.4, 280.0, {0.0, 35.0}},
        {700.0, 0.4, 280.0, {180.0, 35.0}},        {700.0, 0.6, 70.0, {225.0, 15.0}},
        {700.0, 0.8, 700.0, {180.0, 60.0}},        {700.0, 0.4, 280.0, {0.0, 35.0}},
        {1580.0, 0.6, 700.0, {180.0, 60.0}, true}, {700.0, 0.6, 280.0, {180.0, 15.0}, true}};
    for (const SlopeView& view : views) {
        const Region region = slope_of(view);
        const gpu::FrameStyle style = of_one_colour(region, view.sun);
        const auto code = [&](double tau_px) {
            return mean_green(picture_of(view, region, style, tau_px),
                              [](double of_pixel) { return of_pixel; });
        };
        const double near = code(1.0), far = code(200.0);
        std::printf("H %.0f m, rise %.1f%s, eye %.0f m up, sun %.0f,%.0f: trees %.1f, forest %.1f\n",
                    view.middle_H_m, view.rise, view.across ? " across" : "", view.above_m,
                    view.sun.azimuth_deg, view.sun.elevation_deg, near, far);
        EXPECT_NEAR(near, far, 5.0);
    }
}

// What is not forest, its forest being black: far forest leaves as much of clearings and rock to be seen as
// trees do.
TEST_F(TreePictures, HideAsMuchOfClearingsWhereTheyEnd) {
    for (const SlopeView& view :
         {SlopeView{700.0, 0.4, 280.0, {180.0, 35.0}}, SlopeView{700.0, 0.8, 700.0, {180.0, 60.0}}}) {
        const Region region = slope_of(view);
        gpu::FrameStyle clearings = of_one_colour(region, view.sun), nothing = clearings;
        for (const gpu::uint forest : {gpu::material_needle_forest, gpu::material_broad_forest})
            clearings.materials.of[forest].colour = gpu::vec3(0.0F);
        for (auto& material : nothing.materials.of) material.colour = gpu::vec3(0.0F);
        const auto light = [&](double tau_px) {
            const auto of = [&](const gpu::FrameStyle& style) {
                return mean_green(picture_of(view, region, style, tau_px), [](double of_pixel) {
                    const double shown = of_pixel / 255.0;
                    return shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
                });
            };
            return of(clearings) - of(nothing);
        };
        const double near = light(1.0), far = light(200.0);
        std::printf("rise %.1f: light of clearings %.4f beside trees, %.4f beside forest\n", view.rise, near,
                    far);
        EXPECT_NEAR(far / near, 1.0, 0.06);
        EXPECT_GT(near, 0.02) << "or there are none";
    }
}

// Lighter parts of far forest are lighter where its trees are drawn, too. Found: trees had no such parts, and
// forest changed by up to 40 codes where they ended.
TEST_F(TreePictures, HaveTheColoursOfTheirForestsParts) {
    const Region region = slope(1580.0, 0.58);
    Camera from_south = camera(1580.0);
    from_south.eye = {46.4885, 8.0, 1580.0 + 250.0};
    from_south.attitude = {0.0, -10.0, 0.0};
    from_south.vertical_fov_deg = 20.0;
    gpu::FrameStyle style = natural(region, true, {180.0, 40.0});
    // Grey, so that parts are told apart by little else.
    for (auto& material : style.materials.of) {
        material.colour = gpu::vec3(0.06F);
        material.patches = gpu::vec3(0.02F);
        material.grain = 0.0F;
    }
    constexpr int side = 16;
    const auto blocks = [&](double tau_px) {
        const auto rgb =
            picture(region, from_south, style, RasterPath::compute, 1, OcclusionUse::if_it_pays, tau_px);
        std::vector<double> means(std::size_t{width_px / side} * (height_px / side), 0.0);
        for (std::size_t i = 0; i < rgb.size() / 3; ++i)
            means[i / width_px / side * (width_px / side) + i % width_px / side] +=
                rgb[3 * i + 1] / static_cast<double>(side * side);
        return means;
    };
    const std::vector<double> near = blocks(1.0), far = blocks(200.0);
    const auto mean = [](const std::vector<double>& of) {
        return std::accumulate(of.begin(), of.end(), 0.0) / static_cast<double>(of.size());
    };
    double both = 0.0, one = 0.0, other = 0.0;
    for (std::size_t i = 0; i < near.size(); ++i) {
        const double a = near[i] - mean(near), b = far[i] - mean(far);
        both += a * b;
        one += a * a;
        other += b * b;
    }
    const double correlation = both / std::sqrt(one * other);
    std::printf("blocks of trees and of far forest: correlation %.2f\n", correlation);
    EXPECT_GT(correlation, 0.8);
}

// The eye 1 % nearer, as its picture has it that shows the same ground 1 % larger: no square of 16 x 16 px
// changes by more than 2 codes where trees come and grow. With 16 samples a pixel: of one alone chance makes
// up to 11.
TEST_F(TreePictures, ChangeLittleAsTheEyeDrawsNearer) {
    constexpr double nearer = 1.01;
    constexpr int side = 16;
    double most = 0.0;
    for (const SunDirection& sun : {SunDirection{180.0, 20.0}, SunDirection{20.0, 50.0}}) {
        for (const double middle_H_m : {700.0, 1580.0}) {
            const Region region = slope(middle_H_m, 0.5);
            Camera eye = camera(middle_H_m);
            eye.eye = {46.4845, 8.0, middle_H_m + 250.0};
            eye.attitude = {0.0, -8.0, 0.0};
            eye.vertical_fov_deg = 20.0;
            gpu::FrameStyle style = natural(region, true, sun);
            const auto drawn = [&](double fov_deg) {
                Camera one = eye;
                one.vertical_fov_deg = fov_deg;
                return picture(region, one, style, RasterPath::compute, 16);
            };
            const double half_rad = 10.0 * std::numbers::pi / 180.0;
            const auto from = drawn(20.0),
                       to = drawn(2.0 * std::atan(std::tan(half_rad) / nearer) * 180.0 / std::numbers::pi);
            const double changed = largest_change(from, to, nearer, side);
            std::printf("H %.0f m, sun %.0f,%.0f: 16 x 16 px change by %.2f codes at most\n", middle_H_m,
                        sun.azimuth_deg, sun.elevation_deg, changed);
            most = std::max(most, changed);
        }
    }
    EXPECT_LE(most, 2.0);
}

// A lake in a forest, seen from above: found with trees standing in its water.
TEST_F(TreePictures, StandInNoWater) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 129, [](int row, int column) {
        return std::max(1100.0, 1100.0 + 12.0 * (std::hypot(row - 64.0, column - 64.0) - 6.0));
    });
    Camera above = camera(1100.0);
    above.eye = {46.5, 8.0, 1600.0};
    above.attitude = {0.0, -90.0, 0.0};
    above.vertical_fov_deg = 60.0;
    gpu::FrameStyle with = natural(region, true), without = natural(region, false);
    with.shadows = without.shadows = 0;
    const std::vector<std::uint8_t> one = picture(region, above, with, RasterPath::compute),
                                    other = picture(region, above, without, RasterPath::compute);
    const double m_a_px = 500.0 * 2.0 * std::tan(30.0 * std::numbers::pi / 180.0) / height_px;
    std::size_t in_lake = 0, on_land = 0;
    for (std::size_t i = 0; i < one.size() / 3; ++i) {
        const double x = static_cast<double>(i % width_px) - 0.5 * width_px,
                     y = static_cast<double>(i / width_px) - 0.5 * height_px;
        const double from_middle_m = std::hypot(x, y) * m_a_px;
        const bool unlike = !std::equal(&one[3 * i], &one[3 * i] + 3, &other[3 * i]);
        if (from_middle_m < 3.0 * 30.0) in_lake += unlike ? 1U : 0U;
        if (from_middle_m > 8.0 * 30.0) on_land += unlike ? 1U : 0U;
    }
    EXPECT_EQ(in_lake, 0U) << "pixels with trees, in water";
    EXPECT_GT(on_land, 100U);
}

// But for a pixel whose middle lies on an edge of two triangles.
TEST_F(TreePictures, AreTheSameByBothWaysOfDrawing) {
    const Region region = slope(1100.0, 0.58);
    const gpu::FrameStyle style = natural(region, true);
    for (const int sample_count : {1, 3})
        EXPECT_LE(unlike_px(picture(region, camera(1100.0), style, RasterPath::mesh, sample_count),
                            picture(region, camera(1100.0), style, RasterPath::compute, sample_count)),
                  8U + width_px * height_px / 5000U);
}

// A picture in tiles has the trees of the whole one: they do not know of tiles.
TEST_F(TreePictures, AreTheSameInTiles) {
    const Region region = slope(1100.0, 0.58);
    gpu::FrameStyle style = natural(region, true);
    style.shadows = style.sky_openness = 0;
    auto scene = test::create_scene(*gpu_, region, {.means = true});
    ASSERT_TRUE(scene.ok());
    PictureOptions options;
    options.path = RasterPath::compute;
    options.largest_tile_px = 96;
    std::vector<std::uint8_t> tiled;
    const auto report =
        render_picture(*gpu_, *scene, camera(1100.0), style, options, [&](std::span<const std::uint8_t> row) {
            tiled.insert(tiled.end(), row.begin(), row.end());
            return Result<void>();
        });
    ASSERT_TRUE(report.ok()) << report.error().line();
    EXPECT_GT(report->tiles, 1);
    EXPECT_LE(unlike_px(tiled, picture(region, camera(1100.0), style, RasterPath::compute)),
              width_px * height_px / 200U);
}

// Brute force: over hills whose crests hide forest no tree is left out that shows, from random eyes near the
// ground and above it.
TEST_F(TreePictures, AreTheSameWhereHiddenOnesAreDrawn) {
    constexpr unsigned seed = 20261128;
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Region region{std::vector<RegionGrid>(1)};
    const auto H_m = [](double row, double column) {
        return 1100.0 + 90.0 * std::sin(row * 0.35) * std::cos(column * 0.28) + 3.0 * (64.0 - row);
    };
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 129, H_m);
    const gpu::FrameStyle style = natural(region, true), bare = natural(region, false);
    std::size_t of_trees_px = 0;
    const int eyes = test::asked_count("OROGRAPH_TREE_EYES", 12);
    for (int i = 0; i < eyes; ++i) {
        Camera one = camera(0.0);
        const double north_m = number(-800.0, 800.0), east_m = number(-800.0, 800.0);
        one.eye = {46.5 + north_m / 111'000.0, 8.0 + east_m / 76'600.0,
                   H_m(64.0 - north_m / 30.0, 64.0 + east_m / 30.0) + std::exp(number(1.0, 5.5))};
        one.attitude = {number(0.0, 360.0), number(-25.0, 5.0), number(-10.0, 10.0)};
        one.vertical_fov_deg = number(10.0, 70.0);
        const RasterPath path = i % 2 == 0 ? RasterPath::compute : RasterPath::mesh;
        const auto all = picture(region, one, style, path, 1, OcclusionUse::off);
        EXPECT_EQ(unlike_px(picture(region, one, style, path, 1, OcclusionUse::on), all), 0U)
            << "seed " << seed << ", eye " << i;
        of_trees_px += unlike_px(picture(region, one, bare, path), all);
    }
    EXPECT_GT(of_trees_px, std::size_t{5000} * static_cast<std::size_t>(eyes) / 12U);
}

// Who asks for depths sees the ground, coloured as without trees.
TEST_F(TreePictures, AreNoGround) {
    const Region region = slope(1100.0, 0.58);
    Style with{}, without{};
    with.frame = natural(region, true);
    without.frame = natural(region, false);
    const auto one = drawn(region, camera(1100.0), with, true),
               other = drawn(region, camera(1100.0), without, true);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->rgba, other->rgba);
    EXPECT_EQ(one->depths, other->depths);
}

TEST_F(TreePictures, AreRefusedWhereTheGroundHasNoMaterials) {
    const Region region = slope(1100.0, 0.3);
    const auto line_of = [&](std::string text, const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
        const auto style = style_of(text, ".json", Camera{}, region.grids[0].field);
        return style.ok() ? std::string() : style.error().line();
    };
    EXPECT_NE(line_of(natural_text(true), "\"trees\": true", "\"trees\": 1").find("trees"),
              std::string::npos);
    EXPECT_NE(line_of(natural_text(true), "\"trees\": true", "\"trees\": true, \"moss\": true").find("moss"),
              std::string::npos);
    std::ifstream file(test::bundled_data() / "styles" / "haze.json");
    const std::string haze((std::istreambuf_iterator<char>(file)), {});
    EXPECT_NE(line_of(haze, "{", "{ \"growth\": { \"trees\": true },").find("'growth'"), std::string::npos);
}

}  // namespace
}  // namespace oro

// Forests that are farther than their trees: as high as these, the same by both ways of drawing; and water
// that mirrors what stands beyond.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "render/frame/picture_renderer.h"
#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

class FarForestPictures : public test::StyleTest {
  protected:
    static constexpr int width_px = 192, height_px = 144;
    static constexpr double fov_deg = 20.0, half_rad = 10.0 * std::numbers::pi / 180.0;

    // Square cells of 30 m; H by metres north and east of the middle.
    template <typename HeightAt>
    static Region region_of(const HeightAt& H_m) {
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 129, [&](int row, int column) {
            return H_m(30.0 * (64 - row), 30.0 * (column - 64));
        });
        return region;
    }
    // A ridge from west to east, round over 90 m, that falls away on both sides: forest by the rule of
    // materials.
    static Region ridge(double rise = 0.58) {
        return region_of(
            [&](double north_m, double) { return 1300.0 - rise * (std::hypot(north_m, 90.0) - 90.0); });
    }
    // A lake, and 900 m north of the middle a wall of 240 m.
    static Region lake() {
        return region_of(
            [](double north_m, double) { return 1100.0 + std::clamp(4.0 * (north_m - 900.0), 0.0, 240.0); });
    }

    static gpu::FrameStyle natural(const Region& region, bool trees) {
        std::ifstream file(test::bundled_data() / "styles" / "natural.json");
        std::string text((std::istreambuf_iterator<char>(file)), {});
        const std::string growth = ",\n  \"growth\": { \"trees\": true, \"grass\": true }";
        const std::size_t at = text.find(growth);
        EXPECT_NE(at, std::string::npos);
        if (at != std::string::npos)
            text.replace(at, growth.size(), trees ? ",\n  \"growth\": { \"trees\": true }" : "");
        const auto style =
            style_of(text, ".json", Camera{}, region.grids[0].field, SunDirection{180.0, 50.0});
        EXPECT_TRUE(style.ok()) << style.error().line();
        gpu::FrameStyle frame = style->frame;
        frame.shadows = frame.sky_openness = 0;
        return frame;
    }

    static Camera camera(double south_m, double h_m, double pitch_deg) {
        Camera camera;
        camera.eye = {46.5 - south_m / 111'170.0, 8.0, h_m};
        camera.attitude = {0.0, pitch_deg, 0.0};
        camera.vertical_fov_deg = fov_deg;
        camera.width_px = width_px;
        camera.height_px = height_px;
        return camera;
    }

    struct How {
        RasterPath path{RasterPath::compute};
        int samples{1};
        double tau_px{1.0};
        int largest_tile_px{0};
    };
    std::vector<std::uint8_t> picture(const Region& region, const Camera& camera,
                                      const gpu::FrameStyle& style, const How& how) {
        auto scene = test::create_scene(*gpu_, region, {.means = true});
        EXPECT_TRUE(scene.ok());
        if (!scene.ok()) return {};
        std::vector<std::uint8_t> rgb;
        PictureOptions options;
        options.path = how.path;
        options.samples = how.samples;
        options.tau_px = how.tau_px;
        options.largest_tile_px = how.largest_tile_px;
        const auto report =
            render_picture(*gpu_, *scene, camera, style, options, [&](std::span<const std::uint8_t> row) {
                rgb.insert(rgb.end(), row.begin(), row.end());
                return Result<void>();
            });
        EXPECT_TRUE(report.ok()) << report.error().line();
        return rgb;
    }
    // Pixels that are not blue before they begin from above, in the mean of all columns: the row of the
    // skyline.
    static double skyline_px(const std::vector<std::uint8_t>& rgb) {
        double sum = 0.0;
        for (int x = 0; x < width_px; ++x) {
            int y = 0;
            for (; y < height_px; ++y) {
                const std::size_t at =
                    3 * (static_cast<std::size_t>(y) * width_px + static_cast<std::size_t>(x));
                if (rgb[at + 2] <= rgb[at + 1]) break;
            }
            sum += y;
        }
        return sum / width_px;
    }
    static std::size_t unlike_px(const std::vector<std::uint8_t>& one,
                                 const std::vector<std::uint8_t>& other) {
        EXPECT_EQ(one.size(), other.size());
        std::size_t count = 0;
        for (std::size_t i = 0; i + 2 < std::min(one.size(), other.size()); i += 3)
            count += one[i] == other[i] && one[i + 1] == other[i + 1] && one[i + 2] == other[i + 2] ? 0U : 1U;
        return count;
    }
};

// Wooded ridges before the sky, 800 m away, with their trees and, by a tau that lets none be drawn, without:
// as high in the mean. Found: without trees a forest was as high as its ground.
TEST_F(FarForestPictures, IsAsHighAsItsTrees) {
    double trees_sum_m = 0.0, forest_sum_m = 0.0;
    const std::vector<double> rises{0.35, 0.45, 0.58, 0.7};
    for (const double rise : rises) {
        const Region region = ridge(rise);
        const Camera eye = camera(800.0, 1280.0, 0.0);
        const double px_per_m = 0.5 * height_px / std::tan(half_rad) / 800.0;
        const auto skyline_m = [&](bool trees, double tau_px) {
            const How how{.samples = 4, .tau_px = tau_px};
            return -skyline_px(picture(region, eye, natural(region, trees), how)) / px_per_m;
        };
        const double ground = skyline_m(false, 1.0), trees = skyline_m(true, 1.0) - ground,
                     forest = skyline_m(true, 8.0) - ground;
        std::printf("rise %.2f: trees stand %.1f m above the ground, far forest %.1f m\n", rise, trees,
                    forest);
        EXPECT_NEAR(forest, trees, 2.5) << rise;
        trees_sum_m += trees;
        forest_sum_m += forest;
    }
    EXPECT_NEAR(forest_sum_m, trees_sum_m, 1.0 * static_cast<double>(rises.size()));
    EXPECT_GT(trees_sum_m, 10.0 * static_cast<double>(rises.size()));
}

TEST_F(FarForestPictures, IsTheSameByBothWaysOfDrawing) {
    const Region region = ridge();
    const Camera eye = camera(800.0, 1260.0, -4.0);
    const gpu::FrameStyle style = natural(region, true);
    const auto bare = picture(region, eye, natural(region, false), {.tau_px = 8.0});
    for (const int rays : {1, 3}) {
        const auto one = picture(region, eye, style, {RasterPath::mesh, rays, 8.0}),
                   other = picture(region, eye, style, {RasterPath::compute, rays, 8.0});
        // A pixel whose middle lies on an edge of two triangles stands in the six above it, too.
        EXPECT_LE(unlike_px(one, other), 7U * (8U + width_px * height_px / 5000U));
        EXPECT_GT(unlike_px(other, bare), width_px * height_px / 10U);
    }
}

// What rises into a tile stands in the next one.
TEST_F(FarForestPictures, IsTheSameInTiles) {
    const Region region = ridge();
    const Camera eye = camera(800.0, 1260.0, -4.0);
    const gpu::FrameStyle style = natural(region, true);
    for (const int rays : {1, 3})
        EXPECT_LE(unlike_px(picture(region, eye, style, {RasterPath::compute, rays, 8.0, 96}),
                            picture(region, eye, style, {RasterPath::compute, rays, 8.0})),
                  width_px * height_px / 200U);
}

// The wall's mirrored top stands as far below the far shore as the wall's top stands above it, as the eye of
// a mirrored camera sees it: that of an eye so far below the water.
TEST_F(FarForestPictures, IsMirroredInLakes) {
    const Region region = lake();
    const double away_m = 1500.0, eye_m = 12.0;
    const Camera eye = camera(600.0, 1100.0 + eye_m, -2.0);
    const auto with = picture(region, eye, natural(region, true), {}),
               without = picture(region, eye, natural(region, false), {});
    const auto row_of = [&](double below_eye_rad) {
        const double from_axis = std::tan(below_eye_rad - 2.0 * std::numbers::pi / 180.0);
        return 0.5 * height_px * (1.0 + from_axis / std::tan(half_rad));
    };
    const double shore = row_of(std::atan(eye_m / away_m));
    const double top = row_of(std::atan((240.0 + eye_m) / (away_m + 60.0)));
    const auto changed = [&](double from, double to) {
        std::size_t count = 0, of = 0;
        for (int y = static_cast<int>(std::ceil(from)); y < std::min(to, static_cast<double>(height_px)); ++y)
            for (int x = width_px / 4; x < 3 * width_px / 4; ++x, ++of) {
                const std::size_t at =
                    3 * (static_cast<std::size_t>(y) * width_px + static_cast<std::size_t>(x));
                count += std::abs(with[at + 2] - without[at + 2]) > 1 ? 1U : 0U;
            }
        return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(of, 1));
    };
    const double reaches = shore + 1.0 * (top - shore);
    std::printf("shore in row %.1f, mirrored top in row %.1f; changed: %.2f before it, %.2f behind\n", shore,
                top, changed(shore + 2.0, shore + 0.7 * (top - shore)), changed(reaches + 8.0, height_px));
    EXPECT_GT(changed(shore + 2.0, shore + 0.7 * (top - shore)), 0.8);
    EXPECT_LT(changed(reaches + 8.0, height_px), 0.02);
}

}  // namespace
}  // namespace oro

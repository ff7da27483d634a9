// Pictures of several tiles over lakes and forests are those of one tile: water mirrors what other tiles
// show, and forests rise in tiles that have no trees of their own.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "geo/sources/region_request.h"
#include "render/frame/picture_renderer.h"
#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

class TiledPictures : public test::StyleTest {
  protected:
    using Pixels = std::vector<std::uint8_t>;

    // H by metres north of the middle; square cells.
    template <typename HeightAt>
    static Region made_region(int posts, double cell_m, const HeightAt& H_m) {
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = test::square_field(
            46.5, 8.0, cell_m, posts, [&](int row, int) { return H_m(cell_m * (posts / 2 - row)); });
        return region;
    }
    // A lake, and 900 m north of the middle a wall of 240 m.
    static Region lake_and_wall() {
        return made_region(129, 30.0, [](double north_m) {
            return 1100.0 + std::clamp(4.0 * (north_m - 900.0), 0.0, 240.0);
        });
    }
    static Camera eye_at(double south_m, double h_m, const Attitude& attitude, double fov_deg) {
        Camera camera;
        camera.eye = {46.5 - south_m / 111'170.0, 8.0, h_m};
        camera.attitude = attitude;
        camera.vertical_fov_deg = fov_deg;
        camera.width_px = 192;
        camera.height_px = 144;
        return camera;
    }
    static Camera eye_over_lake(const Attitude& attitude) { return eye_at(600.0, 1112.0, attitude, 34.0); }

    static gpu::FrameStyle natural_style(const Region& region, const SunDirection& sun) {
        std::ifstream file(test::bundled_data() / "styles" / "natural.json");
        const std::string text((std::istreambuf_iterator<char>(file)), {});
        const auto style = style_of(text, ".json", Camera{}, region.grids[0].field, sun);
        EXPECT_TRUE(style.ok()) << style.error().line();
        return style->frame;
    }
    static gpu::FrameStyle without_trees(gpu::FrameStyle style) {
        style.materials.on &= ~gpu::materials_with_trees;
        return style;
    }

    struct Drawing {
        int samples{1};
        int largest_tile_px{0};  // 0: one tile
        double exaggeration{1.0};
        double tau_px{1.0};
    };
    static PictureOptions options_of(const Drawing& how) {
        PictureOptions options;
        options.path = RasterPath::compute;
        options.tau_px = how.tau_px;
        options.samples = how.samples;
        options.largest_tile_px = how.largest_tile_px;
        return options;
    }
    // What is drawn of a part of a camera's picture.
    static Pixels drawn_by(PictureRenderer& renderer, Scene& scene, const Camera& camera, const Tile& part,
                           const gpu::FrameStyle& style) {
        Pixels rgb;
        const auto report =
            renderer.draw_part(scene, camera, part, style, [&](std::span<const std::uint8_t> row) {
                rgb.insert(rgb.end(), row.begin(), row.end());
                return Result<void>();
            });
        EXPECT_TRUE(report.ok()) << report.error().line();
        return rgb;
    }
    static Tile whole_of(const Camera& camera) { return {0, 0, camera.width_px, camera.height_px}; }
    Pixels picture(const Region& region, const Camera& camera, const gpu::FrameStyle& style,
                   const Drawing& how) {
        auto scene = test::create_scene(*gpu_, region, {.exaggeration = how.exaggeration, .means = true});
        EXPECT_TRUE(scene.ok());
        auto renderer = PictureRenderer::create(*gpu_, camera, style, options_of(how));
        EXPECT_TRUE(renderer.ok());
        if (!scene.ok() || !renderer.ok()) return {};
        return drawn_by(*renderer, *scene, camera, whole_of(camera), style);
    }

    // Pixels that differ by more than so many codes in one of red, green and blue.
    static std::size_t unlike(const Pixels& one, const Pixels& other, int codes) {
        EXPECT_EQ(one.size(), other.size());
        std::size_t count = 0;
        for (std::size_t i = 0; i + 2 < std::min(one.size(), other.size()); i += 3) {
            int most = 0;
            for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(one[i + k] - other[i + k]));
            count += most > codes ? 1U : 0U;
        }
        return count;
    }
};

// Found: below the border of two tiles a lake mirrored nothing but the sky, and beside one less and less.
TEST_F(TiledPictures, MirrorWhatOtherTilesShow) {
    const Region region = lake_and_wall();
    const gpu::FrameStyle style = natural_style(region, {180.0, 50.0});
    const std::size_t pixels = 192 * 144;
    for (const Attitude attitude :
         {Attitude{0.0, -4.0, 0.0}, Attitude{15.0, -12.0, 0.0}, Attitude{-10.0, 6.0, 25.0}}) {
        const Camera eye = eye_over_lake(attitude);
        const Pixels one = picture(region, eye, style, {}), tiles = picture(region, eye, style, {1, 88}),
                     bare = picture(region, eye, without_trees(style), {});
        const std::size_t off = unlike(one, tiles, 1), mirrored = unlike(one, bare, 1);
        std::printf(
            "pitch %.0f, roll %.0f: %zu px of %zu more than a code off; %zu differ from a picture "
            "without trees\n",
            attitude.pitch_deg, attitude.roll_deg, off, pixels, mirrored);
        EXPECT_LE(off, pixels / 500);
        EXPECT_GT(mirrored, pixels / 10) << "or nothing is mirrored there";
    }
}

// Of several samples other tiles have kept the mean colour and the nearest depth: outlines of what is
// mirrored may differ.
TEST_F(TiledPictures, MirrorTheMeanOfSamples) {
    const Region region = lake_and_wall();
    const gpu::FrameStyle style = natural_style(region, {180.0, 50.0});
    const std::size_t pixels = 192 * 144;
    for (const Attitude attitude : {Attitude{0.0, -4.0, 0.0}, Attitude{-10.0, 6.0, 25.0}}) {
        const Camera eye = eye_over_lake(attitude);
        const Pixels one = picture(region, eye, style, {3}), tiles = picture(region, eye, style, {3, 88});
        double sum = 0.0;
        for (std::size_t i = 0; i < one.size(); ++i) sum += tiles[i] - one[i];
        std::printf(
            "roll %.0f: %zu px of %zu more than a code off, %zu more than 8; %.4f codes in the mean\n",
            attitude.roll_deg, unlike(one, tiles, 1), pixels, unlike(one, tiles, 8),
            sum / static_cast<double>(one.size()));
        EXPECT_LE(unlike(one, tiles, 1), pixels / 20);
        EXPECT_LE(unlike(one, tiles, 8), pixels / 100);
        EXPECT_NEAR(sum / static_cast<double>(one.size()), 0.0, 0.1);
    }
}

// A part has the whole picture's pixels, and a picture none of the one before it.
TEST_F(TiledPictures, MirrorInPartsAndAfterOtherPictures) {
    const Region region = lake_and_wall();
    const gpu::FrameStyle style = natural_style(region, {180.0, 50.0});
    const Camera eye = eye_over_lake({0.0, -4.0, 0.0}), other = eye_over_lake({8.0, -1.0, 0.0});
    auto scene = test::create_scene(*gpu_, region, {.means = true});
    ASSERT_TRUE(scene.ok());
    auto renderer = PictureRenderer::create(*gpu_, eye, style, options_of({1, 88}));
    ASSERT_TRUE(renderer.ok());
    const Pixels whole = drawn_by(*renderer, *scene, eye, whole_of(eye), style);
    drawn_by(*renderer, *scene, other, whole_of(other), style);
    const Tile part{100, 90, 60, 40};
    const Pixels rows = drawn_by(*renderer, *scene, eye, part, style);
    ASSERT_EQ(rows.size(), 3U * 60U * 40U);
    Pixels same;
    for (int y = 0; y < part.height_px; ++y) {
        const auto from = whole.begin() + std::ptrdiff_t{3} * ((part.y_px + y) * 192 + part.x_px);
        same.insert(same.end(), from, from + std::ptrdiff_t{3} * part.width_px);
    }
    EXPECT_EQ(unlike(rows, same, 0), 0U);
    EXPECT_EQ(drawn_by(*renderer, *scene, eye, whole_of(eye), style), whole);
}

// Low hills from 2,500 m above them: trees end at 3.6 km, and the uppermost tiles show nothing so near.
// Found: there forests did not rise.
TEST_F(TiledPictures, RaiseForestsWhereTilesHaveNoTrees) {
    const Region region =
        made_region(513, 30.0, [](double north_m) { return 1250.0 + 60.0 * std::sin(north_m / 130.0); });
    const gpu::FrameStyle style = natural_style(region, {180.0, 50.0});
    Camera eye = eye_at(7000.0, 3750.0, {0.0, -30.0, 0.0}, 40.0);
    eye.height_px = 432;
    const Pixels one = picture(region, eye, style, {}), tiles = picture(region, eye, style, {1, 144}),
                 bare = picture(region, eye, without_trees(style), {});
    const auto upper = [](const Pixels& rgb) { return Pixels(rgb.begin(), rgb.begin() + 3 * 192 * 110); };
    std::printf(
        "%zu px of %d more than a code off; %zu of %d in the upper tiles differ from a picture "
        "without trees\n",
        unlike(one, tiles, 1), 192 * 432, unlike(upper(one), upper(bare), 1), 192 * 110);
    EXPECT_LE(unlike(one, tiles, 1), 192U * 432U / 500U);
    EXPECT_GT(unlike(upper(one), upper(bare), 1), 192U * 110U / 10U);
}

// A slope whose forest rises up to 32 px. Found: what rises farther than it would without exaggeration ended
// at borders of tiles, which saw 20 px below them.
TEST_F(TiledPictures, RaiseForestsOfExaggeratedGround) {
    const Region region = made_region(
        129, 30.0, [](double north_m) { return 1300.0 - 0.1 * (std::hypot(north_m, 90.0) - 90.0); });
    const gpu::FrameStyle style = natural_style(region, {180.0, 50.0});
    const Camera eye = eye_at(1500.0, 7752.0, {0.0, -4.0, 0.0}, 30.0);
    const Drawing at_once{1, 0, 6.0, 2.0}, in_tiles{1, 112, 6.0, 2.0};
    const Pixels one = picture(region, eye, style, at_once), tiles = picture(region, eye, style, in_tiles),
                 bare = picture(region, eye, without_trees(style), at_once);
    std::printf("%zu px of %d more than a code off; %zu differ from a picture without trees\n",
                unlike(one, tiles, 1), 192 * 144, unlike(one, bare, 1));
    EXPECT_LE(unlike(one, tiles, 1), 5U);
    EXPECT_GT(unlike(one, bare, 1), 192U * 144U / 10U);
}

// The Lake of Brienz from its shore, and from above it with a turned camera.
TEST_F(TiledPictures, OfTheLakeOfBrienzAreThoseOfOneTile) {
    const auto data = test::real_data("alps");
    if (!data) GTEST_SKIP() << "needs alps of OROGRAPH_TEST_DATA";
    RegionRequest request;
    request.paths = {data->string()};
    request.box = BoundingBox{7.85, 46.66, 8.15, 46.82};
    const auto region = open_region(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    const gpu::FrameStyle style = natural_style(*region, {230.0, 40.0});
    struct Eye {
        Geodetic at;
        Attitude attitude;
    };
    for (const Eye& from : {Eye{{46.7205, 7.9600, 618.0}, {60.0, 2.0, 0.0}},
                            Eye{{46.7340, 8.0250, 900.0}, {235.0, -8.0, -12.0}}}) {
        Camera eye;
        eye.eye = from.at;
        eye.attitude = from.attitude;
        eye.vertical_fov_deg = 60.0;
        eye.width_px = 480;
        eye.height_px = 270;
        const std::size_t pixels = 480 * 270;
        const Pixels one = picture(*region, eye, style, {}), tiles = picture(*region, eye, style, {1, 180});
        std::printf("heading %.0f: %.2f %% of pixels more than a code off, %.2f %% more than 8\n",
                    from.attitude.heading_deg, 100.0 * static_cast<double>(unlike(one, tiles, 1)) / pixels,
                    100.0 * static_cast<double>(unlike(one, tiles, 8)) / pixels);
        EXPECT_LE(unlike(one, tiles, 1), pixels / 200);
        EXPECT_LE(unlike(one, tiles, 8), pixels / 500);
    }
}

}  // namespace
}  // namespace oro

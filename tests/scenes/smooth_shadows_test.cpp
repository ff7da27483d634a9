// Near the eye shadows are those of the smooth surface that is shaded: how far they are from those of
// triangles.
#include "core/light/sun_position.h"
#include "tests/scenes/real_tiles.h"
#include "tests/scenes/scene_of_grids.h"
#include "tests/scenes/shadows_of_pictures.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

using test::ShadowsOfPictures;
using test::shares_alone;

// ... and slopes have light and shade.
gpu::FrameStyle shaded_alone(const glm::dvec3& sun_enu, float colour, float relief) {
    gpu::FrameStyle style = shares_alone(sun_enu);
    style.tints[0].colour = gpu::vec3(colour);
    style.relief = relief;
    return style;
}

// A view of the Alps whose ground, in a part of the picture (of 1: left, top, right, bottom), has no shadow
// on it but that of a triangle on itself or on the next.
struct NearView {
    const char* tiles;
    Camera camera;
    double sun_azimuth_deg, sun_elevation_deg;
    double box[4];
};

// Where a cell of posts covers hundreds of pixels, shaded smoothly, a triangle of it that is turned away from
// the sun was a dark patch with hard edges: first any, then those that are 14 degrees steeper than the light,
// then those where a cell covers ten pixels.
TEST_F(ShadowsOfPictures, HaveNoEdgesOfTrianglesNearTheEye) {
    if (!test::real_data("alps")) GTEST_SKIP() << "needs alps";
    const NearView views[] = {
        {"N46E007:N46E008",
         {{46.67, 8.06, 2537.0}, {205.0, -4.0, 0.0}, 45.0, 960, 540},
         315.0,
         38.0,
         {0.5, 0.75, 1.0, 1.0}},
        {"N46E008:N46E008",
         {{46.3, 8.2, 3053.0}, {30.0, -8.0, 0.0}, 45.0, 960, 540},
         150.0,
         15.0,
         {0.42, 0.48, 0.75, 0.9}},
        {"N46E007:N46E008",
         {{46.67, 8.06, 2539.9}, {205.0, -4.0, 0.0}, 45.0, 1280, 720},
         107.16,
         47.35,
         {0.32, 0.59, 0.36, 0.69}},
    };
    for (const NearView& view : views) {
        const auto region = test::open_tiles("alps", view.tiles);
        ASSERT_TRUE(region.ok()) << region.error().line();
        auto made = Scene::create(*gpu_, pages_in_memory(region->grids[0].field, 1.0, thread_count()),
                                  {std::uint64_t{1} << 30U, 0});
        ASSERT_TRUE(made.ok()) << made.error().line();
        DepthPainter painter(*gpu_, RasterPath::compute);
        gpu::FrameStyle style =
            shaded_alone(enu_towards(view.sun_azimuth_deg, view.sun_elevation_deg), 0.8F, 1.2F);
        const auto with = painter.draw(*made, view.camera, style, {});
        style.shadows = 0;
        const auto without = painter.draw(*made, view.camera, style, {});
        ASSERT_TRUE(with.ok() && without.ok());
        const int width = view.camera.width_px, height = view.camera.height_px;
        int darker = 0, most = 0;
        for (int y = static_cast<int>(view.box[1] * height); y < static_cast<int>(view.box[3] * height); ++y)
            for (int x = static_cast<int>(view.box[0] * width); x < static_cast<int>(view.box[2] * width);
                 ++x) {
                const auto i = static_cast<std::size_t>(4 * (y * width + x));
                const int by = without->rgba[i] - with->rgba[i];
                darker += by > 20;
                most = std::max(most, by);
            }
        std::printf("%s: %d pixels darker by more than 20 codes, the darkest by %d\n", view.tiles, darker,
                    most);
        EXPECT_LE(darker, 10);
    }
}

struct SmoothTally {
    std::uint64_t facing{}, dark{}, lighter{}, darker{};
};

// Of ground whose smooth slope has sunlight, at least a twentieth of what a slope can have: what is dark as
// triangles and lit in the picture, and the other way about.
SmoothTally compare(const DepthPicture& triangles, const DepthPicture& with, const DepthPicture& without) {
    constexpr int half = 188, a_twentieth = 63;  // of the light, as codes of sRGB
    SmoothTally tally;
    for (std::size_t i = 0; i < triangles.points.size(); ++i) {
        if (triangles.points[i].background() || without.rgba[4 * i] < a_twentieth) continue;
        const bool is_dark = triangles.rgba[4 * i] < half,
                   shown_dark = 2 * with.rgba[4 * i] < without.rgba[4 * i];
        ++tally.facing;
        tally.dark += is_dark;
        tally.lighter += is_dark && !shown_dark;
        tally.darker += shown_dark && !is_dark;
    }
    return tally;
}

// Eyes 20 to 500 m above the Alps, which look 20 degrees down, and suns 8 to 40 degrees high.
TEST_F(ShadowsOfPictures, OfSmoothGroundAreNearlyThoseOfTriangles) {
    if (!test::real_data("alps")) GTEST_SKIP() << "needs alps";
    constexpr std::uint64_t seed = 612;
    const int views = test::view_count(8);
    const auto region = test::open_tiles("alps", "N46E008:N46E008");
    ASSERT_TRUE(region.ok()) << region.error().line();
    const TrueSurface surface(region->grids[0].field, 1.0, thread_count());
    auto scene = Scene::create(*gpu_, pages_in_memory(region->grids[0].field, 1.0, thread_count()),
                               {std::uint64_t{1} << 30U, 0});
    ASSERT_TRUE(scene.ok()) << scene.error().line();
    DepthPainter painter(*gpu_, RasterPath::compute);
    std::mt19937_64 random(seed);
    const auto between = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    SmoothTally together;
    for (int view = 0; view < views; ++view) {
        Camera camera{
            {between(46.1, 46.9), between(8.1, 8.9), 0.0}, {between(0.0, 360.0), -20.0, 0.0}, 45.0, 320, 180};
        const PostNumber post = region->grids[0].field.grid.post_at(camera.eye.lat_deg, camera.eye.lon_deg);
        const auto ground_m = surface.h_at_m(post.row, post.column);
        ASSERT_TRUE(ground_m);
        camera.eye.h_m = *ground_m + between(20.0, 500.0);
        const double azimuth_deg = between(0.0, 360.0), elevation_deg = between(8.0, 40.0);
        const glm::dvec3 sun_enu = enu_towards(azimuth_deg, elevation_deg);
        const auto triangles = painter.draw(*scene, camera, shares_alone(sun_enu), {});
        gpu::FrameStyle style = shaded_alone(sun_enu, 1.0F, 1.0F);
        const auto with = painter.draw(*scene, camera, style, {});
        style.shadows = 0;
        const auto without = painter.draw(*scene, camera, style, {});
        ASSERT_TRUE(triangles.ok() && with.ok() && without.ok());
        const SmoothTally one = compare(*triangles, *with, *without);
        together.facing += one.facing;
        together.dark += one.dark;
        together.lighter += one.lighter;
        together.darker += one.darker;
    }
    const auto percent = [&together](std::uint64_t count) {
        return 100.0 * static_cast<double>(count) / static_cast<double>(together.facing);
    };
    std::printf(
        "seed %llu, %d views: %llu pixels that face the sun, %.2f %% dark as triangles; %.2f %% lit though "
        "dark, %.2f %% dark though lit\n",
        static_cast<unsigned long long>(seed), views, static_cast<unsigned long long>(together.facing),
        percent(together.dark), percent(together.lighter), percent(together.darker));
    EXPECT_GT(percent(together.dark), 2.0) << "or the test sees no shadow";
    EXPECT_LT(percent(together.lighter), 1.5);
    EXPECT_LT(percent(together.darker), 0.1);
}

// Another grid in the frame changes nothing of a grid's shadows on itself: those of cells of 4.4 km, of which
// three are longer than the pieces that lines are followed by.
TEST_F(ShadowsOfPictures, OfSmoothGroundAreTheSameBesideAnotherGrid) {
    const auto hills = [](double lat_deg, double lon_deg) {
        return static_cast<float>(1500.0 * (std::sin(40.0 * lat_deg) + std::sin(31.0 * lon_deg)));
    };
    const HeightField wide = test::made_field(48.0, 6.0, 25.0, 60, 80, hills),
                      other = test::made_field(46.5, 9.6, 100.0, 40, 40, hills);
    const auto drawn = [&](bool with_other) {
        Scene scene = test::scene_of_pages(*gpu_, pages_in_memory(wide, 1.0, 2));
        if (with_other) scene.add(test::scene_of_pages(*gpu_, pages_in_memory(other, 1.0, 2)));
        const gpu::FrameStyle style = shaded_alone(enu_towards(110.0, 8.0), 1.0F, 1.0F);
        const Camera camera{{46.6, 6.8, 40000.0}, {70.0, -35.0, 0.0}, 50.0, 320, 180};
        return DepthPainter(*gpu_, RasterPath::compute).draw(scene, camera, style, {});
    };
    const auto alone = drawn(false), with_other = drawn(true);
    ASSERT_TRUE(alone.ok() && with_other.ok());
    int asked = 0, dark = 0, differ = 0;
    for (std::size_t i = 0; i < with_other->points.size(); ++i) {
        if (with_other->points[i].background() || with_other->points[i].grid != 0) continue;
        ++asked;
        dark += with_other->rgba[4 * i] < 20;
        differ += std::abs(alone->rgba[4 * i] - with_other->rgba[4 * i]) > 8;
    }
    std::printf("%d pixels, %d dark, %d differ\n", asked, dark, differ);
    EXPECT_GT(dark, asked / 50) << "or the test sees no shadow";
    EXPECT_LE(differ, 3);
}

}  // namespace
}  // namespace oro

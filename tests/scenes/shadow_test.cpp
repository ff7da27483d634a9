// Must hold: what lies in shadow on a picture lies in shadow in truth.
#include <cstdlib>

#include "geo/region/region.h"
#include "tests/scenes/shadows_of_pictures.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using test::ShadowsOfPictures;
using test::shares_alone;

TEST_F(ShadowsOfPictures, OfMadeTerrainAreTheOracles) {
    const int views = (test::view_count(6) + 2) / 3;
    look_over("made terrain", test::rough_field(47.0, 8.0, 700, 900), views);
    judge(views);
}

// Posts that lie on nets: turned, and over a pole.
TEST_F(ShadowsOfPictures, OnNetsAreTheOracles) {
    const int views = (test::view_count(6) + 2) / 3;
    for (const auto& [name, plane] :
         {std::pair("a turned net", test::PlaneOfPosts{700, 900, {46.5, 8.0}, 80.0, 27.0}),
          std::pair("a net over the pole", test::PlaneOfPosts{700, 700, {89.9, 40.0}, 90.0, 0.0})})
        look_over(name, test::net_field(plane, test::patchy_H_m, 40.0F), views);
    judge(2 * views);
}

TEST_F(ShadowsOfPictures, OfRealTerrainAreTheOracles) {
    const int views = test::view_count(6);
    for (std::size_t i = 0; i < test::real_regions.size(); ++i) {
        const test::RealRegion& real = test::real_regions[i];
        if (!test::real_data(real.folder)) GTEST_SKIP() << "needs " << real.folder;
        RegionRequest request;
        request.paths = {test::real_data(real.folder)->string()};
        request.box = *parse_tile_range(real.tiles);
        const auto region = open_region(request);
        ASSERT_TRUE(region.ok()) << region.error().line();
        look_over(real.folder, region->field, test::views_of(i, views));
    }
    judge(views);
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
    const auto alps = test::real_data("alps");
    if (!alps) GTEST_SKIP() << "needs alps";
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
        RegionRequest request;
        request.paths = {alps->string()};
        request.box = *parse_tile_range(view.tiles);
        const auto region = open_region(request);
        ASSERT_TRUE(region.ok()) << region.error().line();
        auto made = Scene::create(*gpu_, pages_in_memory(region->field, 1.0, thread_count()),
                                  {std::uint64_t{1} << 30U, 0});
        ASSERT_TRUE(made.ok()) << made.error().line();
        DepthPainter painter(*gpu_, RasterPath::compute);
        const SineCosine a = sine_cosine_deg(view.sun_azimuth_deg),
                         e = sine_cosine_deg(view.sun_elevation_deg);
        gpu::FrameStyle style = shares_alone({e.cosine * a.sine, e.cosine * a.cosine, e.sine});
        style.tints[0].colour = gpu::vec3(0.8F);
        style.relief = 1.2F;
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

}  // namespace
}  // namespace oro

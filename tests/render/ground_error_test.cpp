// What measures a picture sees: ground moved sideways, up, and not at all; by both ways of drawing.
#include "core/measure/ground_error.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/measure/drawn_point.h"
#include "core/measure/seen_error.h"
#include "core/terrain/ground.h"
#include "render/frame/depth_picture.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

class GroundErrorOfPictures : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    DepthPicture draw(const HeightField& field, const Camera& camera, const DepthPictureOptions& options) {
        auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2));
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        DepthPainter painter(*gpu_, GetParam());
        auto picture = painter.draw(*scene, camera, {}, options);
        EXPECT_TRUE(picture.ok()) << picture.error().line();
        return std::move(picture).value();
    }
};

Camera over_rough_terrain(const HeightField& field) {
    Camera camera;
    camera.eye = {46.875, 8.125, ground_h_m(field, 46.875, 8.125).value_or(0.0) + 400.0};
    camera.attitude = {30.0, -12.0, 20.0};
    camera.width_px = 150;
    camera.height_px = 100;
    return camera;
}

// At full detail each pixel's ground point is what the oracle, which shares nothing with the GPU, sees there.
TEST_P(GroundErrorOfPictures, AtFullDetailPointsAreTheOracles) {
    const HeightField field = test::rough_field(47.0, 8.0, 300, 300);
    const Camera camera = over_rough_terrain(field);
    DepthPictureOptions options;
    options.tau_px = 0.0;
    options.largest_tile_px = 64;
    const DepthPicture picture = draw(field, camera, options);
    const TrueSurface surface(field, 1.0, 2);
    const Sight sight = sight_from(camera.eye);
    const auto hits = Oracle(surface, sight).cast_picture(camera, 2);
    int compared = 0, apart = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!hits[i] || picture.points[i].background()) continue;
        ++compared;
        const double row = field.grid.lat.index_at(hits[i]->point.lat_deg);
        const double column = field.grid.lon.index_at(hits[i]->point.lon_deg);
        // In cells of 93 m: some centimetres, times the slant of the sight line.
        if (std::hypot(row - picture.points[i].row, column - picture.points[i].column) > 0.005) ++apart;
    }
    EXPECT_GT(compared, 8000);
    EXPECT_LT(apart, compared / 500) << "pixels at edges may see the next ridge";
    const GroundErrors errors = ground_errors(surface, sight, camera, picture.points, 2);
    EXPECT_EQ(errors.beyond_data, 0U);
    EXPECT_LT(errors.summary_displacement_px.largest, 0.05) << "px";
    EXPECT_LE(errors.summary_surface_px.largest, errors.summary_displacement_px.largest);
    EXPECT_LE(errors.summary_surface_m.largest, errors.summary_displacement_m.largest);
    const Oracle oracle(surface, sight);
    const SeenErrors seen = seen_errors(oracle, {surface, sight, camera}, hits, camera, picture.points, 2);
    EXPECT_LT(seen.summary_px.largest, 0.05) << "px";
}

// A wall that is missing in the picture is no error of any ground that is drawn: only what is seen tells.
TEST_P(GroundErrorOfPictures, WhatIsMissingIsSeen) {
    const auto plain = [](double, double) { return 500.0F; };
    const auto with_wall = [](double lat_deg, double) {
        return std::abs(lat_deg - 46.55) < 0.002 ? 900.0F : 500.0F;
    };
    const HeightField without = test::made_field(47.0, 9.0, 300.0, 301, 301, plain);
    const HeightField truth = test::made_field(47.0, 9.0, 300.0, 301, 301, with_wall);
    Camera camera;
    camera.eye = {46.5, 9.5, 700.0};
    camera.attitude = {0.0, 0.0, 0.0};
    camera.vertical_fov_deg = 40.0;
    camera.width_px = 160;
    camera.height_px = 120;
    DepthPictureOptions options;
    options.tau_px = 0.0;
    const DepthPicture picture = draw(without, camera, options);
    const TrueSurface surface(truth, 1.0, 2);
    const Sight sight = sight_from(camera.eye);
    const Oracle oracle(surface, sight);
    const auto hits = oracle.cast_picture(camera, 2);
    const SeenErrors seen = seen_errors(oracle, {surface, sight, camera}, hits, camera, picture.points, 2);
    // The wall is 400 m high and 5.33 km away: from 200 / 5330 above the level to as much below, at 60 px in
    // tan(20 degrees) 12.4 px. The ground just behind it is drawn one pixel above its foot; anything so far
    // is seen above the wall only.
    EXPECT_NEAR(seen.summary_px.largest, 11.9, 0.7) << "px";
    EXPECT_GT(seen.other, 5U * 160U);
}

// A plain seen from 60 km straight above: on a sphere its ground moves sideways by up to 1.59 px (median
// 0.80), though the surface stays where it is. The figures: an independent program's, from where coloured
// posts are in the two pictures.
TEST_P(GroundErrorOfPictures, GroundThatIsMovedSidewaysIsSeen) {
    const HeightField field =
        test::made_field(47.0, 9.0, 300.0, 301, 301, [](double, double) { return 500.0F; });
    Camera camera;
    camera.eye = {46.5, 9.5, 60000.0};
    camera.attitude = {0.0, -90.0, 0.0};
    camera.vertical_fov_deg = 60.0;
    camera.width_px = 1600;
    camera.height_px = 1000;
    DepthPictureOptions options;
    options.tau_px = 0.0;
    options.model.earth = Earth::sphere;
    options.skyline = false;
    const DepthPicture picture = draw(field, camera, options);
    const TrueSurface surface(field, 1.0, 2);
    const Sight sight = sight_from(camera.eye);
    const GroundErrors errors = ground_errors(surface, sight, camera, picture.points, 2);
    std::vector<float> sizes;
    for (const float px : errors.displacement_px)
        if (px != not_measured) sizes.push_back(px);
    ASSERT_GT(sizes.size(), 1000000U);
    std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2),
                     sizes.end());
    EXPECT_NEAR(errors.summary_displacement_px.largest, 1.59, 0.05) << "px";
    EXPECT_NEAR(sizes[sizes.size() / 2], 0.80, 0.03) << "px";
    EXPECT_LT(errors.summary_surface_px.largest, 0.05) << "px: the plain is where it was";
}

INSTANTIATE_TEST_SUITE_P(Paths, GroundErrorOfPictures,
                         ::testing::Values(RasterPath::mesh, RasterPath::compute), [](const auto& path) {
                             return path.param == RasterPath::mesh ? "mesh" : "compute";
                         });

}  // namespace
}  // namespace oro

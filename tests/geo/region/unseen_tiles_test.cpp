// What real tiles that are left out do to the skyline of a picture, and what is foretold of it.
#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "core/base/parallel.h"
#include "core/unseen/unseen_ground.h"
#include "geo/region/region.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// Where the ground of each column begins, pixels from the top, to half a pixel.
std::vector<double> skyline_px(const HeightField& field, const Camera& camera) {
    const TrueSurface surface(field, 1.0, thread_count());
    const Oracle oracle(surface, sight_from(camera.eye));
    std::vector<double> skyline(static_cast<std::size_t>(camera.width_px));
    in_parallel(camera.width_px, thread_count(), [&](int x) {
        double y = 0.0;
        while (y < camera.height_px &&
               !oracle.first_hit(camera.ecef_direction_at({x + 0.5, y}), sight_reach_m(camera.eye.h_m)))
            y += 0.5;
        skyline[static_cast<std::size_t>(x)] = y;
    });
    return skyline;
}

// East of 46.5 N 9.95 E, 3.8 km before the edge of N46E009, from 1,500 m above the ground: with N46E010 the
// skyline is 182 px higher in the mean, in 640 of 640 columns.
TEST(UnseenTiles, ATileLeftOutMovesTheSkylineByNoMoreThanTheBound) {
    const auto west = test::real_data("alps/N46E009.SRTMGL3.hgt.zip"),
               east = test::real_data("alps/N46E010.SRTMGL3.hgt.zip");
    if (!west || !east) GTEST_SKIP() << "needs alps/N46E009 and N46E010";
    RegionRequest request;
    request.paths = {west->string()};
    const auto one = test::open_grid(request);
    request.paths.push_back(east->string());
    const auto both = test::open_grid(request);
    ASSERT_TRUE(one.ok() && both.ok());
    const TrueSurface surface(one->field, 1.0, thread_count());
    Camera camera;
    camera.eye = {46.5, 9.95, *surface.h_m(46.5, 9.95) + 1500.0};
    camera.attitude = {90.0, -10.0, 0.0};
    camera.vertical_fov_deg = 50.0;
    camera.width_px = 640;
    camera.height_px = 400;
    const UnseenPicture picture =
        unseen_picture(surface, KnownGround(one->field, {}, false), sight_from(camera.eye), camera,
                       usual_unseen_ceiling_m, thread_count());
    const UnseenGround unseen = unseen_ground(picture, camera, usual_unseen_ceiling_m);
    EXPECT_EQ(unseen.columns_beyond, 640);
    ASSERT_EQ(unseen.missing.size(), 1U);
    EXPECT_EQ(unseen.missing[0].cell, (DegreeCell{46, 10}));
    EXPECT_GE(unseen.bound_px, 182.0);
    const std::vector<double> before = skyline_px(one->field, camera),
                              after = skyline_px(both->field, camera);
    double mean_px = 0.0;
    for (std::size_t x = 0; x < before.size(); ++x) {
        const double moved_px = before[x] - after[x];
        EXPECT_GT(moved_px, 0.0) << x;
        EXPECT_LE(moved_px, static_cast<double>(unseen.column_px[x])) << x;
        mean_px += moved_px / 640.0;
    }
    EXPECT_NEAR(mean_px, 182.0, 0.5);  // each column here to half a pixel
    std::printf("moved by %.1f px in the mean; bound %.0f px\n", mean_px, unseen.bound_px);
}

}  // namespace
}  // namespace oro

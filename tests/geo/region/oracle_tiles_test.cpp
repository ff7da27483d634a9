// The oracle over real tiles: what it costs, and that what it finds is on the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/base/parallel.h"
#include "core/terrain/ground.h"
#include "core/truth/oracle.h"
#include "geo/region/region.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

TEST(OracleOverTiles, EveryPixelOfAPictureOverNineTiles) {
    const auto alps = test::real_data("alps");
    if (!alps) GTEST_SKIP() << "needs alps";
    RegionRequest request;
    request.paths = {alps->string()};
    request.box = *parse_tile_range("N46E006:N47E010");
    const auto region = test::open_grid(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    const HeightField& field = region->field;
    const auto start = std::chrono::steady_clock::now();
    const TrueSurface surface(field, 1.0, thread_count());
    struct Eye {
        double lat_deg, lon_deg, above_m, heading_deg, pitch_deg, fov_deg;
    };
    for (const Eye& eye : {Eye{46.67, 8.06, 300.0, 205.0, -4.0, 45.0}, Eye{46.5, 8.5, 2.0, 0.0, -2.0, 60.0},
                           Eye{46.3, 8.0, 1.0e5, 10.0, -35.0, 45.0}}) {
        Camera camera;
        camera.eye = {eye.lat_deg, eye.lon_deg, *ground_h_m(field, eye.lat_deg, eye.lon_deg) + eye.above_m};
        camera.attitude = {eye.heading_deg, eye.pitch_deg, 0.0};
        camera.vertical_fov_deg = eye.fov_deg;
        camera.width_px = 640;
        camera.height_px = 360;
        const Oracle oracle(surface, sight_from(camera.eye, standard_air));
        const auto before = std::chrono::steady_clock::now();
        const auto hits = oracle.cast_picture(camera, thread_count());
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
        double worst_m = 0.0;
        std::size_t found = 0;
        for (const auto& hit : hits) {
            if (!hit) continue;
            ++found;
            worst_m = std::max(worst_m, std::abs(hit->residual_m));
            if (found % 97 != 0) continue;
            const auto ground_m = ground_h_m(field, hit->point.lat_deg, hit->point.lon_deg);
            ASSERT_TRUE(ground_m);
            ASSERT_NEAR(hit->point.h_m, *ground_m, 1.0e-6);
        }
        std::printf(
            "%zu of 640 x 360 sight lines meet ground, in %.2f s on %d threads; largest residual %.1e m\n",
            found, took.count(), thread_count(), worst_m);
        EXPECT_GT(found, 50000U);
        EXPECT_LT(worst_m, 1.0e-6);
    }
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
    std::printf("%.2f s for all three, making ready included\n", all.count());
}

}  // namespace
}  // namespace oro

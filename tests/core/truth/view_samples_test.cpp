// What a view's samples must not miss: ground that shows between the centres of pixels.
#include "core/truth/view_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/parallel.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

constexpr double far_m = 30000.0;

// Along the equator, seen eastward from 0 E: a wall of 50 m at 2 km, and from 35 km on a plateau.
HeightField wall_and_plateau() {
    return test::made_field(0.05, -0.05, 1200.0, 121, 601, [](double, double lon_deg) {
        const double away_m = lon_deg * 111319.49;
        return away_m > 35000.0 ? 500.0F : std::abs(away_m - 2000.0) < 100.0 ? 50.0F : 0.0F;
    });
}

// 60 columns and rows of 10 degrees.
Camera eastward(double pitch_deg) {
    Camera camera;
    camera.eye = {0.0, 0.0, 30.0};
    camera.attitude = {90.0, pitch_deg, 0.0};
    camera.vertical_fov_deg = 10.0;
    camera.width_px = camera.height_px = 60;
    return camera;
}

// The wall's top is 20 m / 2 km = 0.57 degrees up, the plateau's edge (500 - 30 - 35,000^2 / 2 R = 374 m) /
// 35 km = 0.61 degrees: 0.24 px of 1/6 degree show over the wall. Pitches at which no pixel's centre meets
// that strip.
TEST(ViewSamples, GroundInAStripBetweenPixelsIsThere) {
    const HeightField field = wall_and_plateau();
    const TrueSurface surface(field, 1.0, thread_count());
    int hidden = 0;
    for (double pitch_deg = 0.0; pitch_deg < 0.17; pitch_deg += 0.02) {
        const Camera camera = eastward(pitch_deg);
        const Sight sight = sight_from(camera.eye);
        const auto hits = Oracle(surface, sight).cast_picture(camera, thread_count());
        const bool seen = std::any_of(hits.begin(), hits.end(),
                                      [](const auto& hit) { return hit && hit->distance_m > far_m; });
        if (seen) continue;
        ++hidden;
        const auto samples = view_samples(surface, sight, camera, thread_count());
        const auto far = [](const ViewSample& sample) { return sample.distance_m > far_m; };
        const auto found = std::find_if(samples.begin(), samples.end(), far);
        ASSERT_NE(found, samples.end()) << "pitch " << pitch_deg;
        EXPECT_GT(found->from_seen_px, 0.0);
        EXPECT_LE(found->from_seen_px, behind_edges_px);
        EXPECT_FALSE(found->even);
    }
    EXPECT_GE(hidden, 3);
}

// Ground right behind the edge is given as what is hidden, too: 3 px below the wall's top, but not 100 px.
TEST(ViewSamples, GroundWellBehindAnEdgeIsNot) {
    const HeightField field = test::made_field(0.05, -0.05, 1200.0, 121, 601, [](double, double lon_deg) {
        const double away_m = lon_deg * 111319.49;
        return std::abs(away_m - 2000.0) < 100.0 ? 500.0F : 0.0F;
    });
    const TrueSurface surface(field, 1.0, thread_count());
    const Camera camera = eastward(12.0);
    const auto samples = view_samples(surface, sight_from(camera.eye), camera, thread_count());
    ASSERT_FALSE(samples.empty());
    for (const ViewSample& sample : samples) EXPECT_LT(sample.distance_m, 2500.0);
}

// From 20 km over a plane a pixel that looks 0.25 degrees down sees ground at 20 km / tan(0.25 deg) = 4,584
// km.
TEST(ViewSamples, APlaneHasNoHorizon) {
    const HeightField field = test::made_field(10.0, -5.0, 1.0, 21, 71, [](double, double) { return 0.0F; });
    const TrueSurface surface(field, 1.0, thread_count());
    Camera camera = eastward(-1.0);
    camera.eye.h_m = 20000.0;
    WorldModel plane;
    plane.earth = Earth::flat;
    double farthest_m = 0.0;
    for (const ViewSample& sample :
         view_samples(surface, sight_of(plane, camera.eye), camera, thread_count()))
        if (sample.from_seen_px == 0.0) farthest_m = std::max(farthest_m, sample.distance_m);
    EXPECT_GT(farthest_m, 4.5e6);
}

}  // namespace
}  // namespace oro

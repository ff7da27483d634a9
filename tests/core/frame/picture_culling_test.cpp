// Must hold: what a picture may show is not dropped, wherever in a pixel is sampled; what is behind the eye,
// beside the picture or beyond the horizon is.
#include "core/frame/picture_culling.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "core/frame/frame_plan.h"
#include "core/lod/levels_gpu.h"

namespace oro {
namespace {

FrameView some_view() {
    Camera camera;
    camera.eye = {46.5, 8.3, 3000.0};
    camera.attitude = {.heading_deg = 20.0, .pitch_deg = -6.0};
    camera.width_px = 640;
    camera.height_px = 360;
    return {camera, Tile{.width_px = 640, .height_px = 360}, 1.0};
}
// Never beyond a horizon.
PageBound unhidden_sphere(const glm::dvec3& centre_m, double radius_m) {
    return {Ecef{centre_m}, radius_m, {glm::normalize(centre_m), std::numbers::pi}};
}

TEST(PictureCulling, KeepsWhatAPictureShows) {
    const FrameView view = some_view();
    const PictureCulling culling(view, occluder_below(0.0, 0.0));
    constexpr unsigned seed = 17;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    int dropped = 0;
    for (int i = 0; i < 2000; ++i) {
        // Half a pixel beyond the picture's corners is still sampled.
        const glm::dvec2 at_px{-0.5 + 641.0 * share(random), -0.5 + 361.0 * share(random)};
        const double distance_m = 1.0 + 3.0e5 * share(random);
        const glm::dvec3 place = view.camera.eye_ecef().m + distance_m * view.camera.ecef_direction_at(at_px);
        dropped += culling.may_show(unhidden_sphere(place, 0.0)) ? 0 : 1;
    }
    EXPECT_EQ(dropped, 0) << "seed " << seed;
}

TEST(PictureCulling, DropsWhatIsBesideAPictureAndBeyondTheHorizon) {
    const FrameView view = some_view();
    const HorizonOccluder occluder = occluder_below(0.0, 0.0);
    const PictureCulling culling(view, occluder);
    const glm::dvec3 eye = view.camera.eye_ecef().m;
    const glm::dvec3 ahead = view.camera.ecef_direction_at({320.0, 180.0});
    EXPECT_TRUE(culling.may_show(unhidden_sphere(eye + 1.0e4 * ahead, 10.0)));
    EXPECT_FALSE(culling.may_show(unhidden_sphere(eye - 1.0e4 * ahead, 10.0)));
    EXPECT_FALSE(
        culling.may_show(unhidden_sphere(eye + 1.0e4 * view.camera.ecef_direction_at({700.0, 180.0}), 10.0)));
    // A degree of latitude is 111 km; from 3,000 m the horizon is 196 km away.
    const auto at_sea = [&](double lat_deg) {
        const glm::dvec3 place = ecef_from_geodetic({lat_deg, 8.3 + 0.55 * (lat_deg - 46.5), 0.0}).m;
        return PageBound{Ecef{place}, 10.0, {glm::normalize(occluder.scaled(Ecef{place})), 0.0}};
    };
    EXPECT_TRUE(culling.may_show(at_sea(47.5)));
    EXPECT_FALSE(culling.may_show(at_sea(50.0)));
}

// An error of a metre across the line of sight at 1 km: 360 px / (2 tan 22.5 deg) / 1000 = 0.43 px.
TEST(PictureCulling, KeepsTauWhereErrorsAreSmallOnTheScreen) {
    const FrameView view = some_view();
    const PictureCulling culling(view, occluder_below(0.0, 0.0));
    const glm::dvec3 place =
        view.camera.eye_ecef().m + 1000.0 * view.camera.ecef_direction_at({320.0, 180.0});
    EXPECT_TRUE(culling.keeps_tau(unhidden_sphere(place, 1.0), 1.0));
    EXPECT_TRUE(culling.keeps_tau(unhidden_sphere(place, 1.0), 2.2));
    EXPECT_FALSE(culling.keeps_tau(unhidden_sphere(place, 1.0), 2.35));
    EXPECT_FALSE(culling.keeps_tau(unhidden_sphere(place, 600.0), 2.2));
}

// As above, at the farthest place of the sphere: 0.99 x 434.6 px x 2.4 / 1001 = 1.03 px, and 0.65 px at 1.6
// km.
TEST(PictureCulling, FailsTauWhereErrorsAreLargeOnTheScreen) {
    const FrameView view = some_view();
    const PictureCulling culling(view, occluder_below(0.0, 0.0));
    const glm::dvec3 place =
        view.camera.eye_ecef().m + 1000.0 * view.camera.ecef_direction_at({320.0, 180.0});
    EXPECT_TRUE(culling.fails_tau(unhidden_sphere(place, 1.0), 2.4));
    EXPECT_FALSE(culling.fails_tau(unhidden_sphere(place, 1.0), 2.25));
    EXPECT_FALSE(culling.fails_tau(unhidden_sphere(place, 600.0), 2.4));
    EXPECT_TRUE(culling.fails_tau(unhidden_sphere(place, 600.0), 3.9));
}

// What fails it does not keep it as the GPU asks, wherever in the sphere a node is and however large it is.
TEST(PictureCulling, FailsTauOnlyWhereTheGpuDoesNotKeepIt) {
    const FrameView view = some_view();
    const PictureCulling culling(view, occluder_below(0.0, 0.0));
    const LevelView level = level_view(view.camera, view.tau_px);
    const glm::dmat3 view_from_ecef = view.camera.view_from_ecef();
    constexpr unsigned seed = 19;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    int failing = 0, kept = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 at_px{640.0 * share(random), 360.0 * share(random)};
        const glm::dvec3 middle = (1.0e3 + 1.0e5 * share(random)) * view.camera.ecef_direction_at(at_px);
        const double radius_m = 2.0e4 * share(random) * share(random), error_m = 500.0 * share(random);
        if (!culling.fails_tau(unhidden_sphere(view.camera.eye_ecef().m + middle, radius_m), error_m))
            continue;
        ++failing;
        const glm::dvec3 way{share(random) - 0.5, share(random) - 0.5, share(random) - 0.5};
        const glm::dvec3 node = view_from_ecef * (middle + radius_m * glm::normalize(way));
        const double node_radius_m = 2.0e4 * share(random);
        kept += gpu::projected_error_px(gpu::vec3(node), static_cast<float>(node_radius_m),
                                        static_cast<float>(error_m), level.pixels_per_tangent,
                                        level.corner_tangent) <= level.tau_px
                    ? 1
                    : 0;
    }
    EXPECT_EQ(kept, 0) << "seed " << seed;
    EXPECT_GT(failing, 500) << "seed " << seed;
}

}  // namespace
}  // namespace oro

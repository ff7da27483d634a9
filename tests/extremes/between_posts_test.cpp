// What the surface between posts misses of ground whose rule is known, beside what plan estimates of it.
#include <cmath>

#include "core/earth/ellipsoid.h"
#include "core/made/made_heights.h"
#include "tests/core/effects/effect_scene.h"
#include "tests/extremes/accuracy_table.h"
#include "tests/support/made_posts.h"
#include "tests/support/made_terrain.h"

#include <gtest/gtest.h>

namespace oro::test {
namespace {

constexpr const char* spacing_table = "Surfaces and spacing";

// Half a degree of the same ground at any spacing; its smallest cells are 2.7 m wide.
MadeTerrain mountains(std::int64_t posts_per_deg) {
    MadeTerrain made;
    made.seed = 7;
    made.octaves = 14;
    made.low = -200 * 2048;
    made.high = 4000 * 2048;
    made.posts_per_deg = posts_per_deg;
    made.west = 8 * posts_per_deg;
    made.east = made.west + posts_per_deg / 2;
    made.south = 46 * posts_per_deg;
    made.north = made.south + posts_per_deg / 2;
    return made;
}

HeightField field_of(const MadeTerrain& made) {
    const std::vector<std::int32_t> steps = heights_of(made);
    std::size_t post = 0;
    const auto per_deg = static_cast<double>(made.posts_per_deg);
    return made_field(static_cast<double>(made.north) / per_deg, static_cast<double>(made.west) / per_deg,
                      per_deg, made.rows(), made.columns(),
                      [&](double, double) { return static_cast<float>(steps[post++] * made_step_m); });
}

void measure_between(std::int64_t posts_per_deg, const char* spacing) {
    const MadeTerrain made = mountains(posts_per_deg);
    const gpu::MadeRule rule = made_rule(made);
    Camera camera;
    camera.eye = {46.1, 8.25, made_height_m(made, rule, 46.1, 8.25) + 1000.0};
    camera.attitude = {0.0, -8.0, 0.0};
    camera.vertical_fov_deg = 45.0;
    camera.width_px = 1920;
    camera.height_px = 1080;
    const EffectScene scene(field_of(made), camera);
    const EffectSize found = scene.prediction.found_off_by([&](const ViewSample& sample) {
        return std::abs(sample.point.h_m -
                        made_height_m(made, rule, sample.point.lat_deg, sample.point.lon_deg));
    });
    const EffectSize estimate = scene.prediction.interpolation_estimate(1);
    const std::string name = std::string("ground between posts ") + spacing + " apart";
    const auto places = static_cast<std::uint64_t>(scene.prediction.sight_lines());
    std::printf("%s: worst %.3f m, estimate %.3f m; typical %.4f m, estimate %.4f m\n", name.c_str(),
                found.worst_m, estimate.worst_m, found.typical_m, estimate.typical_m);
    measured(spacing_table, name, found.worst_m, places);
    measured(spacing_table, name + ", median", found.typical_m, places);
    measured(spacing_table, name + ", plan's estimate", estimate.worst_m / found.worst_m, places);
    measured(spacing_table, name + ", plan's typical one", estimate.typical_m / found.typical_m, places);
}

TEST(ExtremeBetweenPosts, OneSecond) {
    measure_between(3600, "1 second");
}
TEST(ExtremeBetweenPosts, ThreeSeconds) {
    measure_between(1200, "3 seconds");
}
TEST(ExtremeBetweenPosts, ThirtySeconds) {
    measure_between(120, "30 seconds");
}

}  // namespace
}  // namespace oro::test

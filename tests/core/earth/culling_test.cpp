// Horizon and frustum culling against brute force, by the path of a frame: plan_grid's floats, the meshlets'
// bounds of build_page, the tests of shaders/choose/select.glsl.
#include "core/earth/culling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "core/frame/frame_plan.h"
#include "core/terrain/page.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

constexpr double lowest_terrain_m = -430.0;
constexpr double highest_terrain_m = 8800.0;
constexpr double lowest_eye_m = -400.0;
constexpr double farthest_eye_m = 4.0e8;

// Is a point behind the unit sphere, seen from the eye? (Scaled space.) The nearest place of the segment to
// the centre decides.
bool behind_unit_sphere(const glm::dvec3& eye, const glm::dvec3& point) {
    const glm::dvec3 step = point - eye;
    const double t = std::clamp(-glm::dot(eye, step) / glm::dot(step, step), 0.0, 1.0);
    return glm::length(eye + t * step) < 1.0 - 1.0e-12;
}

// A region of one page that is known already.
class OnePage : public RegionPages {
  public:
    OnePage(const PostGrid& grid, const RegionShape& shape, const PageSummary& page)
        : RegionPages({grid, {}, shape, 0}), record_{page, page.radius_m, page.horizon, {}} {}

    [[nodiscard]] Result<PageRecord> record(const PageIndex&) const override { return PageRecord(record_); }
    Result<void> load(const PageIndex&, gpu::PageBlock&) const override {
        return Error{ErrorKind::failed, "test", "blocks are not kept"};
    }

  private:
    PageRecord record_;
};

// A page of random terrain somewhere on the Earth, and all of its posts.
struct Place {
    RegionShape shape;
    PageSummary summary;
    gpu::PageBlock block;
    std::unique_ptr<OnePage> pages;
    std::vector<glm::dvec3> ecef_m;  // 129 x 129

    const glm::dvec3& post(int meshlet, int i) const {
        const int row = meshlet / 16 * 8 + i / 9;
        const int column = meshlet % 16 * 8 + i % 9;
        return ecef_m[static_cast<std::size_t>(row * 129 + column)];
    }
};

std::unique_ptr<Place> random_place(std::mt19937_64& random, const HorizonOccluder* other_occluder) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double spacings[] = {3600.0, 1200.0, 1200.0, 120.0, 4.0};
    const double per_deg = spacings[random() % 5];
    const double page_deg = 128.0 / per_deg;
    const double north_deg = 90.0 - unit(random) * (180.0 - page_deg);
    const double west_deg = -180.0 + 360.0 * unit(random);
    // A third lies as deep as can be, the others anywhere, with relief from none to all of it.
    const double relief_m = (highest_terrain_m - lowest_terrain_m) * std::pow(unit(random), 3.0);
    const double room_m = highest_terrain_m - lowest_terrain_m - relief_m;
    const double base_m = lowest_terrain_m + (random() % 3 == 0 ? 0.0 : room_m * unit(random));
    const HeightField field =
        test::world_field(per_deg, static_cast<std::int64_t>(north_deg * per_deg),
                          static_cast<std::int64_t>(west_deg * per_deg), 129, 129,
                          [&](double, double) { return base_m + relief_m * unit(random); });
    auto place = std::make_unique<Place>();
    place->shape = region_shape(field, 1.0);
    if (other_occluder) place->shape.occluder = *other_occluder;
    place->summary = build_page(field, place->shape, {0, 0}, place->block);
    for (int row = 0; row < 129; ++row) {
        for (int column = 0; column < 129; ++column)
            place->ecef_m.push_back(post_ecef(field, row, column, 1.0).m);
    }
    if (other_occluder) place->shape = region_shape(field, 1.0);  // what truly hides
    place->pages = std::make_unique<OnePage>(field.grid, place->shape, place->summary);
    return place;
}

// An eye whose distance from the meshlet is mostly near that at which it disappears, and sometimes anything.
Ecef random_eye(std::mt19937_64& random, const Place& place, int meshlet) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> normal;
    const double h_m =
        lowest_eye_m + std::pow(10.0, unit(random) * std::log10(farthest_eye_m - lowest_eye_m));
    const glm::dvec3 radii = place.shape.occluder.radii_m;
    const double distance = 1.0 + (h_m + (wgs84_a_m - radii.x)) / wgs84_a_m;
    const glm::dvec3 post = place.post(meshlet, 40) / radii;
    const double r = glm::length(post);
    const double hidden_rad = std::acos(std::min(1.0, 1.0 / distance)) + std::acos(1.0 / r);
    const glm::dvec3 any = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 sideways = glm::normalize(any - post * (glm::dot(any, post) / (r * r)));
    const double wobbles[] = {1.0e-5, 1.0e-4, 1.0e-3, 1.0e-2};
    const double turn_rad = random() % 5 == 0 ? std::numbers::pi * unit(random)
                                              : hidden_rad + wobbles[random() % 4] * (0.5 + normal(random));
    return Ecef{radii * distance * (std::cos(turn_rad) * post / r + std::sin(turn_rad) * sideways)};
}

// A camera there whose picture has the target in its centre.
Camera aimed_camera(const Ecef& eye, const glm::dvec3& target_m) {
    Camera camera;
    camera.eye = geodetic_from_ecef(eye);
    camera.width_px = 1920;
    camera.height_px = 1080;
    const glm::dvec3 offset = target_m - eye.m;
    camera.attitude = attitude_of_direction(camera.eye, offset / glm::length(offset));
    return camera;
}

// The same, looking past it by about its field of view, or anywhere.
Camera wandering_camera(std::mt19937_64& random, Camera camera) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    camera.vertical_fov_deg = 0.05 + 119.0 * std::pow(std::abs(unit(random)), 2.0);
    const double wander_deg = random() % 8 == 0 ? 180.0 : camera.vertical_fov_deg;
    camera.attitude.heading_deg += wander_deg * unit(random);
    camera.attitude.pitch_deg =
        std::clamp(camera.attitude.pitch_deg + wander_deg * unit(random), -90.0, 90.0);
    camera.attitude.roll_deg = 180.0 * unit(random);
    return camera;
}

// Where a point comes to lie in the whole picture; nothing behind the eye.
std::optional<glm::dvec2> picture_point_px(const Camera& camera, const glm::dvec3& point_m) {
    const glm::dvec3 view = camera.view_from_ecef() * (point_m - camera.eye_ecef().m);
    if (view.z > -near_plane_m) return std::nullopt;
    const glm::dvec2 ndc = glm::dvec2(view.x, -view.y) / (-view.z * camera.half_fov_tangent());
    return (ndc + 1.0) * 0.5 * glm::dvec2(camera.width_px, camera.height_px);
}

// The whole picture, any tile, or one whose edge only just takes in (or leaves out) the outermost post of the
// meshlet.
Tile random_tile(std::mt19937_64& random, const Camera& camera, const Place& place, int meshlet) {
    const Tile picture{0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
    const auto choice = random() % 8;
    if (choice < 2) return picture;
    Tile tile{static_cast<int>(random() % 1000),
              static_cast<int>(random() % 500),
              1 + static_cast<int>(random() % 900),
              1 + static_cast<int>(random() % 500),
              {0.5, 0.5}};
    if (choice < 4) return tile;
    glm::dvec2 low(1.0e5);
    glm::dvec2 high(-1.0e5);
    for (int i = 0; i < 81; ++i) {
        const std::optional<glm::dvec2> point = picture_point_px(camera, place.post(meshlet, i));
        if (!point) return tile;
        low = glm::min(low, *point);
        high = glm::max(high, *point);
    }
    low = glm::max(glm::floor(low), -1.0e5);
    high = glm::min(glm::ceil(high), 1.0e5);
    const int left = static_cast<int>(low.x) - static_cast<int>(random() % 2);
    const int top = static_cast<int>(low.y) - static_cast<int>(random() % 2);
    const int right = static_cast<int>(high.x) + static_cast<int>(random() % 2);
    const int bottom = static_cast<int>(high.y) + static_cast<int>(random() % 2);
    const int width = std::max(1, right - left);
    const int height = std::max(1, bottom - top);
    if (choice == 4) return {right - 1, top, 500, height, {0.5, 0.5}};
    if (choice == 5) return {left - 499, top, 500, height, {0.5, 0.5}};
    if (choice == 6) return {left, bottom - 1, width, 500, {0.5, 0.5}};
    return {left, top - 499, width, 500, {0.5, 0.5}};
}

struct Tally {
    int meshlets{};
    int horizon_lost{};  // culled, and yet a post of it can be seen
    int horizon_hidden{};
    int horizon_kept{};  // hidden, and yet kept
    int frustum_lost{};
    int frustum_hidden{};
    int frustum_kept{};
};

// What a frame does to one meshlet.
struct CullResult {
    bool beyond_frustum;
    bool beyond_horizon;
};
CullResult cull_result_of(const Place& place, const Camera& camera, const Tile& tile, int meshlet) {
    const Result<GridPlan> plan =
        plan_grid(*place.pages, [](const PageIndex&) { return 1U; }, {camera, tile, 0.0});
    EXPECT_TRUE(plan.ok());
    if (plan->pages.empty()) return {plan->pages_beyond_frustum == 1, plan->pages_beyond_horizon == 1};
    const gpu::FramePage& page = plan->pages[0];
    const gpu::MeshletBounds& bounds = place.block.meshlets[meshlet];
    // As shaders/choose/cull_result.glsl.
    CullResult cull_result{false, false};
    for (const gpu::vec4& plane : page.planes) {
        const bool beyond = gpu::sphere_beyond_plane_cpu(bounds.centre, bounds.radius, plane);
        cull_result.beyond_frustum =
            cull_result.beyond_frustum || ((page.cull & gpu::cull_by_frustum) != 0 && beyond);
    }
    cull_result.beyond_horizon =
        (page.cull & gpu::cull_by_horizon) != 0 &&
        gpu::beyond_horizon_cpu(page.horizon_direction - bounds.horizon_offset,
                                plan->constants.horizon_angle_rad, bounds.horizon_angle_rad);
    return cull_result;
}

// Is any post of the meshlet not behind the occluder?
bool any_above_horizon(const Place& place, const Ecef& eye, int meshlet) {
    const glm::dvec3 eye_scaled = place.shape.occluder.scaled(eye);
    if (glm::length(eye_scaled) <= 1.0) return true;
    for (int i = 0; i < 81; ++i) {
        const glm::dvec3 post = place.shape.occluder.scaled(Ecef{place.post(meshlet, i)});
        if (!behind_unit_sphere(eye_scaled, post)) return true;
    }
    return false;
}

// Is any post of the meshlet in the picture's tile?
bool any_in_frustum(const Place& place, const Camera& camera, const Tile& tile, int meshlet) {
    const Ecef eye = camera.eye_ecef();
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const Projection projection = projection_of_tile(camera, tile);
    for (int i = 0; i < 81; ++i) {
        const glm::dvec3 view = view_from_ecef * (place.post(meshlet, i) - eye.m);
        const double w = -view.z;
        const glm::dvec2 clip = projection.scale * glm::dvec2(view) + projection.shift * w;
        if (w >= projection.near_m && std::abs(clip.x) <= w && std::abs(clip.y) <= w) return true;
    }
    return false;
}

void judge(const Place& place, std::mt19937_64& random, Tally& tally) {
    const int meshlet = static_cast<int>(random() % 256);
    const Ecef eye = random_eye(random, place, meshlet);
    const Camera aimed = aimed_camera(eye, place.post(meshlet, static_cast<int>(random() % 81)));
    const Tile picture{0, 0, aimed.width_px, aimed.height_px, {0.5, 0.5}};
    ++tally.meshlets;
    const CullResult aimed_cull_result = cull_result_of(place, aimed, picture, meshlet);
    const bool above_horizon = any_above_horizon(place, aimed.eye_ecef(), meshlet);
    tally.frustum_lost += aimed_cull_result.beyond_frustum ? 1 : 0;  // one post is in the picture's centre
    tally.horizon_lost += aimed_cull_result.beyond_horizon && above_horizon ? 1 : 0;
    tally.horizon_hidden += above_horizon ? 0 : 1;
    tally.horizon_kept += !above_horizon && !aimed_cull_result.beyond_horizon ? 1 : 0;

    const Camera wandering = wandering_camera(random, aimed);
    const Tile tile = random_tile(random, wandering, place, meshlet);
    const CullResult cull_result = cull_result_of(place, wandering, tile, meshlet);
    const bool in_frustum = any_in_frustum(place, wandering, tile, meshlet);
    tally.horizon_lost += cull_result.beyond_horizon && above_horizon ? 1 : 0;
    tally.frustum_lost += cull_result.beyond_frustum && in_frustum ? 1 : 0;
    // A page that the horizon hides is not asked for its place in the picture.
    if (cull_result.beyond_horizon) return;
    tally.frustum_hidden += in_frustum ? 0 : 1;
    tally.frustum_kept += !in_frustum && !cull_result.beyond_frustum ? 1 : 0;
}

Tally judge_many(unsigned seed, int places, int cameras_per_place,
                 const HorizonOccluder* other_occluder = nullptr) {
    std::mt19937_64 random(seed);
    Tally tally;
    for (int i = 0; i < places; ++i) {
        const std::unique_ptr<Place> place = random_place(random, other_occluder);
        for (int j = 0; j < cameras_per_place; ++j) judge(*place, random, tally);
    }
    return tally;
}

TEST(Culling, NoVisiblePostIsEverCulled) {
    const unsigned seed = 2024;
    const Tally tally = judge_many(seed, 500, 200);
    std::printf(
        "seed %u: %d random cameras and meshlets, eyes from %.0f m to %.0f km, terrain from %.0f m to %.0f "
        "m\n",
        seed, tally.meshlets, lowest_eye_m, farthest_eye_m / 1e3, lowest_terrain_m, highest_terrain_m);
    std::printf("horizon: %d hidden, of which kept %.2f %%; visible and culled: %d\n", tally.horizon_hidden,
                100.0 * tally.horizon_kept / tally.horizon_hidden, tally.horizon_lost);
    std::printf("frustum: %d hidden, of which kept %.2f %%; visible and culled: %d\n", tally.frustum_hidden,
                100.0 * tally.frustum_kept / tally.frustum_hidden, tally.frustum_lost);
    EXPECT_EQ(tally.meshlets, 100000);
    EXPECT_EQ(tally.horizon_lost, 0);
    EXPECT_EQ(tally.frustum_lost, 0);
    // The cases must be hard ones, and the tests of some use.
    EXPECT_GT(tally.horizon_hidden, 20000);
    EXPECT_LT(tally.horizon_kept, tally.horizon_hidden / 2);
    EXPECT_GT(tally.frustum_hidden, 20000);
    EXPECT_LT(tally.frustum_kept, tally.frustum_hidden / 2);
}

// The comparison can fail: an occluder that is not shrunk to the lowest terrain hides what can be seen.
TEST(Culling, WithTheEllipsoidItselfVisiblePostsAreLost) {
    const HorizonOccluder unshrunk = occluder_below(0.0, 0.0);
    const Tally tally = judge_many(2025, 100, 200, &unshrunk);
    std::printf("culled by WGS84 itself: %d visible of %d\n", tally.horizon_lost, tally.meshlets);
    EXPECT_GT(tally.horizon_lost, 0);
    EXPECT_EQ(tally.frustum_lost, 0);
}

// The chord decides what the angle would.
TEST(Horizon, IsBeyondByTheAngle) {
    constexpr unsigned seed = 5107;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0), both(-1.0, 1.0);
    int beyond = 0, seen = 0;
    for (int i = 0; i < 300'000; ++i) {
        const glm::dvec3 a = glm::normalize(glm::dvec3(both(random), both(random), both(random)));
        const glm::dvec3 aside =
            glm::normalize(glm::cross(a, glm::dvec3(both(random), both(random), both(random))));
        const double angle_rad = std::numbers::pi * std::pow(10.0, -8.0 * unit(random));
        const glm::dvec3 b = std::cos(angle_rad) * a + std::sin(angle_rad) * aside;
        // Mostly close to the limit.
        const double apart = i % 4 == 0 ? both(random) : both(random) * std::pow(10.0, -10.0 * unit(random));
        const double limit_rad = angle_rad * (1.0 + apart), share = unit(random);
        const HorizonEye eye{a, share * limit_rad};
        const HorizonCone cone{i % 5 == 0 ? 2.5 * b : b, (1.0 - share) * limit_rad};
        const double between_rad =
            std::atan2(glm::length(glm::cross(a, cone.direction)), glm::dot(a, cone.direction));
        const double reach_rad = eye.angle_rad + cone.angle_rad + 1.0e-11;
        const bool expected = reach_rad < std::numbers::pi && between_rad > reach_rad;
        ASSERT_EQ(beyond_horizon(eye, cone), expected) << "seed " << seed << ", case " << i;
        (expected ? beyond : seen) += 1;
    }
    EXPECT_GT(beyond, 10'000);
    EXPECT_GT(seen, 10'000);
}

TEST(Horizon, Literals) {
    // Unit sphere with the radii of the ellipsoid: an eye at twice the distance sees 60 degrees far.
    const HorizonOccluder occluder{glm::dvec3(1.0)};
    const HorizonEye eye = horizon_eye(occluder, Ecef{{2.0, 0.0, 0.0}});
    EXPECT_NEAR(eye.angle_rad, std::numbers::pi / 3.0, 1e-15);
    const auto point_at = [](double angle_deg, double r) {
        const SineCosine turn = sine_cosine_deg(angle_deg);
        return std::vector{glm::dvec3(r * turn.cosine, r * turn.sine, 0.0)};
    };
    EXPECT_FALSE(beyond_horizon(eye, horizon_cone(occluder, point_at(59.999, 1.0))));
    EXPECT_TRUE(beyond_horizon(eye, horizon_cone(occluder, point_at(60.001, 1.0))));
    // A point at the eye's own height is seen over another 60 degrees.
    EXPECT_FALSE(beyond_horizon(eye, horizon_cone(occluder, point_at(119.999, 2.0))));
    EXPECT_TRUE(beyond_horizon(eye, horizon_cone(occluder, point_at(120.001, 2.0))));
    // A cone around two points reaches as far as the one that is seen longest.
    const std::vector both{point_at(80.0, 1.0)[0], point_at(58.0, 1.0)[0]};
    EXPECT_NEAR(horizon_cone(occluder, both).angle_rad, 11.0 * std::numbers::pi / 180.0, 1e-15);
    EXPECT_FALSE(beyond_horizon(eye, horizon_cone(occluder, both)));
    // Nothing is hidden from within the occluder, and points just below its surface count as on it.
    EXPECT_EQ(horizon_eye(occluder, Ecef{{0.5, 0.0, 0.0}}).angle_rad, std::numbers::pi);
    EXPECT_EQ(horizon_eye(occluder, Ecef{{0.0, 0.0, 0.0}}).angle_rad, std::numbers::pi);
    EXPECT_EQ(horizon_cone(occluder, point_at(30.0, 1.0 - 1e-12)).angle_rad, 0.0);
    // Points all round: never hidden.
    const std::vector opposite{glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0)};
    EXPECT_EQ(horizon_cone(occluder, opposite).angle_rad, std::numbers::pi);
    EXPECT_FALSE(beyond_horizon(eye, horizon_cone(occluder, opposite)));
    EXPECT_FALSE(beyond_horizon(horizon_eye(occluder, Ecef{{0.5, 0.0, 0.0}}),
                                horizon_cone(occluder, point_at(180, 1.0))));
}

TEST(Horizon, DoesNotHideTheGroundUnderAnEyeThatStandsOnIt) {
    const HorizonOccluder occluder = occluder_below(0.0, 0.0);
    const glm::dvec3 ground = ecef_from_geodetic({46.0, 8.0, 0.0}).m;
    const HorizonEye eye = horizon_eye(occluder, ecef_from_geodetic({46.0, 8.0, 2.0}));
    // 2 m above the sea the horizon is 5.0 km away. Source: sqrt(2 R h).
    EXPECT_NEAR(eye.angle_rad * 6.37e6, 5.05e3, 60.0);
    EXPECT_FALSE(beyond_horizon(eye, horizon_cone(occluder, std::vector{ground})));
    const glm::dvec3 near = ecef_from_geodetic({46.04, 8.0, 0.0}).m;
    const glm::dvec3 far = ecef_from_geodetic({46.06, 8.0, 0.0}).m;
    EXPECT_FALSE(beyond_horizon(eye, horizon_cone(occluder, std::vector{near})));
    EXPECT_TRUE(beyond_horizon(eye, horizon_cone(occluder, std::vector{far})));
}

TEST(Frustum, Literals) {
    const std::vector<Plane> planes{{1.0, 0.0, 0.0, -5.0}, {0.0, 1.0, 0.0, 0.0}};
    EXPECT_FALSE(beyond_frustum(planes, {6.0, 1.0, 0.0}, 0.5));
    EXPECT_FALSE(beyond_frustum(planes, {4.6, 1.0, 0.0}, 0.5));
    EXPECT_TRUE(beyond_frustum(planes, {4.4, 1.0, 0.0}, 0.5));
    EXPECT_TRUE(beyond_frustum(planes, {9.0, -0.6, 0.0}, 0.5));
    EXPECT_TRUE(gpu::sphere_beyond_plane_cpu({4.4F, 1.0F, 0.0F}, 0.5F, gpu::vec4(planes[0])));
    EXPECT_FALSE(gpu::sphere_beyond_plane_cpu({4.6F, 1.0F, 0.0F}, 0.5F, gpu::vec4(planes[0])));
    EXPECT_FALSE(beyond_frustum({}, {0.0, 0.0, 0.0}, 0.0));
}

}  // namespace
}  // namespace oro

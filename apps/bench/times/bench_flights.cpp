#include "apps/bench/times/bench_flights.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "apps/bench/times/bench_ground.h"
#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

constexpr double lowest_m = 2.0, highest_m = 20'000.0, most_climb = 2.0;
constexpr double steepest_deg = 30.0, most_turn_deg_s = 20.0, turn_back_deg_s = 60.0;
constexpr double rim_share = 0.05;     // of a side: nearer to the rim an eye turns back
constexpr double ground_share = 0.05;  // of what the ground under the eye has changed, a frame
constexpr double degrees = 180.0 / std::numbers::pi;

struct FlightCourse {
    double above_m, climb;  // at its begin; what that is multiplied by until its end
    double heading_deg, turn_deg_s, below_horizon_deg;
};

// How far to the right a heading has to turn to become another, -180 to 180.
double turn_deg(double from_deg, double to_deg) {
    return std::remainder(to_deg - from_deg, 360.0);
}

// An eye's heading a frame later.
double turned_deg(const PostGrid& grid, const Camera& camera, const FlightCourse& course) {
    const double heading_deg = camera.attitude.heading_deg;
    const double north = (camera.eye.lat_deg - grid.south_deg()) / (grid.north_deg() - grid.south_deg());
    const double east = (camera.eye.lon_deg - grid.west_deg()) / (grid.east_deg() - grid.west_deg());
    const bool inside = std::min({north, 1.0 - north, east, 1.0 - east}) > rim_share;
    if (inside) return std::fmod(heading_deg + course.turn_deg_s * flight_step_s + 360.0, 360.0);
    const double most_deg = turn_back_deg_s * flight_step_s;
    const double to_middle_deg = std::atan2(0.5 - east, 0.5 - north) * degrees;
    return std::fmod(
        heading_deg + std::clamp(turn_deg(heading_deg, to_middle_deg), -most_deg, most_deg) + 360.0, 360.0);
}

// Moves an eye ahead by what it flies in a frame; within the region.
void move_on(const PostGrid& grid, double above_m, Camera& camera) {
    const double way_m = random_flight_speed_m_s(above_m) * flight_step_s;
    const double heading_rad = camera.attitude.heading_deg / degrees;
    Geodetic& eye = camera.eye;
    eye.lon_deg += way_m * std::sin(heading_rad) * degrees /
                   (prime_vertical_radius_m(eye.lat_deg) * std::cos(eye.lat_deg / degrees));
    eye.lat_deg += way_m * std::cos(heading_rad) * degrees / meridian_radius_m(eye.lat_deg);
    eye.lat_deg = std::clamp(eye.lat_deg, grid.south_deg(), grid.north_deg());
    eye.lon_deg = std::clamp(eye.lon_deg, grid.west_deg(), grid.east_deg());
}

Result<std::vector<Camera>> cameras_of(const PostGrid& grid, GroundBelow& ground, Camera camera,
                                       const FlightCourse& course, int frames) {
    std::vector<Camera> cameras;
    ORO_TRY(double base_m, ground.h_m(camera.eye.lat_deg, camera.eye.lon_deg));
    for (int i = 0; i < frames; ++i) {
        const double above_m = std::clamp(
            course.above_m * std::pow(course.climb, static_cast<double>(i) / frames), lowest_m, highest_m);
        if (i > 0) {
            camera.attitude.heading_deg = turned_deg(grid, camera, course);
            move_on(grid, above_m, camera);
        }
        ORO_TRY(const double ground_m, ground.h_m(camera.eye.lat_deg, camera.eye.lon_deg));
        base_m += ground_share * (ground_m - base_m);
        camera.eye.h_m = std::max(ground_m + lowest_m, base_m + above_m);
        const double dip_deg = std::acos(std::min(1.0, wgs84_a_m / (wgs84_a_m + above_m))) * degrees;
        camera.attitude.pitch_deg = -dip_deg - course.below_horizon_deg;
        cameras.push_back(camera);
    }
    return cameras;
}

}  // namespace

double random_flight_speed_m_s(double above_m) {
    return std::clamp(0.5 * above_m, 50.0, 5000.0);
}

Result<std::vector<RandomFlight>> random_flights(const RegionPages& pages, int count, int frames,
                                                 std::uint64_t seed, int width_px, int height_px) {
    const PostGrid& grid = pages.facts().grid;
    if (grid.net) return Error{ErrorKind::usage, "--moving", "is not for posts in a CRS of their own"};
    EvenNumbers random(seed);
    DrawnPosts posts(pages);
    GroundBelow ground(pages);
    std::vector<RandomFlight> flights;
    constexpr int most_voids = 100'000;
    for (int tries = 0; static_cast<int>(flights.size()) < count; ++tries) {
        if (tries > most_voids + count) return Error{ErrorKind::failed, "--moving", "finds no posts"};
        const int row = random.below(grid.rows()), column = random.below(grid.columns());
        ORO_TRY(const double ground_m, posts.h_m(row, column));
        if (ground_m == static_cast<double>(void_height_m)) continue;
        FlightCourse course{};
        course.above_m = std::exp(random.between(std::log(lowest_m), std::log(highest_m)));
        course.climb = std::exp(random.between(-std::log(most_climb), std::log(most_climb)));
        course.heading_deg = random.between(0.0, 360.0);
        course.turn_deg_s = random.between(-most_turn_deg_s, most_turn_deg_s);
        course.below_horizon_deg = random.between(0.0, steepest_deg);
        Camera camera;
        camera.width_px = width_px;
        camera.height_px = height_px;
        camera.vertical_fov_deg = 45.0;
        camera.eye = {grid.lat.at_deg(row), grid.lon.at_deg(column), ground_m + course.above_m};
        camera.attitude = {course.heading_deg, 0.0, 0.0};
        char name[128];
        std::snprintf(name, sizeof(name), "from %.4f %.4f, %.0f to %.0f m above ground", camera.eye.lat_deg,
                      camera.eye.lon_deg, course.above_m, course.above_m * course.climb);
        ORO_TRY(std::vector<Camera> cameras, cameras_of(grid, ground, camera, course, frames));
        flights.push_back({name, std::move(cameras)});
    }
    return flights;
}

}  // namespace oro

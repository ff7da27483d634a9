#include "core/truth/view_set.h"

#include <cmath>

#include "core/base/parallel.h"
#include "core/terrain/ground.h"
#include "core/truth/oracle.h"

namespace oro {
namespace {

// Share of a picture that is ground, from a few sight lines.
double ground_share(const TrueGround& ground, const Camera& camera) {
    constexpr int across = 8, down = 6;
    const Oracle oracle(ground, sight_from(camera.eye));
    int hits = 0;
    for (int i = 0; i < across * down; ++i) {
        const glm::dvec2 point_px((i % across + 0.5) / across * camera.width_px,
                                  (i / across + 0.5) / down * camera.height_px);
        if (oracle.first_hit(camera.ecef_direction_at(point_px), sight_reach_m(camera.eye.h_m))) ++hits;
    }
    return static_cast<double>(hits) / (across * down);
}

// ground_at_m(place): what the eye stands over.
template <typename GroundAt>
Camera camera_over(std::mt19937_64& random, const PostGrid& grid, int width_px, int height_px,
                   const GroundAt& ground_at_m) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.vertical_fov_deg = 10.0 + 80.0 * unit(random);
    camera.eye.lat_deg =
        grid.south_deg() + (0.02 + 0.96 * unit(random)) * (grid.north_deg() - grid.south_deg());
    camera.eye.lon_deg = grid.west_deg() + (0.02 + 0.96 * unit(random)) * (grid.east_deg() - grid.west_deg());
    const double above_m = 2.0 * std::pow(2.5e5, unit(random));
    camera.eye.h_m = ground_at_m(camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0) + above_m;
    const bool level = above_m < 5000.0 && random() % 2 == 0;
    camera.attitude.heading_deg = 360.0 * unit(random);
    camera.attitude.pitch_deg = level ? -25.0 + 30.0 * unit(random) : -89.0 + 64.0 * unit(random);
    camera.attitude.roll_deg = random() % 3 == 0 ? 360.0 * unit(random) - 180.0 : 0.0;
    return camera;
}

}  // namespace

Camera made_camera(std::mt19937_64& random, const HeightField& field, int width_px, int height_px,
                   double exaggeration) {
    return camera_over(random, field.grid, width_px, height_px, [&](double lat_deg, double lon_deg) {
        return ground_h_m(field, lat_deg, lon_deg, exaggeration);
    });
}

std::vector<Camera> made_cameras(std::uint64_t seed, const HeightField& field, int count, int width_px,
                                 int height_px, double exaggeration) {
    return made_cameras(seed, TrueSurface(field, exaggeration, thread_count()), count, width_px, height_px);
}

std::vector<Camera> made_cameras(std::uint64_t seed, const TrueGround& ground, int count, int width_px,
                                 int height_px) {
    std::mt19937_64 random(seed);
    const auto make = [&] {
        const std::size_t grid = ground.grids() == 1 ? 0 : random() % ground.grids();
        const HeightField& field = ground.surface(grid).field();
        if (ground.grids() == 1)
            return made_camera(random, field, width_px, height_px, ground.exaggeration());
        return camera_over(random, field.grid, width_px, height_px,
                           [&](double lat_deg, double lon_deg) { return ground.h_m(lat_deg, lon_deg); });
    };
    std::vector<Camera> cameras;
    for (int i = 0; i < count; ++i) {
        Camera camera = make();
        for (int tries = 0; tries < 50 && ground_share(ground, camera) < 0.1; ++tries) camera = make();
        cameras.push_back(camera);
    }
    return cameras;
}

}  // namespace oro

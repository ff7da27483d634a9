#include "core/truth/view_set.h"

#include <cmath>

#include "core/base/parallel.h"
#include "core/terrain/ground.h"
#include "core/truth/oracle.h"

namespace oro {
namespace {

// Share of a picture that is ground, from a few sight lines.
double ground_share(const TrueSurface& surface, const Camera& camera) {
    constexpr int across = 8, down = 6;
    const Oracle oracle(surface, sight_from(camera.eye));
    int hits = 0;
    for (int i = 0; i < across * down; ++i) {
        const glm::dvec2 point_px((i % across + 0.5) / across * camera.width_px,
                                  (i / across + 0.5) / down * camera.height_px);
        if (oracle.first_hit(camera.ecef_direction_at(point_px), sight_reach_m(camera.eye.h_m))) ++hits;
    }
    return static_cast<double>(hits) / (across * down);
}

}  // namespace

Camera made_camera(std::mt19937_64& random, const HeightField& field, int width_px, int height_px,
                   double exaggeration) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const PostGrid& grid = field.grid;
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.vertical_fov_deg = 10.0 + 80.0 * unit(random);
    camera.eye.lat_deg =
        grid.south_deg() + (0.02 + 0.96 * unit(random)) * (grid.north_deg() - grid.south_deg());
    camera.eye.lon_deg = grid.west_deg() + (0.02 + 0.96 * unit(random)) * (grid.east_deg() - grid.west_deg());
    const double above_m = 2.0 * std::pow(2.5e5, unit(random));
    camera.eye.h_m =
        ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg, exaggeration).value_or(0.0) + above_m;
    const bool level = above_m < 5000.0 && random() % 2 == 0;
    camera.attitude.heading_deg = 360.0 * unit(random);
    camera.attitude.pitch_deg = level ? -25.0 + 30.0 * unit(random) : -89.0 + 64.0 * unit(random);
    camera.attitude.roll_deg = random() % 3 == 0 ? 360.0 * unit(random) - 180.0 : 0.0;
    return camera;
}

std::vector<Camera> made_cameras(std::uint64_t seed, const HeightField& field, int count, int width_px,
                                 int height_px, double exaggeration) {
    std::mt19937_64 random(seed);
    const TrueSurface surface(field, exaggeration, thread_count());
    std::vector<Camera> cameras;
    for (int i = 0; i < count; ++i) {
        Camera camera = made_camera(random, field, width_px, height_px, exaggeration);
        for (int tries = 0; tries < 50 && ground_share(surface, camera) < 0.1; ++tries)
            camera = made_camera(random, field, width_px, height_px, exaggeration);
        cameras.push_back(camera);
    }
    return cameras;
}

}  // namespace oro

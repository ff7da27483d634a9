// Random eyes over a region, and background that shines through it.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "core/earth/camera.h"
#include "core/terrain/ground.h"
#include "core/terrain/post_grid.h"

namespace oro::test {

inline constexpr int crack_side_px = 96;  // of the pictures

// An eye over the region, from 2 m above the ground to 500 km; all headings, from straight down to the sky.
inline Camera random_camera(std::mt19937_64& random, const HeightField& field) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Camera camera;
    camera.width_px = camera.height_px = crack_side_px;
    camera.vertical_fov_deg = 10.0 + 80.0 * unit(random);
    const PostGrid& grid = field.grid;
    camera.eye.lat_deg =
        grid.south_deg() + (0.02 + 0.96 * unit(random)) * (grid.north_deg() - grid.south_deg());
    camera.eye.lon_deg = grid.west_deg() + (0.02 + 0.96 * unit(random)) * (grid.east_deg() - grid.west_deg());
    if (grid.net) {
        // Its box has corners that are not over it.
        const double row = (0.02 + 0.96 * unit(random)) * (grid.rows() - 1);
        const PostPlace over = grid.place_at(row, (0.02 + 0.96 * unit(random)) * (grid.columns() - 1));
        camera.eye.lat_deg = over.lat_deg;
        camera.eye.lon_deg = over.lon_deg;
    }
    const auto ground_m = ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg);
    // What is drawn may be as much coarser as its distance allows: an eye close to the ground has it exact.
    camera.eye.h_m = ground_m.value_or(0.0) + 2.0 * std::pow(2.5e5, unit(random));
    const bool low = random() % 2 == 0;
    camera.attitude = {360.0 * unit(random), low ? -25.0 + 30.0 * unit(random) : -90.0 + 80.0 * unit(random),
                       random() % 3 == 0 ? 360.0 * unit(random) : 0.0};
    return camera;
}

// Below an eye over the region, whatever is lower than ground along the same azimuth is ground, too: towards
// the zenith from a background pixel there can be no ground. Such a pixel, or -1. Ground is told by a 3 x 3
// of its pixels.
inline int pixel_of_a_hole(const Camera& camera, const std::vector<std::uint32_t>& ids) {
    const glm::dvec3 up = camera.view_from_ecef() * ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)[2];
    const glm::dvec2 tangent = camera.half_fov_tangent();
    const int width_px = camera.width_px, height_px = camera.height_px;
    const auto is_ground = [&](int x, int y) {
        if (x < 1 || y < 1 || x > width_px - 2 || y > height_px - 2) return false;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (ids[static_cast<std::size_t>((y + dy) * width_px + x + dx)] == 0) return false;
            }
        }
        return true;
    };
    for (int at = 0; at < width_px * height_px; ++at) {
        if (ids[static_cast<std::size_t>(at)] != 0) continue;
        const glm::dvec2 pixel(at % width_px + 0.5, at / width_px + 0.5);
        const glm::dvec3 ray((2.0 * pixel.x / width_px - 1.0) * tangent.x,
                             (1.0 - 2.0 * pixel.y / height_px) * tangent.y, -1.0);
        // The picture's movement when the ray turns towards the zenith.
        const glm::dvec3 turn = up - ray * (glm::dot(up, ray) / glm::dot(ray, ray));
        const glm::dvec2 step(turn.x + ray.x * turn.z, -(turn.y + ray.y * turn.z));
        const double length = glm::length(step);
        if (length < 1e-9) continue;
        for (double distance_px = 3.0; distance_px <= 12.0; distance_px += 1.0) {
            const glm::dvec2 there = pixel + step * (distance_px / length);
            if (is_ground(static_cast<int>(std::floor(there.x)), static_cast<int>(std::floor(there.y))))
                return at;
        }
    }
    return -1;
}

}  // namespace oro::test

// Regions with their pyramids, and eyes to look at them from.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/earth/camera.h"
#include "core/lod/pyramid.h"
#include "tests/core/truth/drawn_surface.h"
#include "tests/support/rough_terrain.h"

namespace oro::test {

// A region with all that is needed to check pictures of it.
struct Region {
    HeightField field;
    DrawnHeights heights;
    LevelPyramid pyramid;
    LevelPyramid unhidden;  // nothing of it is ever beyond the frustum or the horizon
    std::vector<glm::dvec3> posts_ecef_m;

    explicit Region(HeightField of) : field(std::move(of)), heights(drawn_heights(field, 1.0, 2)) {
        pyramid = build_pyramid(field, region_shape(field, 1.0), 2);
        unhidden = pyramid;
        for (PyramidLevel& level : unhidden.levels) {
            for (PyramidPage& page : level.pages) {
                page.reach_m = 1.0e12;
                page.horizon.angle_rad = std::numbers::pi;
            }
        }
        for (int row = 0; row < heights.rows; ++row) {
            for (int column = 0; column < heights.columns; ++column) {
                const bool is_there = heights.at(row, column) != void_height_steps;
                posts_ecef_m.push_back(is_there ? post_ecef(field, row, column, 1.0).m : glm::dvec3(0.0));
            }
        }
    }
    [[nodiscard]] const LevelGrid& grid(int level) const {
        return pyramid.levels[static_cast<std::size_t>(level)].grid;
    }
    [[nodiscard]] const glm::dvec3& ecef_m(const RegionPost& post) const {
        return posts_ecef_m[static_cast<std::size_t>(post.row) * static_cast<std::size_t>(heights.columns) +
                            static_cast<std::size_t>(post.column)];
    }
};

// Ground that is rough in places and smooth in others, so that levels meet everywhere.
inline HeightField patchy_field(int rows, int columns) {
    HeightField field = rough_field(47.0, 8.0, rows, columns);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double calm = 0.5 + 0.5 * std::sin(row * 0.02) * std::cos(column * 0.017);
            float& H_m = field.H_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                   static_cast<std::size_t>(column)];
            H_m = static_cast<float>(500.0 + static_cast<double>(H_m) * std::pow(calm, 4.0));
        }
    }
    return field;
}

// Anywhere from 2 m above the ground to 500 km up, in and around the region, looking anywhere; mostly at it.
inline Camera random_camera(std::mt19937_64& random, const Region& region) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const PostGrid& grid = region.field.grid;
    Camera camera;
    const double h_m = 2.0 * std::pow(2.5e5, unit(random));
    const double offset_deg = random() % 3 == 0 ? 0.3 + 1.0e-5 * h_m : 0.0;
    const double row = unit(random) * (grid.rows() - 1);
    const double column = unit(random) * (grid.columns() - 1);
    const PostPlace over = grid.place_at(row, column);
    camera.eye.lat_deg = over.lat_deg + offset_deg * (2.0 * unit(random) - 1.0);
    camera.eye.lon_deg = over.lon_deg + offset_deg * (2.0 * unit(random) - 1.0);
    const std::int32_t ground = region.heights.at(static_cast<int>(row), static_cast<int>(column));
    camera.eye.h_m = h_m + (ground == void_height_steps ? 0.0 : ground * height_step_m);
    camera.vertical_fov_deg = 10.0 + 80.0 * unit(random);
    camera.width_px = 160 + static_cast<int>(random() % 1000);
    camera.height_px = 160 + static_cast<int>(random() % 1000);
    if (random() % 3 == 0) {
        camera.attitude = {360.0 * unit(random), -30.0 + 35.0 * unit(random), 0.0};  // grazing
    } else {
        const double target_row = unit(random) * (grid.rows() - 1);
        const PostPlace target = grid.place_at(target_row, unit(random) * (grid.columns() - 1));
        camera.attitude = attitude_towards(camera.eye, {target.lat_deg, target.lon_deg, 1000.0});
        camera.attitude.roll_deg = random() % 2 == 0 ? 0.0 : 360.0 * unit(random);
    }
    return camera;
}

inline Tile whole(const Camera& camera) {
    return {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
}

inline constexpr double taus_px[] = {0.5, 1.0, 4.0};

}  // namespace oro::test

// Terrain whose posts lie on a net by a formula: for tests that need no file and no PROJ.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include "core/terrain/post_grid.h"

namespace oro::test {

// Posts on a plane that touches the sphere of normals in the middle, so many metres apart there; rows turned
// from east, towards north. Exact both ways, also over a pole.
struct PlaneOfPosts {
    int rows{};
    int columns{};
    PostPlace middle{};
    double post_m{30.0};
    double turn_deg{};

    [[nodiscard]] PostPlace place_of(double row, double column) const {
        const glm::dmat3 enu = ecef_from_enu(middle.lat_deg, middle.lon_deg);
        const double along = (column - 0.5 * (columns - 1)) * post_m / mean_m,
                     back = (0.5 * (rows - 1) - row) * post_m / mean_m;
        const double turn = radians_from_deg(turn_deg).rad;
        const double east = along * std::cos(turn) - back * std::sin(turn),
                     north = along * std::sin(turn) + back * std::cos(turn);
        const glm::dvec3 normal = glm::normalize(enu[2] + east * enu[0] + north * enu[1]);
        return place_of_normal(normal);
    }
    [[nodiscard]] PostNumber post_of(double lat_deg, double lon_deg) const {
        const glm::dmat3 enu = ecef_from_enu(middle.lat_deg, middle.lon_deg);
        const glm::dvec3 normal = ecef_from_enu(lat_deg, lon_deg)[2];
        const double up = glm::dot(normal, enu[2]);
        const double east = glm::dot(normal, enu[0]) / up, north = glm::dot(normal, enu[1]) / up;
        const double turn = radians_from_deg(turn_deg).rad;
        const double along = east * std::cos(turn) + north * std::sin(turn),
                     back = north * std::cos(turn) - east * std::sin(turn);
        return {0.5 * (rows - 1) - back * mean_m / post_m, 0.5 * (columns - 1) + along * mean_m / post_m};
    }
    static constexpr double mean_m = 6371000.0;
};

inline std::shared_ptr<const LatticeGeoreference> net_of(const PlaneOfPosts& plane) {
    auto net = LatticeGeoreference::fit(
        plane.rows, plane.columns,
        [&](std::span<const PostNumber> posts, std::span<PostPlace> places) -> Result<void> {
            for (std::size_t i = 0; i < posts.size(); ++i)
                places[i] = plane.place_of(posts[i].row, posts[i].column);
            return {};
        });
    EXPECT_TRUE(net.ok()) << net.error().line();
    return net.ok() ? *net : nullptr;
}

// The same moved by a grid of shifts, as some datums are: bilinear between nodes, each moved by up to so many
// metres.
struct KinkedPlane {
    PlaneOfPosts plane;
    double node_posts{110.7};
    double shift_m{0.05};

    // Of a node, in posts.
    [[nodiscard]] glm::dvec2 shift(double row, double column) const {
        const double mixed = std::sin(12.9898 * row + 78.233 * column) * 43758.5453,
                     other = std::sin(39.346 * row + 11.135 * column) * 24634.6345;
        return (2.0 * glm::dvec2(mixed - std::floor(mixed), other - std::floor(other)) - 1.0) *
               (shift_m / plane.post_m);
    }
    [[nodiscard]] PostPlace place_of(double row, double column) const {
        const double down = row / node_posts, right = column / node_posts;
        const double i = std::floor(down), j = std::floor(right);
        const glm::dvec2 north = glm::mix(shift(i, j), shift(i, j + 1.0), right - j),
                         south = glm::mix(shift(i + 1.0, j), shift(i + 1.0, j + 1.0), right - j);
        const glm::dvec2 moved = glm::mix(north, south, down - i);
        return plane.place_of(row + moved.x, column + moved.y);
    }
};

inline Result<std::shared_ptr<const LatticeGeoreference>> fit_of(
    int rows, int columns, const std::function<PostPlace(double row, double column)>& place) {
    return LatticeGeoreference::fit(
        rows, columns, [&](std::span<const PostNumber> posts, std::span<PostPlace> places) -> Result<void> {
            for (std::size_t i = 0; i < posts.size(); ++i) places[i] = place(posts[i].row, posts[i].column);
            return {};
        });
}

inline std::shared_ptr<const LatticeGeoreference> kinked_net_of(const KinkedPlane& kinked) {
    auto net = fit_of(kinked.plane.rows, kinked.plane.columns,
                      [&](double row, double column) { return kinked.place_of(row, column); });
    EXPECT_TRUE(net.ok()) << net.error().line();
    EXPECT_TRUE(net.ok() && (*net)->is_corrected());
    return net.ok() ? *net : nullptr;
}

// H by row and column. N is 0, or `N_m` everywhere.
inline HeightField net_field(const PlaneOfPosts& plane, const std::function<float(double, double)>& H_m,
                             float N_m = 0.0F) {
    HeightField field;
    field.grid.lat = {std::nan(""), std::nan(""), 0, -1, plane.rows};
    field.grid.lon = {std::nan(""), std::nan(""), 0, +1, plane.columns};
    field.grid.net = net_of(plane);
    for (int row = 0; row < plane.rows; ++row) {
        for (int column = 0; column < plane.columns; ++column) field.H_m.push_back(H_m(row, column));
    }
    if (N_m != 0.0F) field.N_of_posts_m.assign(field.H_m.size(), N_m);
    return field;
}

// Hills on all scales, rough in places and smooth in others, so that levels meet everywhere.
inline float patchy_H_m(double row, double column) {
    double H_m = 0.0, height_m = 700.0, scale = 0.03;
    for (int octave = 0; octave < 6; ++octave) {
        H_m +=
            height_m * std::sin(scale * row + 1.3 * octave) * std::cos(0.8 * scale * column - 0.7 * octave);
        height_m *= 0.5;
        scale *= 2.03;
    }
    const double calm = 0.5 + 0.5 * std::sin(row * 0.02) * std::cos(column * 0.017);
    return static_cast<float>(500.0 + H_m * std::pow(calm, 4.0));
}

}  // namespace oro::test

// The posts of a page in double, and what holds them: spheres and the cone of the horizon.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/earth/culling.h"
#include "shaders/shared.h"

namespace oro {

// Coordinate by coordinate, row by row, so that several are reckoned with at once. Lent for page after page:
// fresh memory for each costs more than what is done in it.
struct PlacedPosts {
    static constexpr std::size_t across = gpu::page_posts;
    static constexpr std::size_t count = across * across;
    std::vector<double> x, y, z;                       // page frame, metres
    std::vector<double> scaled_x, scaled_y, scaled_z;  // as horizon_point() takes them
    std::vector<unsigned char> drawn;                  // that belong to a triangle

    PlacedPosts()
        : x(count), y(count), z(count), scaled_x(count), scaled_y(count), scaled_z(count), drawn(count) {}
    [[nodiscard]] glm::dvec3 position_m(std::size_t i) const { return {x[i], y[i], z[i]}; }
    [[nodiscard]] glm::dvec3 scaled(std::size_t i) const { return {scaled_x[i], scaled_y[i], scaled_z[i]}; }
    // Leaves the posts that are drawn, moved together in their order; how many they are.
    std::size_t gather_drawn();
};

// What the posts of a row share (core/terrain/page.cpp).
struct PlacedRow {
    double normal_m;  // prime-vertical radius
    double cosine;    // of the latitude
    double sine;
    double rho0_m;  // of the page's origin
    double z0_m;
};
// Places `row` of the page. steps: its heights; V and W: terms of the columns.
void place_row(const PlacedRow& at, const std::int32_t* steps, const std::array<double, gpu::page_posts>& V,
               const std::array<double, gpu::page_posts>& W, std::size_t row, PlacedPosts& posts);
// Fills the scaled places. origin_m: of the page, in the frame turned as its own; radii_m: of the occluder.
void scale_posts(const glm::dvec3& origin_m, const glm::dvec3& radii_m, PlacedPosts& posts);

struct PostSphere {
    glm::vec3 centre;
    float radius;
};
// Around points, with the centre already rounded to float. Slack for the rounding of the points themselves
// when the GPU places them in float.
PostSphere sphere_around(std::span<const glm::dvec3> points);
// The sphere around the first `count` posts, at least one; and those around the 9 x 9 of each meshlet.
PostSphere sphere_around(const PlacedPosts& posts, std::size_t count);
void spheres_of_meshlets(const PlacedPosts& posts, std::array<PostSphere, gpu::meshlets_per_page>& spheres);

// horizon_cone() of the first `count` posts, at least one, to the bit.
HorizonCone horizon_cone(const PlacedPosts& posts, std::size_t count);

}  // namespace oro

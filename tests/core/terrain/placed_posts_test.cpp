// Several posts at once, against one after another: the same bits.
#include "core/terrain/placed_posts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/earth/ellipsoid.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

constexpr std::size_t across = PlacedPosts::across;
const glm::dvec3 origin_m{4.3e6, 0.0, 4.6e6};
const glm::dvec3 radii_m{wgs84_a_m - 200.0, wgs84_a_m - 200.0, wgs84_b_m - 200.0};

// Posts over so many metres, some drawn.
void fill(PlacedPosts& posts, double size_m, unsigned seed, double drawn_share) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t i = 0; i < PlacedPosts::count; ++i) {
        const double right = size_m * (static_cast<double>(i % across) / across - 0.5);
        const double up = size_m * (static_cast<double>(i / across) / across - 0.5);
        const double rise_m = 3000.0 * unit(random);
        posts.x[i] = 0.68 * rise_m + 0.7 * up;
        posts.y[i] = right;
        posts.z[i] = 0.73 * rise_m - 0.7 * up;
        posts.drawn[i] = unit(random) < drawn_share ? 1 : 0;
    }
    scale_posts(origin_m, radii_m, posts);
}

std::vector<glm::dvec3> positions(const PlacedPosts& posts, std::size_t count) {
    std::vector<glm::dvec3> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(posts.position_m(i));
    return all;
}

void expect_same(const PostSphere& a, const PostSphere& b) {
    EXPECT_EQ(a.centre, b.centre);
    EXPECT_EQ(a.radius, b.radius);
}

TEST(PlacedPosts, RowsAreThoseOfTheFormula) {
    PlacedPosts posts;
    std::array<double, gpu::page_posts> V{}, W{};
    std::vector<std::int32_t> steps(across);
    std::mt19937_64 random(5);
    for (std::size_t j = 0; j < across; ++j) {
        const double turn = 1.0e-4 * (static_cast<double>(j) - 64.0);
        V[j] = 2.0 * std::sin(0.5 * turn) * std::sin(0.5 * turn);
        W[j] = std::sin(turn);
        steps[j] = static_cast<std::int32_t>(random() % 9'000'000) - 500'000;
    }
    const PlacedRow row{6388000.0, std::cos(0.8), std::sin(0.8), 4.4e6, 4.5e6};
    place_row(row, steps.data(), V, W, 7, posts);
    for (std::size_t j = 0; j < across; ++j) {
        const double h_m = steps[j] * height_step_m, r = (row.normal_m + h_m) * row.cosine;
        const glm::dvec3 expected{r - row.rho0_m - r * V[j], r * W[j],
                                  (row.normal_m * (1.0 - wgs84_e2) + h_m) * row.sine - row.z0_m};
        EXPECT_EQ(posts.position_m(7 * across + j), expected) << j;
    }
}

TEST(PlacedPosts, SpheresAreThoseOfTheirPoints) {
    PlacedPosts posts;
    fill(posts, 12000.0, 6, 1.0);
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{15}, std::size_t{1000},
                                    std::size_t{PlacedPosts::count}})
        expect_same(sphere_around(posts, count), sphere_around(positions(posts, count)));
    std::array<PostSphere, gpu::meshlets_per_page> spheres;
    spheres_of_meshlets(posts, spheres);
    for (std::size_t node = 0; node < spheres.size(); ++node) {
        std::vector<glm::dvec3> own;
        for (std::size_t r = 0; r < 9; ++r)
            for (std::size_t c = 0; c < 9; ++c)
                own.push_back(posts.position_m((node / 16 * 8 + r) * across + node % 16 * 8 + c));
        expect_same(spheres[node], sphere_around(own));
    }
}

// As wide as a valley, as a country, and as the Earth, where the cone is asked for one by one.
TEST(PlacedPosts, ConesAreThoseOfTheirPoints) {
    for (const double size_m : {3.0e3, 1.2e4, 1.0e6, 1.8e7}) {
        PlacedPosts posts;
        fill(posts, size_m, 7, 1.0);
        for (const std::size_t count :
             {std::size_t{1}, std::size_t{127}, std::size_t{129}, std::size_t{PlacedPosts::count}}) {
            std::vector<HorizonPoint> points;
            for (std::size_t i = 0; i < count; ++i) points.push_back(horizon_point(posts.scaled(i)));
            const HorizonCone cone = horizon_cone(posts, count), expected = horizon_cone(points);
            EXPECT_EQ(cone.direction, expected.direction) << size_m << " m, " << count;
            EXPECT_EQ(cone.angle_rad, expected.angle_rad) << size_m << " m, " << count;
        }
    }
}

TEST(PlacedPosts, ThoseThatAreDrawnMoveTogether) {
    PlacedPosts posts;
    fill(posts, 12000.0, 8, 0.3);
    std::vector<glm::dvec3> expected, scaled;
    for (std::size_t i = 0; i < PlacedPosts::count; ++i) {
        if (posts.drawn[i] == 0) continue;
        expected.push_back(posts.position_m(i));
        scaled.push_back(posts.scaled(i));
    }
    ASSERT_EQ(posts.gather_drawn(), expected.size());
    EXPECT_GT(expected.size(), 1000U);
    EXPECT_EQ(positions(posts, expected.size()), expected);
    for (std::size_t i = 0; i < scaled.size(); ++i) ASSERT_EQ(posts.scaled(i), scaled[i]) << i;
}

}  // namespace
}  // namespace oro

// Polygons cut into triangles: by hand, by chance, and with holes.
#include "geo/meshes/polygon_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <numeric>
#include <random>

namespace oro {
namespace {

double area_of_triangles(const std::vector<glm::dvec3>& vertices,
                         const ScratchVector<SourceTriangle>& triangles) {
    double sum = 0.0;
    for (const SourceTriangle& t : triangles)
        sum +=
            0.5 * glm::length(glm::cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]));
    return sum;
}

std::vector<std::uint32_t> ring_of(std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> ring(count);
    std::iota(ring.begin(), ring.end(), static_cast<std::uint32_t>(first));
    return ring;
}

// A fan from the first corner would cover a place outside the angle: 3 where the angle's area is 2 + 1 - 0.5.
TEST(PolygonCut, AnAngleIsNoFan) {
    const std::vector<glm::dvec3> upright{{0, 5, 0}, {2, 5, 0}, {0.5, 5, 0.5}, {0, 5, 2}};
    // Its first corner is opposite to the notch: cut there.
    for (std::size_t first = 0; first < 4; ++first) {
        std::vector<std::uint32_t> ring = ring_of(0, 4);
        std::ranges::rotate(ring, ring.begin() + static_cast<std::ptrdiff_t>(first));
        ScratchVector<SourceTriangle> triangles;
        ASSERT_TRUE(cut_polygon(upright, {ring}, triangles));
        ASSERT_EQ(triangles.size(), 2U);
        // The area by the shoelace formula: (0*0 - 2*0 + 2*0.5 - 0.5*0 + 0.5*2 - 0*0.5 + 0) / 2 = 1.
        EXPECT_NEAR(area_of_triangles(upright, triangles), 1.0, 1.0e-12) << "m2";
    }
}

TEST(PolygonCut, TrianglesTurnAsThePolygonDoes) {
    const std::vector<glm::dvec3> square{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (const std::vector<std::uint32_t>& ring :
         {std::vector<std::uint32_t>{0, 1, 2, 3}, std::vector<std::uint32_t>{3, 2, 1, 0}}) {
        ScratchVector<SourceTriangle> triangles;
        ASSERT_TRUE(cut_polygon(square, {ring}, triangles));
        for (const SourceTriangle& t : triangles) {
            const double up = glm::cross(square[t[1]] - square[t[0]], square[t[2]] - square[t[0]]).z;
            EXPECT_EQ(up > 0.0, ring[0] == 0U);
        }
    }
}

TEST(PolygonCut, HolesStayOpen) {
    std::vector<glm::dvec3> vertices{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}};
    PolygonRings rings{ring_of(0, 4)};
    for (const auto& [x, y] : {std::pair{1.0, 1.0}, std::pair{6.0, 1.0}, std::pair{6.0, 6.0}}) {
        rings.push_back(ring_of(vertices.size(), 4));
        for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 2), glm::dvec2(0, 2)})
            vertices.emplace_back(x + at.x, y + at.y, 0.0);
    }
    ScratchVector<SourceTriangle> triangles;
    ASSERT_TRUE(cut_polygon(vertices, rings, triangles));
    EXPECT_EQ(triangles.size(), 16U + 2U * 3U - 2U);
    EXPECT_NEAR(area_of_triangles(vertices, triangles), 81.0 - 3.0 * 2.0, 1.0e-12) << "m2";
}

// Stars with deep notches, in planes of any tilt, far from the origin: the triangles have the polygon's area,
// so none overlaps and none lies outside.
TEST(PolygonCut, StarsByChance) {
    const unsigned seed = 520;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int round = 0; round < 300; ++round) {
        const std::size_t corners = 4 + random() % 60;
        const glm::dvec3 up = glm::normalize(glm::dvec3(share(random), share(random), share(random)) - 0.4);
        const glm::dvec3 along = glm::normalize(glm::cross(up, glm::dvec3(0.3, -0.8, 0.5))),
                         across = glm::cross(up, along), middle(2600000.0, 1200000.0, 400.0);
        std::vector<glm::dvec3> vertices;
        double area = 0.0;
        std::vector<glm::dvec2> flat;
        for (std::size_t i = 0; i < corners; ++i) {
            const double angle =
                2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
            const double radius = 1.0 + 20.0 * share(random);
            flat.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
            vertices.push_back(middle + flat.back().x * along + flat.back().y * across);
        }
        for (std::size_t i = 0; i < corners; ++i) {
            const glm::dvec2 &a = flat[i], &b = flat[(i + 1) % corners];
            area += 0.5 * (a.x * b.y - a.y * b.x);
        }
        ScratchVector<SourceTriangle> triangles;
        EXPECT_TRUE(cut_polygon(vertices, {ring_of(0, corners)}, triangles)) << round;
        EXPECT_EQ(triangles.size(), corners - 2);
        EXPECT_NEAR(area_of_triangles(vertices, triangles), area, 1.0e-6 * area) << round;
    }
}

// What crosses itself, lies on one line or has one place is cut nevertheless, in an end, and said.
TEST(PolygonCut, CrossingAndFlatPolygonsEnd) {
    const std::vector<glm::dvec3> vertices{{0, 0, 0}, {4, 3, 0},  {4, 0, 0},  {0, 3, 0},
                                           {2, 9, 0}, {1, -9, 0}, {NAN, 0, 0}};
    for (const std::vector<std::uint32_t>& ring :
         {std::vector<std::uint32_t>{0, 1, 2, 3}, std::vector<std::uint32_t>{0, 0, 0, 0},
          std::vector<std::uint32_t>{0, 1, 0, 1}, std::vector<std::uint32_t>{0, 1, 6, 3}}) {
        ScratchVector<SourceTriangle> triangles;
        EXPECT_FALSE(cut_polygon(vertices, {ring}, triangles));
        EXPECT_EQ(triangles.size(), ring.size() - 2);
    }
    const unsigned seed = 521;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    for (int round = 0; round < 2000; ++round) {
        std::vector<std::uint32_t> ring(3 + random() % 12);
        for (std::uint32_t& corner : ring) corner = static_cast<std::uint32_t>(random() % vertices.size());
        ScratchVector<SourceTriangle> triangles;
        cut_polygon(vertices, {ring}, triangles);
        EXPECT_EQ(triangles.size(), ring.size() - 2);
    }
}

}  // namespace
}  // namespace oro

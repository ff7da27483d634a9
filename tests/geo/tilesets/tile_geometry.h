// What viewers may draw of a tileset, and how far places are from it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "tests/geo/tilesets/read_tileset.h"

namespace oro::test {

// How far a place is from a triangle. Source: C. Ericson, Real-Time Collision Detection, 5.1.5.
inline double distance_to(const glm::dvec3& place, const std::array<glm::dvec3, 3>& triangle) {
    const glm::dvec3 &a = triangle[0], &b = triangle[1], &c = triangle[2];
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double twice = glm::length(normal);
    const auto beside = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, place - from), normal) >= 0.0;
    };
    if (twice > 0.0 && beside(a, b) && beside(b, c) && beside(c, a))
        return std::abs(glm::dot(place - a, normal)) / twice;
    const auto to_edge = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 along = to - from;
        const double whole = glm::dot(along, along);
        const double share = whole > 0.0 ? std::clamp(glm::dot(place - from, along) / whole, 0.0, 1.0) : 0.0;
        return glm::distance(place, from + share * along);
    };
    return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

// A cut below a tile: it is drawn, or all below it are.
inline void random_cut(const std::vector<ReadTile>& tiles, int number, std::mt19937& random,
                       std::vector<int>& cut) {
    const ReadTile& tile = tiles[static_cast<std::size_t>(number)];
    if (!tile.uri.empty() && (tile.children.empty() || random() % 2 == 0)) {
        cut.push_back(number);
        return;
    }
    for (const int child : tile.children) random_cut(tiles, child, random, cut);
}

// Of a tile's boundingVolume.region, for a place in ECEF.
inline void expect_in_region(const ReadTile& tile, const glm::dvec3& place_m) {
    const Geodetic at = geodetic_from_ecef({place_m});
    EXPECT_GE(radians_from_deg(at.lon_deg).rad, tile.region[0]);
    EXPECT_GE(radians_from_deg(at.lat_deg).rad, tile.region[1]);
    EXPECT_LE(radians_from_deg(at.lon_deg).rad, tile.region[2]);
    EXPECT_LE(radians_from_deg(at.lat_deg).rad, tile.region[3]);
    EXPECT_GE(at.h_m, tile.region[4]);
    EXPECT_LE(at.h_m, tile.region[5]);
}

// Errors never grow downwards; a tile's region holds its own vertices and the regions of its children.
inline void expect_sound_tree(const std::vector<ReadTile>& tiles, int number) {
    const ReadTile& tile = tiles[static_cast<std::size_t>(number)];
    for (const glm::dvec3& post : tile.posts_m) expect_in_region(tile, post);
    for (const int child : tile.children) {
        const ReadTile& below = tiles[static_cast<std::size_t>(child)];
        EXPECT_LE(below.error_m, tile.error_m);
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_TRUE(i < 2 || i == 4 ? below.region[i] >= tile.region[i]
                                        : below.region[i] <= tile.region[i])
                << i;
        expect_sound_tree(tiles, child);
    }
}

}  // namespace oro::test

// The map of ground near meshes, against distances of brute force, and as a frame has it.
#include "core/seam/cleared_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

// Houses of two triangles some 10 m wide, 300 m around a place; every third one is no building.
MeshCasters casters_of_houses(std::mt19937& random) {
    const glm::dmat3 axes = ecef_from_enu(47.0, 8.0);
    const glm::dvec3 middle = ecef_from_geodetic({47.0, 8.0, 500.0}).m;
    std::uniform_real_distribution<double> place(-300.0, 300.0);
    Seam seam;
    for (std::uint32_t house = 0; house < 12; ++house) {
        const glm::dvec2 at(place(random), place(random));
        for (const double turn : {1.0, -1.0}) {
            SeamPiece& piece = seam.pieces.emplace_back();
            piece.two_sided = true;
            piece.look = house % 3 == 0 ? gpu::mesh_look_ground : gpu::mesh_look_built;
            const glm::dvec2 corners[3] = {at, at + turn * glm::dvec2(10.0, 2.0),
                                           at + turn * glm::dvec2(1.0, 9.0)};
            for (std::size_t i = 0; i < 3; ++i)
                piece.corners[i].at.m = middle + axes * glm::dvec3(corners[i], 5.0);
        }
    }
    return mesh_casters_of(seam);
}

TEST(ClearedMap, DistancesAreThoseOfBruteForce) {
    const unsigned seed = 5201;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const ClearedMap map = cleared_map_of(casters_of_houses(random));
    ASSERT_EQ(map.cell_m, 4.0);
    for (const unsigned shift : {0U, 8U}) {
        std::vector<glm::dvec2> touched;
        for (unsigned row = 0; row < map.side.y; ++row)
            for (unsigned column = 0; column < map.side.x; ++column)
                if ((map.cells[row * map.side.x + column] >> shift & 255U) == 255U)
                    touched.emplace_back(column, row);
        // A triangle of 40 square metres lies over two to nine cells.
        EXPECT_GT(touched.size(), shift == 0 ? 24U : 16U);
        EXPECT_LT(touched.size(), 24U * 9U);
        for (unsigned row = 0; row < map.side.y; ++row)
            for (unsigned column = 0; column < map.side.x; ++column) {
                double nearest = 1.0e9;
                for (const glm::dvec2& cell : touched)
                    nearest = std::min(nearest, glm::distance(cell, glm::dvec2(column, row)));
                const double said_m =
                    64.0 * (1.0 - (map.cells[row * map.side.x + column] >> shift & 255U) / 255.0);
                const double step_m = 64.0 / 255.0;
                EXPECT_GE(said_m, std::min(64.0, 4.0 * nearest) - step_m);
                EXPECT_LE(said_m, std::min(64.0, 1.083 * 4.0 * nearest) + step_m);
            }
    }
    // What is ground is no building: the second byte is never more than the first.
    for (const std::uint32_t cell : map.cells) EXPECT_LE(cell >> 8U, cell & 255U);
}

TEST(ClearedMap, AFrameFindsPlacesInIt) {
    std::mt19937 random(5202);
    const ClearedMap map = cleared_map_of(casters_of_houses(random));
    Camera camera;
    camera.eye = {47.001, 8.002, 900.0};
    const gpu::ClearedGround ground = cleared_in_view(map, camera);
    const glm::dvec3 place = ecef_from_geodetic({46.9995, 8.0008, 480.0}).m;
    const glm::dvec3 view = camera.view_from_ecef() * (place - camera.eye_ecef().m);
    const glm::dvec2 said(static_cast<double>(glm::dot(ground.along_x, glm::vec3(view)) + ground.eye.x),
                          static_cast<double>(glm::dot(ground.along_y, glm::vec3(view)) + ground.eye.y));
    const glm::dvec2 expected =
        glm::dvec2(glm::dot(place - map.middle_m, map.east), glm::dot(place - map.middle_m, map.south)) /
            4.0 +
        0.5 * glm::dvec2(map.side);
    EXPECT_NEAR(said.x, expected.x, 1.0e-3) << "cells";
    EXPECT_NEAR(said.y, expected.y, 1.0e-3) << "cells";
    EXPECT_EQ(ground.cells, gpu::uvec2(0U));
}

TEST(ClearedMap, WithoutMeshesThereIsNone) {
    EXPECT_TRUE(cleared_map_of(MeshCasters{}).cells.empty());
}

}  // namespace
}  // namespace oro

// Level choice: the bound on the screen, the cover, the edges, and the promise itself, each against brute
// force.
#include "core/lod/levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <random>

#include "tests/core/lod/covering.h"
#include "tests/core/lod/pyramid_region.h"
#include "tests/core/truth/drawn_surface.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

using test::Region, test::patchy_field, test::random_camera, test::whole, test::taus_px;

TEST(Levels, CoverTheRegionOnceInStepsOfOne) {
    const unsigned seed = 300;
    std::mt19937_64 random(seed);
    HeightField with_voids = patchy_field(420, 470);
    for (int row = 130; row < 200; ++row) {
        for (int column = 129; column < 256; ++column)
            with_voids.H_m[static_cast<std::size_t>(row * 470 + column)] = void_height_m;
    }
    with_voids.H_m[300 * 470 + 77] = void_height_m;
    const Region regions[] = {
        Region(patchy_field(600, 521)), Region(std::move(with_voids)),
        Region(test::world_field(300.0 / 360.0, 60, -150, 121, 301, [](double lat_deg, double lon_deg) {
            return 1000.0 + 3000.0 * std::sin(0.1 * lat_deg) * std::sin(0.0174532925 * lon_deg * 3.0);
        }))};
    std::array<std::size_t, 8> by_level{};
    std::size_t stitched = 0;
    for (int i = 0; i < 300; ++i) {
        const Region& region = regions[i % 3];
        const Camera camera = random_camera(random, region);
        const NodeSelection selection =
            select_nodes(region.unhidden, camera, whole(camera), taus_px[i / 3 % 3]);
        std::vector<int> level_at;
        ASSERT_NO_FATAL_FAILURE(test::expect_one_cover(region, selection.nodes, level_at)) << i;
        ASSERT_NO_FATAL_FAILURE(test::expect_steps_of_one(region, level_at)) << i;
        if (i < 24) {
            ASSERT_NO_FATAL_FAILURE(test::expect_watertight(region, selection.nodes)) << i;
        }
        for (const DrawnNode& node : selection.nodes) {
            ++by_level[static_cast<std::size_t>(node.level)];
            stitched += node.edges != 0 ? 1 : 0;
        }
    }
    std::printf("seed %u: 300 cameras, nodes drawn by level:", seed);
    for (const std::size_t count : by_level) std::printf(" %zu", count);
    std::printf("; %zu stitched\n", stitched);
    for (int level = 0; level < 4; ++level) EXPECT_GT(by_level[static_cast<std::size_t>(level)], 100U);
    EXPECT_GT(stitched, 1000U);
}

TEST(Levels, DoNotDependOnWhatIsHiddenNorOnTheTile) {
    std::mt19937_64 random(12);
    const Region region(patchy_field(600, 521));
    std::size_t left_out = 0, drawn = 0;
    for (int i = 0; i < 60; ++i) {
        const Camera camera = random_camera(random, region);
        Tile tile = whole(camera);
        if (i % 2 == 0)
            tile = {camera.width_px / 2, 0, camera.width_px / 2, camera.height_px / 3, {0.25, 0.75}};
        std::map<std::array<int, 3>, std::uint32_t> all;
        for (const DrawnNode& node : select_nodes(region.unhidden, camera, whole(camera), 1.0).nodes)
            all[{node.level, node.row, node.column}] = node.edges;
        const auto planes = frustum_planes_view(projection_of_tile(camera, tile));
        const HorizonEye eye = horizon_eye(region.pyramid.shape.occluder, camera.eye_ecef());
        const glm::dmat3 view_from_ecef = camera.view_from_ecef();
        for (const DrawnNode& node : select_nodes(region.pyramid, camera, tile, 1.0).nodes) {
            const auto found = all.find({node.level, node.row, node.column});
            ASSERT_NE(found, all.end());
            ASSERT_EQ(found->second, node.edges);
            all.erase(found);
            ++drawn;
        }
        // What was left out cannot be seen: no post of it is both in the tile and before the horizon.
        left_out += all.size();
        for (const auto& [number, edges] : all) {
            for (const auto& triangle :
                 test::drawn_triangles(region.heights, region.grid(number[0]), number[1], number[2], edges)) {
                for (const auto& post : triangle) {
                    const glm::dvec3 at = view_from_ecef * (region.ecef_m(post) - camera.eye_ecef().m);
                    const std::array points{region.ecef_m(post)};
                    ASSERT_TRUE(beyond_frustum(planes, at, -1.0e-6) ||
                                beyond_horizon(eye, horizon_cone(region.pyramid.shape.occluder, points)));
                }
            }
        }
    }
    EXPECT_GT(left_out, 1000U);
    EXPECT_GT(drawn, 1000U);
}

TEST(Levels, AtTauZeroAllIsDrawnAtFullResolution) {
    std::mt19937_64 random(2);
    const Region region(patchy_field(300, 290));
    for (int i = 0; i < 5; ++i) {
        const Camera camera = random_camera(random, region);
        for (const DrawnNode& node : select_nodes(region.unhidden, camera, whole(camera), 0.0).nodes) {
            ASSERT_EQ(node.level, 0);
            ASSERT_EQ(node.edges, 0U);
        }
    }
}

}  // namespace
}  // namespace oro

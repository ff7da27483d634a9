// Cuts: what an error and a view ask for.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/earth/camera.h"
#include "tests/core/clusters/cluster_terrain.h"

namespace oro {
namespace {

using namespace test;

Camera random_camera(std::mt19937_64& random, const ClusterTerrain& terrain) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const PostGrid& grid = terrain.field.grid;
    Camera camera;
    const auto place = [&] {
        return grid.place_at(unit(random) * (grid.rows() - 1), unit(random) * (grid.columns() - 1));
    };
    const PostPlace over = place(), target = place();
    camera.eye = {over.lat_deg, over.lon_deg, 500.0 + 2.0 * std::pow(1.0e5, unit(random))};
    camera.attitude = attitude_towards(camera.eye, {target.lat_deg, target.lon_deg, 300.0});
    camera.vertical_fov_deg = 20.0 + 60.0 * unit(random);
    camera.width_px = 640;
    camera.height_px = 480;
    return camera;
}

// What is drawn of the original's posts, where the picture shows them: within tau of where they belong.
double largest_shift_px(const ClusterTerrain& terrain, const Camera& camera,
                        const std::vector<std::uint32_t>& cut) {
    const glm::dmat3 view = camera.view_from_ecef();
    const glm::dvec3 eye = camera.eye_ecef().m;
    const glm::dvec2 tangent = camera.half_fov_tangent();
    const double pixels = 0.5 * camera.height_px / tangent.y;
    double largest = 0.0;
    for (const VertexTriangle& triangle : triangles_of(terrain.graph, cut)) {
        const SurfaceVertex a = terrain.surface.vertex(triangle[0]), b = terrain.surface.vertex(triangle[1]),
                            c = terrain.surface.vertex(triangle[2]);
        const auto whole = static_cast<double>(twice_area(a, b, c));
        if (whole < 3.0) continue;
        for (int row = std::min({a.row, b.row, c.row}); row <= std::max({a.row, b.row, c.row}); ++row) {
            for (int column = std::min({a.column, b.column, c.column});
                 column <= std::max({a.column, b.column, c.column}); ++column) {
                const SurfaceVertex at =
                    terrain.surface.vertex(static_cast<VertexNumber>(row * terrain.heights.columns + column));
                const double of_a = static_cast<double>(twice_area(b, c, at)) / whole;
                const double of_b = static_cast<double>(twice_area(c, a, at)) / whole;
                const double of_c = 1.0 - of_a - of_b;
                if (std::min({of_a, of_b, of_c}) < -1.0e-12) continue;
                const glm::dvec3 truth = view * (terrain.bounds.ecef(at).m - eye);
                const glm::dvec3 drawn =
                    view * (of_a * terrain.bounds.ecef(a).m + of_b * terrain.bounds.ecef(b).m +
                            of_c * terrain.bounds.ecef(c).m - eye);
                if (truth.z >= 0.0 || std::abs(truth.x) > -truth.z * tangent.x ||
                    std::abs(truth.y) > -truth.z * tangent.y)
                    continue;
                largest = std::max(largest, drawn.z < 0.0
                                                ? pixels * std::hypot(truth.x / truth.z - drawn.x / drawn.z,
                                                                      truth.y / truth.z - drawn.y / drawn.z)
                                                : 1.0e9);
            }
        }
    }
    return largest;
}

TEST(ClusterCut, MetresTakeFewerTrianglesTheMoreTheyAre) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 150, 150));
    std::size_t last = original_triangles(terrain.surface).size();
    EXPECT_EQ(triangles_of_cut(terrain.graph, cut_by_metres(terrain.graph, 0.0)), last);
    for (const double error_m : {30.0, 50.0, 100.0, 200.0, 400.0}) {
        const auto cut = cut_by_metres(terrain.graph, error_m);
        const std::size_t triangles = triangles_of_cut(terrain.graph, cut);
        EXPECT_LT(triangles, last) << error_m;
        last = triangles;
        EXPECT_TRUE(std::is_sorted(cut.begin(), cut.end()));
        for (const std::uint32_t cluster : cut) {
            const std::uint32_t maker = terrain.graph.clusters[cluster].made_by;
            if (maker != no_group) {
                EXPECT_LE(terrain.graph.groups[maker].error_m, error_m);
            }
        }
    }
}

TEST(ClusterCut, AViewIsWithinTau) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 150, 140));
    std::mt19937_64 random(404);
    double largest_share = 0.0;
    std::size_t coarse = 0;
    for (int i = 0; i < 60; ++i) {
        const Camera camera = random_camera(random, terrain);
        for (const double tau_px : {0.5, 2.0, 8.0}) {
            const auto cut = cut_by_pixels(terrain.graph, camera, tau_px);
            const double share = largest_shift_px(terrain, camera, cut) / tau_px;
            EXPECT_LE(share, 1.0) << "seed 404, view " << i << ", tau " << tau_px;
            largest_share = std::max(largest_share, share);
            coarse += triangles_of_cut(terrain.graph, cut) < 20000 ? 1U : 0U;
        }
    }
    EXPECT_GT(largest_share, 0.5);
    EXPECT_GT(coarse, 50U);
}

// The same triangles cover the same ground, whatever the view.
TEST(ClusterCut, AViewCoversEverything) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 150, 140));
    std::mt19937_64 random(405);
    for (int i = 0; i < 50; ++i) {
        const Camera camera = random_camera(random, terrain);
        std::int64_t area = 0;
        for (const VertexTriangle& triangle :
             triangles_of(terrain.graph, cut_by_pixels(terrain.graph, camera, 1.0)))
            area += twice_area(terrain.surface.vertex(triangle[0]), terrain.surface.vertex(triangle[1]),
                               terrain.surface.vertex(triangle[2]));
        EXPECT_EQ(area, 2 * 149 * 139) << "seed 405, view " << i;
    }
}

TEST(ClusterCut, TauZeroIsTheOriginal) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 50, 60));
    std::mt19937_64 random(7);
    EXPECT_EQ(
        triangles_of_cut(terrain.graph, cut_by_pixels(terrain.graph, random_camera(random, terrain), 0.0)),
        2U * 49U * 59U);
}

}  // namespace
}  // namespace oro

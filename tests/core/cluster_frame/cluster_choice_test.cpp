// What a frame draws of a graph: the whole cut, but for what cannot be seen.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <set>

#include "core/cluster_frame/cluster_choice.h"
#include "core/cluster_frame/group_rule.h"
#include "core/lod/levels.h"
#include "tests/core/clusters/cluster_terrain.h"
#include "tests/support/drawn/cracks.h"

namespace oro {
namespace {

class ClusterChoices : public ::testing::Test {
  protected:
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 260, 310)};
    HorizonOccluder occluder_ = region_shape(terrain_.field, 1.0).occluder;

    std::unique_ptr<RegionClusters> clusters() {
        auto made = clusters_of_graph(terrain_.graph, terrain_.field, occluder_);
        EXPECT_TRUE(made.ok()) << made.error().line();
        return std::move(made).value();
    }
    // All of the terrain is in view.
    static Camera from_above() {
        Camera camera;
        camera.width_px = camera.height_px = 100;
        camera.eye = {46.9, 8.13, 200000.0};
        camera.attitude.pitch_deg = -90.0;
        return camera;
    }
    ClusterChoice choose(RegionClusters& clusters, const Camera& camera, double tau_px,
                         const WorldModel& model = {}, std::optional<std::uint32_t> level = {}) {
        auto choice = choose_clusters(clusters, camera, {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}},
                                      tau_px, model, occluder_, {}, level);
        EXPECT_TRUE(choice.ok()) << choice.error().line();
        return std::move(choice).value();
    }
};

// Of each cluster of the cut that is left out, every vertex lies beyond one plane of the frustum, or behind
// the horizon; and nothing is drawn that is not of the cut.
TEST_F(ClusterChoices, IsTheCutButForWhatCannotBeSeen) {
    constexpr unsigned seed = 301;
    std::mt19937_64 random(seed);
    const auto region = clusters();
    std::size_t drawn = 0, left_out = 0;
    for (int i = 0; i < 60; ++i) {
        const Camera camera = test::random_camera(random, terrain_.field);
        const double tau_px = i % 3 == 0 ? 4.0 : 1.0;
        const ClusterChoice choice = choose(*region, camera, tau_px);
        const std::set<std::uint32_t> chosen(choice.clusters.begin(), choice.clusters.end());
        EXPECT_EQ(chosen.size(), choice.clusters.size()) << "camera " << i << ": one is drawn twice";
        const auto cut = cut_by_pixels(terrain_.graph, camera, tau_px);
        const std::set<std::uint32_t> whole(cut.begin(), cut.end());
        for (const std::uint32_t cluster : chosen) EXPECT_TRUE(whole.contains(cluster)) << "camera " << i;
        const auto planes = frustum_planes_view(
            projection_of_tile(camera, {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}}));
        const HorizonEye eye = horizon_eye(occluder_, camera.eye_ecef());
        for (const std::uint32_t cluster : cut) {
            if (chosen.contains(cluster)) continue;
            ++left_out;
            std::vector<glm::dvec3> places_m;
            for (const VertexTriangle& triangle :
                 terrain_.graph.triangles_of(terrain_.graph.clusters[cluster]))
                for (const VertexNumber vertex : triangle)
                    places_m.push_back(terrain_.bounds.ecef(terrain_.surface.vertex(vertex)).m);
            const auto all_beyond = [&](const Plane& plane) {
                return std::ranges::all_of(places_m, [&](const glm::dvec3& place) {
                    const glm::dvec3 view = camera.view_from_ecef() * (place - camera.eye_ecef().m);
                    return glm::dot(glm::dvec3(plane), view) + plane.w < 0.0;
                });
            };
            EXPECT_TRUE(std::ranges::any_of(planes, all_beyond) ||
                        beyond_horizon(eye, horizon_cone(occluder_, places_m)))
                << "seed " << seed << ", camera " << i << ": cluster " << cluster << " can be seen";
        }
        drawn += chosen.size();
    }
    std::printf("seed %u: 60 cameras, %zu clusters drawn, %zu left out\n", seed, drawn, left_out);
    EXPECT_GT(drawn, 1000U);
    EXPECT_GT(left_out, 1000U);
}

// By level it is the discrete cut, in whatever view; and each cluster is told with its group.
TEST_F(ClusterChoices, OfALevelAreAllOfIt) {
    const auto region = clusters();
    const Camera camera = from_above();
    for (const std::uint32_t level : {0U, 1U, 3U, 8U, 80U}) {
        const ClusterChoice choice = choose(*region, camera, 1.0, {}, level);
        const std::set<std::uint32_t> chosen(choice.clusters.begin(), choice.clusters.end());
        const auto cut = cut_by_level(terrain_.graph, level);
        EXPECT_EQ(chosen, std::set<std::uint32_t>(cut.begin(), cut.end())) << level;
        ASSERT_EQ(choice.groups.size(), choice.clusters.size());
        for (std::size_t i = 0; i < choice.groups.size(); ++i) {
            const Cluster& cluster = terrain_.graph.clusters[choice.clusters[i]];
            EXPECT_EQ(choice.groups[i], level == 0 ? cluster.used_by : cluster.made_by);
        }
    }
    std::mt19937_64 random(304);
    for (int i = 0; i < 20; ++i) {
        const ClusterChoice choice =
            choose(*region, test::random_camera(random, terrain_.field), 1.0, {}, 5U);
        for (const std::uint32_t cluster : choice.clusters) EXPECT_EQ(region->level_of(cluster), 5U);
    }
}

// Where a group stands all below it stand, to the last bit of rounding, also where light bends.
TEST_F(ClusterChoices, TheRuleNeverStandsAboveWhatDoesNot) {
    std::mt19937_64 random(302);
    for (int i = 0; i < 200; ++i) {
        const Camera camera = test::random_camera(random, terrain_.field);
        const GroupRule rule(camera, std::pow(2.0, static_cast<double>(random() % 5) - 2.0),
                             i % 2 == 0 ? Air{} : Air{0.5, AirLaw::constant});
        for (const ClusterGroup& group : terrain_.graph.groups) {
            if (!rule.stands(group)) continue;
            for (const std::uint32_t member : terrain_.graph.members_of(group)) {
                const std::uint32_t below = terrain_.graph.clusters[member].made_by;
                ASSERT_TRUE(below == no_group || rule.stands(terrain_.graph.groups[below]))
                    << "seed 302, camera " << i;
            }
        }
    }
}

// The bound is that of the nodes' rule, whose float lies above it by what it may round.
TEST_F(ClusterChoices, TheRuleIsThatOfNodes) {
    std::mt19937_64 random(303);
    std::size_t bounded = 0;
    for (int i = 0; i < 100; ++i) {
        const Camera camera = test::random_camera(random, terrain_.field);
        const GroupRule rule(camera, 1.0);
        const LevelView view = level_view(camera, 1.0);
        for (const ClusterGroup& group : terrain_.graph.groups) {
            const double px = rule.error_px(group);
            const float nodes_px = gpu::projected_error_px(
                gpu::vec3(camera.view_from_ecef() * (group.centre.m - camera.eye_ecef().m)),
                static_cast<float>(group.radius_m), static_cast<float>(group.error_m),
                view.pixels_per_tangent, view.corner_tangent);
            if (nodes_px >= 1.0e30F) continue;  // nothing is promised
            EXPECT_LE(px, static_cast<double>(nodes_px) * (1.0 + 1.0e-6));
            // Within 10 m of the sphere the floats' slack is most of the distance.
            const double away_m =
                glm::length(group.centre.m - camera.eye_ecef().m) - group.radius_m - group.error_m;
            if (away_m < 0.01 * group.radius_m) continue;
            ++bounded;
            EXPECT_GE(px, static_cast<double>(nodes_px) * 0.98);
        }
    }
    EXPECT_GT(bounded, 1000U);
}

// A cluster of the original that tau 0 draws is the original.
TEST_F(ClusterChoices, WithoutAnErrorTheOriginalIsDrawn) {
    const auto region = clusters();
    const Camera camera = from_above();
    const ClusterChoice choice = choose(*region, camera, 0.0);
    std::size_t triangles = 0;
    for (const std::uint32_t cluster : choice.clusters)
        triangles += terrain_.graph.clusters[cluster].triangles;
    EXPECT_EQ(triangles, 2U * 259U * 309U);
}

}  // namespace
}  // namespace oro

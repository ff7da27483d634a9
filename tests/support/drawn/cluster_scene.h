// Scenes of a field that are drawn by clusters.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <ranges>
#include <utility>

#include "core/cluster_frame/region_clusters.h"
#include "core/terrain/ground.h"
#include "render/clusters/cluster_scene.h"
#include "render/scene/scene.h"
#include "tests/core/clusters/cluster_terrain.h"

namespace oro::test {

// terrain: outlives what is drawn. bytes, main_bytes: as ClusterScene::create().
inline void draw_by_clusters(const Gpu& gpu, const ClusterTerrain& terrain, Scene& scene,
                             std::uint64_t bytes = std::uint64_t{64} << 20U,
                             std::optional<std::uint32_t> level = {},
                             std::uint64_t main_bytes = GroupCache::no_limit) {
    auto clusters =
        clusters_of_graph(terrain.graph, terrain.field, scene.grids()[0].pages().facts().shape.occluder);
    ASSERT_TRUE(clusters.ok()) << clusters.error().line();
    auto made = ClusterScene::create(gpu, std::move(clusters).value(), bytes, main_bytes);
    ASSERT_TRUE(made.ok()) << made.error().line();
    if (level) made->keep_to_level(*level);
    scene.draw_clusters(std::move(made).value());
}

// Ground that is coarser may reach above an eye that stands lower over the true one than it is off.
inline bool ground_may_be_over_the_eye(const ClusterTerrain& terrain, const Camera& camera,
                                       const FramePlan& plan) {
    const double ground_m = ground_h_m(terrain.field, camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0);
    const auto cut = plan.grids[0].clusters.drawn | std::views::take(plan.grids[0].clusters.in_cut);
    return std::ranges::any_of(cut, [&](const gpu::DrawnCluster& drawn) {
        if (terrain.graph.clusters[drawn.number].made_by == no_group) return false;
        const ClusterGroup& group = terrain.graph.groups[drawn.group];
        return group.error_m >= camera.eye.h_m - ground_m &&
               glm::distance(group.centre.m, camera.eye_ecef().m) <= group.radius_m + group.error_m;
    });
}

}  // namespace oro::test

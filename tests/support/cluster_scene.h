// Scenes of a field that are drawn by clusters.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "core/cluster_frame/region_clusters.h"
#include "render/clusters/cluster_scene.h"
#include "render/scene/scene.h"
#include "tests/core/clusters/cluster_terrain.h"

namespace oro::test {

// terrain: outlives what is drawn.
inline void draw_by_clusters(const Gpu& gpu, const ClusterTerrain& terrain, Scene& scene,
                             std::uint64_t bytes = std::uint64_t{64} << 20U,
                             std::optional<std::uint32_t> level = {}) {
    auto clusters = clusters_of_graph(terrain.graph, terrain.field, scene.pages().facts().shape.occluder);
    ASSERT_TRUE(clusters.ok()) << clusters.error().line();
    auto made = ClusterScene::create(gpu, std::move(clusters).value(), bytes);
    ASSERT_TRUE(made.ok()) << made.error().line();
    if (level) made->keep_to_level(*level);
    scene.draw_clusters(std::move(made).value());
}

}  // namespace oro::test

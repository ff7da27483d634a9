// What a frame tells of its clusters.
#include "core/cluster_frame/shown_clusters.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

gpu::DrawnCluster drawn_of(std::uint32_t number, std::uint32_t group) {
    gpu::DrawnCluster cluster{};
    cluster.number = number;
    cluster.group = group;
    return cluster;
}

TEST(ClustersShown, AreThoseOfTheCutThatNothingHides) {
    const std::vector<gpu::DrawnCluster> drawn{drawn_of(10, 1), drawn_of(11, 1), drawn_of(20, 2),
                                               drawn_of(21, 2), drawn_of(30, 3), drawn_of(40, 4)};
    constexpr gpu::uint hidden = gpu::cluster_kept, was_drawn = gpu::cluster_kept | gpu::cluster_drawn;
    const std::vector<gpu::uint> states{hidden,    was_drawn | gpu::cluster_shows,
                                        was_drawn, hidden,
                                        0,         hidden | gpu::cluster_drawn_now | gpu::cluster_shows};
    const ShownClusters shown = shown_clusters(drawn, states);
    EXPECT_EQ(shown, (ShownClusters{{10, false}, {11, true}, {20, false}, {21, false}, {40, true}}));
    EXPECT_EQ(hidden_groups(drawn, shown), std::vector<std::uint32_t>{2});
    EXPECT_TRUE(hidden_groups(drawn, {}).empty()) << "nothing is known";
}

}  // namespace
}  // namespace oro

// Files whose checksums are right and whose groups' errors or spheres do not grow: refused by what draws
// them.
#include <functional>

#include "core/cluster_frame/cluster_choice.h"
#include "tests/core/cluster_file/made_cluster_file.h"

namespace oro {
namespace {

class LyingGroups : public ::testing::Test {
  protected:
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 110, 120)};
    HorizonOccluder occluder_ = region_shape(terrain_.field, 1.0).occluder;
    ClusterGraph graph_ = terrain_.graph;
    test::fs::path path_ = test::scratch_folder() / "a.oroc";

    std::uint32_t root() const { return static_cast<std::uint32_t>(graph_.groups.size()) - 1; }
    std::uint32_t first_of(std::uint32_t level) const {
        std::uint32_t group = 0;
        while (graph_.groups[group].level < level) ++group;
        return group;
    }
    // A group that uses what this one made.
    std::uint32_t user_of(std::uint32_t group) const {
        return graph_.clusters[graph_.groups[group].first_made].used_by;
    }
    // The levels say what their groups have by now, so that it is not that which is found.
    void tell_levels() {
        for (GraphLevel& level : graph_.levels) level.largest_error_m = 0.0;
        for (const ClusterGroup& group : graph_.groups) {
            double& largest_m = graph_.levels[group.level - 1].largest_error_m;
            largest_m = std::max(largest_m, group.error_m);
        }
    }
    // What drawing the file says; empty: nothing.
    std::string said(double tau_px = 0.5) {
        const auto written = write_cluster_graph(path_, graph_, test::posts_of(terrain_), 7, true);
        if (!written.ok()) return "not written: " + written.error().line();
        auto file = ClusterFile::open(path_);
        if (!file.ok()) return file.error().line();
        auto region =
            clusters_of_file(std::make_shared<ClusterFile>(std::move(*file)), 7, terrain_.field, occluder_);
        if (!region.ok()) return region.error().line();
        Camera camera;
        camera.width_px = camera.height_px = 400;
        camera.eye = {46.95, 8.05, 20000.0};
        camera.attitude.pitch_deg = -90.0;
        const auto choice =
            choose_clusters(**region, camera, {0, 0, 400, 400, {0.5, 0.5}}, tau_px, {}, occluder_, {});
        return choice.ok() ? "" : choice.error().line();
    }
    void expect_said(const std::string& words) {
        const std::string line = said();
        EXPECT_NE(line.find(words), std::string::npos) << "found: " << line;
        EXPECT_NE(line.find("a.oroc: is damaged at byte "), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
    static std::string group(std::uint32_t number) { return "group " + std::to_string(number); }
};

TEST_F(LyingGroups, WithNoLieAreDrawn) {
    for (const double tau_px : {0.01, 0.5, 4.0, 1000.0}) EXPECT_EQ(said(tau_px), "") << tau_px;
}

// The record alone, and with the level that tells of it.
TEST_F(LyingGroups, ARootWithoutError) {
    graph_.groups[root()].error_m = 0.0;
    expect_said("level " + std::to_string(graph_.levels.size()) + " says ");
    expect_said(" m, but its groups have ");
    tell_levels();
    expect_said(group(root()) + " has error 0 m, but one below it has ");
}

TEST_F(LyingGroups, AnErrorAboveThatOfItsUser) {
    const std::uint32_t below = first_of(2), user = user_of(below);
    graph_.groups[below].error_m = graph_.groups[user].error_m * 1.001;
    tell_levels();
    expect_said(group(user) + " has error ");
    expect_said(" m, but one below it has ");
}

TEST_F(LyingGroups, ErrorsOfEverySeventhGroupGone) {
    for (std::uint32_t i = first_of(2); i < graph_.groups.size(); i += 7) graph_.groups[i].error_m = 0.0;
    tell_levels();
    expect_said(" has error 0 m, but one below it has ");
}

TEST_F(LyingGroups, ASphereThatIsNotWithinThatOfItsUser) {
    const std::uint32_t below = first_of(2), user = user_of(below);
    graph_.groups[below].radius_m = graph_.groups[user].radius_m + 1.0;
    expect_said(group(user) + " has a sphere of ");
    expect_said(" m, but what it holds reaches ");
}

// Of any level, where its leaves or what it made lie outside.
TEST_F(LyingGroups, SpheresThatAreTooSmall) {
    for (std::uint32_t level = 1; level <= graph_.levels.size(); ++level) {
        ClusterGroup& lies = graph_.groups[first_of(level)];
        const double right_m = lies.radius_m;
        lies.radius_m = 0.5 * right_m;
        expect_said("sphere");
        lies.radius_m = right_m;
    }
}

// Nobody reads a group that is out of view: what is drawn in its stead, or above it, tells of it.
TEST_F(LyingGroups, SpheresThatHideTheirGroups) {
    for (ClusterGroup& group : graph_.groups) group.radius_m = 0.0;
    graph_.groups[root()].centre.m += glm::dvec3(1.0e6);
    expect_said(group(root()) + " has a sphere of 0 m, but what it holds reaches ");
    graph_.groups = terrain_.graph.groups;
    for (ClusterGroup& group : graph_.groups)
        if (group.level == 1) group.radius_m = 0.0;
    expect_said(", which no sphere of a group below it holds");
}

TEST_F(LyingGroups, GroupsThatUseWhatIsFarBelow) {
    const ClusterGroup& lies = graph_.groups[root()];
    const std::uint32_t below = graph_.groups[0].first_made;
    graph_.members[lies.first_member] = below;
    expect_said(group(root()) + " uses cluster " + std::to_string(below) + " of level 1, expected level " +
                std::to_string(graph_.levels.size() - 1));
}

// A thread that loads while frames are drawn says the same.
TEST_F(LyingGroups, AreNotLoaded) {
    graph_.groups[first_of(2)].error_m = 0.0;
    const auto region = clusters_of_graph(graph_, terrain_.field, occluder_);
    ASSERT_TRUE(region.ok()) << region.error().line();
    EXPECT_TRUE((*region)->load_group(0).ok());
    const auto loaded = (*region)->load_group(first_of(2));
    ASSERT_FALSE(loaded.ok());
    EXPECT_NE(loaded.error().line().find("clusters: have group " + std::to_string(first_of(2)) +
                                         ", which has error 0 m, but one below it has "),
              std::string::npos)
        << loaded.error().line();
}

}  // namespace
}  // namespace oro

// Graphs that grow in windows of groups and in scratch files: the same as any, in memory that does not grow.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/scratch_memory.h"
#include "core/mesh_graph/mesh_graph.h"
#include "tests/support/made_space_meshes.h"
#include "tests/support/mesh_cuts.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

const glm::dvec3 windows_origin_m{4.0e6, 6.0e5, 4.9e6};

MeshGraph graph_in_windows(const SpaceMesh& mesh, const MeshGraphOptions& options) {
    return build_mesh_graph(mesh.vertices, mesh.triangles, windows_origin_m, options);
}

void expect_same(const MeshGraph& one, const MeshGraph& other) {
    ASSERT_EQ(one.clusters.triangles, other.clusters.triangles);
    ASSERT_EQ(one.original_of, other.original_of);
    ASSERT_EQ(one.clusters.members, other.clusters.members);
    ASSERT_EQ(one.clusters.clusters.size(), other.clusters.clusters.size());
    ASSERT_EQ(one.clusters.levels.size(), other.clusters.levels.size());
    for (std::size_t i = 0; i < one.clusters.levels.size(); ++i) {
        EXPECT_EQ(one.clusters.levels[i].stuck_groups, other.clusters.levels[i].stuck_groups);
        EXPECT_EQ(one.clusters.levels[i].largest_group, other.clusters.levels[i].largest_group);
    }
    ASSERT_EQ(one.clusters.groups.size(), other.clusters.groups.size());
    for (std::size_t i = 0; i < one.clusters.groups.size(); ++i) {
        EXPECT_EQ(one.clusters.groups[i].error_m, other.clusters.groups[i].error_m);
        EXPECT_EQ(one.clusters.groups[i].radius_m, other.clusters.groups[i].radius_m);
        EXPECT_EQ(one.clusters.groups[i].centre.m, other.clusters.groups[i].centre.m);
    }
}

// All groups at once, in memory; one at a time, and three, in files.
void expect_same_by_windows(const SpaceMesh& mesh, const MeshGround* ground) {
    MeshGraphOptions all{2};
    all.ground = ground, all.window_groups = mesh.triangles.size();
    const MeshGraph whole = graph_in_windows(mesh, all);
    for (const auto& [groups, threads] : {std::pair{std::size_t{1}, 3}, std::pair{std::size_t{3}, 1}}) {
        ScratchMemory scratch(scratch_folder().string());
        MeshGraphOptions options{threads};
        options.ground = ground, options.window_groups = groups, options.scratch = &scratch;
        expect_same(graph_in_windows(mesh, options), whole);
        EXPECT_GT(scratch.bytes().most_in_files, 0U);
        EXPECT_EQ(scratch.bytes().in_files, 0U);
        EXPECT_EQ(scratch.bytes().in_memory, 0U);
    }
}

TEST(MeshWindows, GiveTheSameGraphOfAFoldedSheet) {
    expect_same_by_windows(folded_sheet(30), nullptr);
}

TEST(MeshWindows, GiveTheSameGraphOfABall) {
    expect_same_by_windows(hilly_ball(32, 50.0), nullptr);
}

TEST(MeshWindows, GiveTheSameGraphOfATownOnTheGround) {
    const MeshGround ground = hills_below_town(14);
    expect_same_by_windows(box_town(14), &ground);
}

TEST(MeshWindows, GiveTheSamePlacesToTheSameGroups) {
    std::mt19937_64 random(5241);
    const SpaceMesh mesh = hilly_ball(30, 50.0);
    MeshPlaceChains whole, in_windows;
    whole.places = random_places(mesh, random), in_windows.places = whole.places;
    const MeshGraph one = graph_in_windows(mesh, {2, 0.65, &whole});
    ScratchMemory scratch(scratch_folder().string());
    MeshGraphOptions options{2, 0.65, &in_windows};
    options.window_groups = 2, options.scratch = &scratch;
    expect_same(graph_in_windows(mesh, options), one);
    EXPECT_EQ(in_windows.groups, whole.groups);
}

// A window of one group has no more in memory of four times the triangles; all groups at once have.
TEST(MeshWindows, HaveNoMoreInMemoryOfALargerMesh) {
    // What a group of 1,152 triangles leaves, with all the samples that a triangle may have.
    constexpr std::size_t most_of_group = 1152 * (72 + 24 * 24);
    std::array<std::size_t, 2> in_windows{}, at_once{}, in_files{};
    for (std::size_t i = 0; i < 2; ++i) {
        const SpaceMesh mesh = hilly_ball(i == 0 ? 25 : 50, 50.0);
        ASSERT_EQ(mesh.triangles.size(), i == 0 ? 2400U : 9800U);
        ScratchMemory scratch(scratch_folder().string());
        MeshGraphOptions options{2};
        options.most_window_bytes = &at_once[i], options.window_groups = mesh.triangles.size();
        const MeshGraph whole = graph_in_windows(mesh, options);
        options.most_window_bytes = &in_windows[i], options.window_groups = 1;
        options.scratch = &scratch;
        expect_same(graph_in_windows(mesh, options), whole);
        in_files[i] = scratch.bytes().most_in_files / mesh.triangles.size();
        // Arrays of less than 64 KiB: those of small meshes, and of groups.
        EXPECT_LT(scratch.bytes().most_in_memory, 3'000'000U);
    }
    std::printf("windows %zu and %zu bytes, at once %zu and %zu, in files %zu and %zu a triangle\n",
                in_windows[0], in_windows[1], at_once[0], at_once[1], in_files[0], in_files[1]);
    EXPECT_LE(in_windows[1], most_of_group);
    EXPECT_GE(at_once[1], 3 * at_once[0]);
    EXPECT_GE(at_once[1], 2 * in_windows[1]);
    EXPECT_LE(in_files[1], 900U);
}

TEST(MeshWindows, WithoutAFolderForScratchFilesAreToldSo) {
    const SpaceMesh mesh = hilly_ball(25, 50.0);
    ScratchMemory scratch("/nowhere/at/all");
    MeshGraphOptions options{2};
    options.scratch = &scratch;
    EXPECT_THROW(graph_in_windows(mesh, options), std::bad_alloc);
    ASSERT_TRUE(scratch.error().has_value());
    // The tree's 600 blocks of four triangles, of 768 bytes: what is smaller lies in memory.
    EXPECT_EQ(scratch.error()->line(),
              "/nowhere/at/all: no room for a scratch file of 460800 bytes: No such file or directory");
}

}  // namespace
}  // namespace oro

// Meshes of a window's eye: chosen beside its frames, and drawn once all of them is on the GPU.
#include "apps/window/eye_meshes.h"

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "apps/drawing/mesh_cut.h"
#include "tests/geo/together/made_placed_mesh.h"
#include "tests/support/drawn/region_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

class EyesMeshes : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        region_ = test::region_with(test::ball_of_two_features());
        region_.grids[0].field =
            test::made_field(47.005, 8.49, 1200.0, 24, 24, [](double, double) { return 500.0F; });
        const auto cuts = cut_regions(region_);
        ASSERT_TRUE(cuts.ok()) << cuts.error().line();
        cuts_ = *cuts;
        view_.camera = eye_at(700.0);
        view_.tau_px = 1.0;
        view_.mesh = "clusters";
        meshes_.detail = std::make_shared<const MeshDetail>(MeshDetail::of(region_, 1.0, 2));
        EXPECT_TRUE(choose_cut(meshes_, view_, {}, view_.camera).value());
        SceneRequest request;
        request.meshes = meshes_.cut.meshes;
        auto scene = test::create_scene(*gpu_, region_, request);
        ASSERT_TRUE(scene.ok()) << scene.error().line();
        scene_ = std::make_unique<Scene>(std::move(*scene));
    }
    void TearDown() override {
        scene_.reset();
        meshes_ = {};
        GpuTest::TearDown();
    }
    // South of the ball, level with it.
    static Camera eye_at(double distance_m) {
        Camera camera;
        camera.eye = {47.0 - distance_m / 111200.0, 8.5, 830.0};
        camera.attitude = {0.0, -2.0, 0.0};
        camera.vertical_fov_deg = 20.0, camera.width_px = 400, camera.height_px = 300;
        return camera;
    }
    MeshTarget target() { return {region_, cuts_, view_, memory_, *gpu_, *scene_}; }
    // Until all is on the GPU, or what is drawn is what is needed; true for the first.
    bool follow(const Camera& camera) {
        for (int turn = 0; turn < 6000; ++turn) {
            const auto is_here = follow_with_meshes(meshes_, target(), camera, false);
            EXPECT_TRUE(is_here.ok()) << is_here.error().line();
            if (!is_here.ok() || *is_here) return is_here.ok();
            if (are_chosen_for(meshes_, view_, camera)) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        ADD_FAILURE() << "not within 30 s";
        return false;
    }
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> expected(const Camera& camera) const {
        return mesh_cut_of(*meshes_.detail, mesh_asked_by(view_, {}), std::span(&camera, 1)).value().clusters;
    }
    // A frame by the scene as it is lacks nothing of the mesh, and draws as many of its triangles.
    void expect_whole(const Camera& camera) {
        ASSERT_EQ(scene_->grids().size(), 2U);
        EXPECT_EQ(scene_->grids()[1].pages().facts().triangles, meshes_.cut.triangles);
        const auto plan = scene_->plan({camera, {0, 0, 400, 300, {0.5, 0.5}}, view_.tau_px});
        ASSERT_TRUE(plan.ok()) << plan.error().line();
        EXPECT_TRUE(plan->grids[1].missing.empty());
        EXPECT_EQ(plan->grids[1].pages.size(), scene_->grids()[1].pages().layout(0).count());
    }

    Region region_;
    RegionCuts cuts_;
    View view_;
    MemoryOptions memory_;
    EyeMeshes meshes_;
    std::unique_ptr<Scene> scene_;
};

TEST_F(EyesMeshes, AreDrawnOnceAllOfThemIsOnTheGpu) {
    const std::uint64_t far = meshes_.cut.triangles;
    for (const double distance_m : {150.0, 3000.0, 90.0}) {
        const Camera camera = eye_at(distance_m);
        EXPECT_FALSE(are_chosen_for(meshes_, view_, camera));
        const auto before = meshes_.cut.meshes;
        ASSERT_TRUE(follow(camera));
        EXPECT_EQ(meshes_.cut.meshes, before) << "shown before it was taken";
        take_coming(meshes_, *scene_);
        EXPECT_TRUE(are_chosen_for(meshes_, view_, camera));
        EXPECT_EQ(meshes_.cut.clusters, expected(camera));
        expect_whole(camera);
    }
    EXPECT_GT(meshes_.cut.triangles, far);
}

TEST_F(EyesMeshes, WhatIsDrawnStaysWhereItIsWhatIsNeeded) {
    const Camera camera = eye_at(700.001);
    ASSERT_EQ(expected(camera), meshes_.cut.clusters);
    const auto before = meshes_.cut.meshes;
    EXPECT_FALSE(follow(camera));
    EXPECT_EQ(meshes_.cut.meshes, before);
    EXPECT_FALSE(meshes_.coming);
}

TEST_F(EyesMeshes, AreChosenHereWhereAPictureIsTaken) {
    const Camera flown = eye_at(90.0), camera = eye_at(200.0);
    const auto begun = follow_with_meshes(meshes_, target(), flown, true);
    ASSERT_TRUE(begun.ok() && !*begun);
    ASSERT_TRUE(meshes_.work);
    int waits = 0;
    const auto drawn = draw_cut_of(meshes_, target(), camera, [&]() -> Result<void> {
        ++waits;
        return {};
    });
    ASSERT_TRUE(drawn.ok()) << drawn.error().line();
    EXPECT_EQ(waits, 1);
    EXPECT_FALSE(meshes_.work);
    EXPECT_EQ(meshes_.cut.clusters, expected(camera));
    ASSERT_EQ(scene_->grids().size(), 2U);
    EXPECT_EQ(scene_->grids()[1].pages().facts().triangles, meshes_.cut.triangles);
}

// 16 MB: half of them, 100 bytes a triangle.
TEST_F(EyesMeshes, AreCoarserWhereMemoryHoldsNoMore) {
    memory_.gpu_memory_mb = 16;
    EXPECT_EQ(mesh_asked_by(view_, memory_).most_triangles, 80'000U);
    MeshAsked asked = mesh_asked_by(view_, {});
    EXPECT_EQ(asked.most_triangles, 0U);
    const Camera camera = eye_at(90.0);
    const MeshCut fine = mesh_cut_of(*meshes_.detail, asked, std::span(&camera, 1)).value();
    asked.most_triangles = fine.triangles / 2;
    const MeshCut coarse = mesh_cut_of(*meshes_.detail, asked, std::span(&camera, 1)).value();
    EXPECT_LE(coarse.triangles, asked.most_triangles);
    EXPECT_GT(coarse.triangles, 0U);
    EXPECT_GT(coarse.error_px, view_.tau_px);
    asked.level = 0;
    EXPECT_EQ(mesh_cut_of(*meshes_.detail, asked, std::span(&camera, 1)).value().triangles, fine.of_triangles);
}

// 12 bytes a triangle at least, until other meshes take their place.
TEST_F(EyesMeshes, CountInTheMemoryOfTheScene) {
    const auto& shared = scene_->grids()[0].shared_memory();
    ASSERT_TRUE(shared);
    const std::uint64_t left = shared->left();
    scene_->replace_between(std::nullopt);
    EXPECT_GE(shared->left(), left + 12 * meshes_.cut.triangles);
    EXPECT_EQ(shared->left(), shared->bytes());
}

// A choice that took ten seconds is not begun again at once while the eye moves.
TEST_F(EyesMeshes, ChoosingLeavesTimeForFramesOfAMovingEye) {
    meshes_.ended = Clock::now();
    meshes_.begun = meshes_.ended - std::chrono::seconds(10);
    const Camera camera = eye_at(90.0);
    ASSERT_TRUE(follow_with_meshes(meshes_, target(), camera, true).ok());
    EXPECT_FALSE(meshes_.work);
    ASSERT_TRUE(follow_with_meshes(meshes_, target(), camera, false).ok());
    EXPECT_TRUE(meshes_.work);
}

}  // namespace
}  // namespace oro

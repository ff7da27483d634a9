// Frames whose pages the device chooses: the triangles of the processor's plan, whatever is missing, and what
// is missing reported a frame late.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <utility>
#include <vector>

#include "render/pipelines/plan_pass.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int chosen_width_px = 96, chosen_height_px = 54;

// Flies on over the fields of the test, or begins anew.
class DriftingEye {
  public:
    explicit DriftingEye(std::uint64_t seed) : random_(seed) {}
    FrameView next() {
        if (count_++ % 8 == 0) {
            camera_.width_px = chosen_width_px;
            camera_.height_px = chosen_height_px;
            camera_.vertical_fov_deg = between(20.0, 70.0);
            camera_.eye = {between(46.8, 46.95), between(8.05, 8.3), 3500.0 * std::exp(between(0.0, 2.2))};
            camera_.attitude = {between(0.0, 360.0), between(-80.0, -15.0), between(-10.0, 10.0)};
            tau_px_ = std::exp(between(-1.5, 0.7));
        }
        const double step_deg = camera_.eye.h_m * between(0.0, 1.0e-6);
        camera_.eye.lat_deg += step_deg * between(-1.0, 1.0);
        camera_.eye.lon_deg += step_deg * between(-1.0, 1.0);
        camera_.eye.h_m *= 1.0 + between(-0.01, 0.01);
        camera_.attitude.heading_deg += between(-2.0, 2.0);
        return {camera_, test::whole_picture(camera_), tau_px_, {}};
    }

  private:
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    std::mt19937_64 random_;
    Camera camera_;
    double tau_px_{1.0};
    int count_{};
};

class DrawnChoice : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    // Grids side by side, each of so many posts.
    [[nodiscard]] test::DrawnScene scene_of(int grids, int rows, int columns) const {
        const auto pages_of_grid = [&](int grid) {
            const double west_deg = 8.0 + grid * (columns - 6) / 1200.0;
            return pages_in_memory(test::rough_field(47.0, west_deg, rows, columns), 1.0, 2);
        };
        test::DrawnScene scene(*gpu_, pages_of_grid(0), GetParam(), chosen_width_px, chosen_height_px);
        for (int grid = 1; grid < grids; ++grid) {
            auto other = Scene::create(*gpu_, pages_of_grid(grid), {std::uint64_t{64} << 20U, 0},
                                       test::asked_heights());
            EXPECT_TRUE(other.ok()) << other.error().line();
            scene.scene().add(std::move(other).value());
        }
        return scene;
    }
    // The processor's plan of what a scene has on the GPU.
    static FramePlan processors(Scene& scene, const FrameView& view, const FramePlan& like) {
        FramePlan plan{view, {}};
        for (std::size_t i = 0; i < scene.grids().size(); ++i) {
            GridScene& grid = scene.grids()[i];
            auto one = plan_grid(
                grid.pages(), [&](const PageIndex& page) { return grid.store().address(page); }, view,
                grid.store().coding());
            EXPECT_TRUE(one.ok()) << one.error().line();
            one->constants.undulation.N_m = like.grids[i].constants.undulation.N_m;
            one->request_feedback = like.grids[i].request_feedback;
            plan.grids.push_back(std::move(one).value());
        }
        return plan;
    }
    static std::vector<std::uint32_t> drawn(FrameRenderer& renderer, FramePlan plan, FrameReport& report) {
        auto made = renderer.draw(std::move(plan), {});
        EXPECT_TRUE(made.ok()) << made.error().line();
        report = std::move(made).value();
        auto ids = renderer.read_ids(chosen_width_px, chosen_height_px);
        EXPECT_TRUE(ids.ok()) << ids.error().line();
        return std::move(ids).value();
    }
    // Pages come while the eye moves.
    void expect_same(int grids, int rows, int columns, int eyes, std::uint64_t seed) {
        if (!PlanPass::can_run(*gpu_)) GTEST_SKIP() << "the device has no doubles";
        std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
        test::DrawnScene device = scene_of(grids, rows, columns);
        FrameRendererOptions options;
        options.extent = {chosen_width_px, chosen_height_px};
        options.path = GetParam();
        FrameRenderer processor = test::made_renderer(*gpu_, options);
        const auto set = device.scene().choose_on_device(*gpu_);
        ASSERT_TRUE(set.ok()) << set.error().line();
        ASSERT_TRUE(*set);
        DriftingEye eye(seed);
        std::size_t triangles = 0, missing = 0, whole = 0;
        for (int i = 0; i < eyes; ++i) {
            const FrameView view = eye.next();
            auto plan = device.scene().plan(view);
            ASSERT_TRUE(plan.ok()) << plan.error().line();
            for (const GridPlan& grid : plan->grids) ASSERT_TRUE(grid.device.chooses) << "eye " << i;
            const FramePlan expected = processors(device.scene(), view, *plan);
            FrameReport report, expected_report;
            const auto ids = drawn(device.renderer(), std::move(plan).value(), report);
            ASSERT_EQ(ids, drawn(processor, expected, expected_report)) << "eye " << i;
            ASSERT_EQ(report.pages, expected_report.pages);
            device.scene().apply_feedback(report.feedback);
            plan = device.scene().plan(view);
            ASSERT_TRUE(plan.ok()) << plan.error().line();
            for (std::size_t grid = 0; grid < expected.grids.size(); ++grid) {
                std::vector<PageIndex> reported = plan->grids[grid].missing,
                                       lacks = expected.grids[grid].missing;
                std::ranges::sort(reported);
                std::ranges::sort(lacks);
                ASSERT_EQ(reported, lacks) << "eye " << i;
                ASSERT_EQ(plan->grids[grid].pages_wanted, expected.grids[grid].pages_wanted);
                missing += lacks.size();
            }
            whole += expected.is_settled() ? 1 : 0;
            const auto better = device.scene().advance(NextPlan::anyway);
            ASSERT_TRUE(better.ok()) << better.error().line();
            triangles += report.counts.triangles_drawn;
        }
        std::printf("%d eyes, %zu pages missing, %zu frames whole, %zu triangles\n", eyes, missing, whole,
                    triangles);
        EXPECT_GT(triangles, static_cast<std::size_t>(eyes) * 10) << "or the eyes see nothing";
        EXPECT_GT(missing, 0U);
        EXPECT_GT(whole, 0U);
    }
};

TEST_P(DrawnChoice, HasTheTrianglesOfTheProcessorsPlan) {
    expect_same(2, 300, 240, 24, 71);
}

TEST_P(DrawnChoice, IsTheProcessorsWhereFramesAreWaitedFor) {
    if (!PlanPass::can_run(*gpu_)) GTEST_SKIP() << "the device has no doubles";
    test::DrawnScene device = scene_of(1, 300, 300), processor = scene_of(1, 300, 300);
    const auto set = device.scene().choose_on_device(*gpu_);
    ASSERT_TRUE(set.ok() && *set);
    DriftingEye eye(72);
    for (int i = 0; i < 10; ++i) {
        const FrameView view = eye.next();
        const test::DrawnFrame expected = processor.draw(view.camera, view.tau_px);
        const test::DrawnFrame frame = device.draw(view.camera, view.tau_px);
        ASSERT_TRUE(frame.plan.grids.front().device.chooses);
        ASSERT_EQ(frame.ids, expected.ids) << "eye " << i;
    }
}

// Of 12 pages, where frames want more: what gives way for what comes is told to the device.
TEST_P(DrawnChoice, IsGivenBackWhereMemoryIsFull) {
    if (!PlanPass::can_run(*gpu_)) GTEST_SKIP() << "the device has no doubles";
    test::DrawnScene device(*gpu_, pages_in_memory(test::rough_field(47.0, 8.0, 500, 500), 1.0, 2),
                            GetParam(), chosen_width_px, chosen_height_px, 12 * page_bytes({}));
    FrameRendererOptions options;
    options.extent = {chosen_width_px, chosen_height_px};
    options.path = GetParam();
    FrameRenderer renderer = test::made_renderer(*gpu_, options);
    const auto set = device.scene().choose_on_device(*gpu_);
    ASSERT_TRUE(set.ok() && *set);
    DriftingEye eye(73);
    int by_device = 0, by_processor = 0;
    for (int i = 0; i < 32; ++i) {
        const FrameView view = eye.next();
        auto plan = device.scene().plan(view);
        ASSERT_TRUE(plan.ok()) << plan.error().line();
        ++(plan->grids.front().device.chooses ? by_device : by_processor);
        FramePlan expected = processors(device.scene(), view, *plan);
        FrameReport report, expected_report;
        const auto ids = drawn(device.renderer(), std::move(plan).value(), report);
        ASSERT_EQ(ids, drawn(renderer, std::move(expected), expected_report)) << "eye " << i;
        device.scene().apply_feedback(report.feedback);
        const auto better = device.scene().advance(NextPlan::anyway);
        ASSERT_TRUE(better.ok()) << better.error().line();
    }
    std::printf("%d plans by the device, %d by the processor\n", by_device, by_processor);
    EXPECT_GT(by_device, 2);
    EXPECT_GT(by_processor, 2);
}

// In tests/long.cmake.
class DrawnChoiceLong : public DrawnChoice {};
TEST_P(DrawnChoiceLong, HasTheTrianglesOfTheProcessorsPlanAt150Eyes) {
    expect_same(1, 700, 900, 90, 7100);
    expect_same(2, 700, 450, 60, 7101);
}

INSTANTIATE_TEST_SUITE_P(Paths, DrawnChoice, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });
INSTANTIATE_TEST_SUITE_P(Paths, DrawnChoiceLong, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });

}  // namespace
}  // namespace oro

// What a plan leaves to the device: the same bits as the processor makes, and the same triangle ids, of eyes
// in motion.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include "render/pipelines/plan_pass.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int planned_width_px = 96, planned_height_px = 54;

// An eye that flies on from place to place over the field of the test, or begins anew.
class FlyingEye {
  public:
    explicit FlyingEye(std::uint64_t seed) : random_(seed) {}
    Camera next() {
        if (count_++ % 5 == 0) {
            camera_.width_px = planned_width_px;
            camera_.height_px = planned_height_px;
            camera_.vertical_fov_deg = between(20.0, 70.0);
            camera_.eye = {between(46.8, 46.95), between(8.05, 8.3), 3500.0 * std::exp(between(0.0, 2.2))};
            // On a meridian of posts, or so near it that the series of a sine does not tell its float.
            camera_.eye.lon_deg = std::round(camera_.eye.lon_deg * 1200.0) / 1200.0 + count_ * 1.0e-11;
            camera_.attitude = {between(0.0, 360.0), between(-80.0, -15.0), between(-10.0, 10.0)};
        }
        const double step_deg = camera_.eye.h_m * between(0.0, 1.0e-6);
        camera_.eye.lat_deg += step_deg * between(-1.0, 1.0);
        camera_.eye.lon_deg += step_deg * between(-1.0, 1.0);
        camera_.eye.h_m += camera_.eye.h_m * between(-0.01, 0.01);
        camera_.attitude.heading_deg += between(-2.0, 2.0);
        return camera_;
    }

  private:
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    std::mt19937_64 random_;
    Camera camera_;
    int count_{};
};

// Words of what lies in memory one after the other.
template <class Value>
std::vector<std::uint32_t> words_of(const std::vector<Value>& values) {
    std::vector<std::uint32_t> words(values.size() * sizeof(Value) / sizeof(std::uint32_t));
    if (!words.empty()) std::memcpy(words.data(), values.data(), words.size() * sizeof(std::uint32_t));
    return words;
}
// Where blocks lie is each store's own.
std::vector<std::uint32_t> words_of_pages(std::vector<gpu::FramePage> pages) {
    for (gpu::FramePage& page : pages) page.block = page.means = page.places = gpu::uvec2(0U);
    return words_of(pages);
}
std::vector<gpu::FramePage> pages_of(const std::vector<std::uint32_t>& words) {
    std::vector<gpu::FramePage> pages(words.size() * sizeof(std::uint32_t) / sizeof(gpu::FramePage));
    if (!pages.empty()) std::memcpy(pages.data(), words.data(), words.size() * sizeof(std::uint32_t));
    return pages;
}

class PlanOnDevice : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    // Grids side by side, each of so many posts.
    struct Grids {
        int count, rows, columns;
    };
    [[nodiscard]] test::DrawnScene scene_of(const Grids& grids) const {
        const auto pages_of_grid = [&](int grid) {
            const double west_deg = 8.0 + grid * (grids.columns - 6) / 1200.0;
            return pages_in_memory(test::rough_field(47.0, west_deg, grids.rows, grids.columns), 1.0, 2);
        };
        test::DrawnScene scene(*gpu_, pages_of_grid(0), GetParam(), planned_width_px, planned_height_px);
        for (int grid = 1; grid < grids.count; ++grid) {
            auto other = Scene::create(*gpu_, pages_of_grid(grid), {std::uint64_t{64} << 20U, 0},
                                       test::asked_heights());
            EXPECT_TRUE(other.ok()) << other.error().line();
            scene.scene().add(std::move(other).value());
        }
        return scene;
    }
    static void expect_same_bits(FrameRenderer& renderer, const FramePlan& expected, int eye) {
        for (std::size_t grid = 0; grid < expected.grids.size(); ++grid) {
            const GridPlan& plan = expected.grids[grid];
            const auto words = renderer.read_plan(grid);
            ASSERT_TRUE(words.ok()) << words.error().line();
            ASSERT_EQ(words->rows, words_of(plan.row_terms)) << "eye " << eye;
            ASSERT_EQ(words->columns, words_of(plan.column_terms)) << "eye " << eye;
            ASSERT_EQ(words_of_pages(pages_of(words->pages)), words_of_pages(plan.pages)) << "eye " << eye;
        }
    }
    void expect_same(const Grids& grids, int eyes, std::uint64_t seed) {
        if (!PlanPass::can_run(*gpu_)) GTEST_SKIP() << "the device has no doubles";
        std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
        test::DrawnScene processor = scene_of(grids), device = scene_of(grids);
        const auto set = device.scene().plan_on_device(*gpu_);
        ASSERT_TRUE(set.ok()) << set.error().line();
        ASSERT_TRUE(*set);
        FlyingEye eye(seed);
        std::size_t drawn = 0;
        for (int i = 0; i < eyes; ++i) {
            const Camera camera = eye.next();
            const test::DrawnFrame expected = processor.draw(camera, 1.0);
            const test::DrawnFrame frame = device.draw(camera, 1.0);
            for (const GridPlan& plan : frame.plan.grids) {
                ASSERT_TRUE(plan.device.on);
                ASSERT_TRUE(plan.row_terms.empty());
            }
            ASSERT_EQ(frame.ids, expected.ids) << "eye " << i;
            expect_same_bits(device.renderer(), expected.plan, i);
            if (HasFatalFailure()) return;
            drawn += frame.report.counts.triangles_drawn;
        }
        EXPECT_GT(drawn, static_cast<std::size_t>(eyes) * 10) << "or the eyes see nothing";
    }
};

TEST_P(PlanOnDevice, HasTheBitsOfTheProcessors) {
    expect_same({2, 300, 240}, 10, 51);
}

// In tests/long.cmake.
class PlanOnDeviceLong : public PlanOnDevice {};
TEST_P(PlanOnDeviceLong, HasTheIdsOfTheProcessorsAt700Eyes) {
    expect_same({1, 700, 900}, 500, 5100);
    expect_same({2, 700, 450}, 200, 5101);
}

INSTANTIATE_TEST_SUITE_P(Paths, PlanOnDevice, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });
INSTANTIATE_TEST_SUITE_P(Paths, PlanOnDeviceLong, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });

}  // namespace
}  // namespace oro

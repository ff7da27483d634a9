// The ways of drawing grass show the same blades.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "render/grass/blade_rule.h"
#include "render/grass/grass_renderer.h"
#include "tests/support/gpu_fixture.h"

namespace oro {
namespace {

constexpr std::uint32_t grass_test_width_px = 180, grass_test_height_px = 140;
constexpr float full_detail_m = std::numeric_limits<float>::infinity();

// A field in miniature: an eye 40 m above its ground sees nothing else.
class GrassPictures : public test::GpuTest {
  protected:
    void SetUp() override {
        test::GpuTest::SetUp();
        auto made = GrassRenderer::create(*gpu_, field_, grass_test_width_px, grass_test_height_px);
        ASSERT_TRUE(made.ok()) << made.error().line();
        renderer_.emplace(std::move(made).value());
    }
    static GrassRequest straight_down(float switch_m) {
        GrassRequest request;
        request.view = grass_view_down(66.0F, grass_test_width_px, grass_test_height_px);
        request.switch_m = switch_m;
        return request;
    }
    // Ids of the pixels of a frame; report_ is of it.
    std::vector<std::uint32_t> drawn(GrassWay way, const GrassRequest& request) {
        auto frame = renderer_->draw(way, request);
        EXPECT_TRUE(frame.ok()) << (frame.ok() ? "" : frame.error().line());
        if (!frame.ok()) return {};
        report_ = *frame;
        auto read = renderer_->blades();
        EXPECT_TRUE(read.ok()) << (read.ok() ? "" : read.error().line());
        return read.ok() ? std::move(read).value() : std::vector<std::uint32_t>{};
    }
    bool can(GrassWay way) const { return renderer_->check(way).ok(); }

    const gpu::GrassField field_{1800, 50, 36, 0.9F};
    std::optional<GrassRenderer> renderer_;
    GrassFrameReport report_;
};

std::size_t pixels_that_differ(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
}

std::set<std::uint32_t> blades_in(const std::vector<std::uint32_t>& pixels) {
    return {pixels.begin(), pixels.end()};
}

// Vertices come from one rule, so that pipelines of the device rasterise the same triangles: every pixel
// shows the same blade. The compute way has its own grid of 1/256 px, where a device may have another.
TEST_F(GrassPictures, ShowTheSameBladesAtFullDetail) {
    const std::vector<std::uint32_t> by_vertex = drawn(GrassWay::vertex, straight_down(full_detail_m));
    EXPECT_GT(blades_in(by_vertex).size(), 1500U);
    EXPECT_LT(blades_in(by_vertex).size(), 7202U);
    EXPECT_EQ(report_.blades_far, 0U);
    for (const GrassWay way : {GrassWay::clumps, GrassWay::packed, GrassWay::compute}) {
        if (!can(way)) continue;
        const std::vector<std::uint32_t> pixels = drawn(way, straight_down(full_detail_m));
        const std::size_t most = way == GrassWay::compute ? pixels.size() / 500 : pixels.size() / 5000;
        EXPECT_LE(pixels_that_differ(pixels, by_vertex), most) << name_of(way);
    }
}

// Levels between: both mesh ways and compute draw the same numbers of vertices.
TEST_F(GrassPictures, ShowTheSameBladesWithFewerVertices) {
    if (!can(GrassWay::clumps) || !can(GrassWay::compute))
        GTEST_SKIP() << "no mesh shaders, or no 64-bit atomics";
    const GrassRequest request = straight_down(60.0F);
    const std::vector<std::uint32_t> by_clumps = drawn(GrassWay::clumps, request);
    EXPECT_LE(pixels_that_differ(drawn(GrassWay::packed, request), by_clumps), by_clumps.size() / 5000);
    EXPECT_LE(pixels_that_differ(drawn(GrassWay::compute, request), by_clumps), by_clumps.size() / 500);
}

TEST_F(GrassPictures, MeshWorkgroupsAreAsFewAsTold) {
    if (!can(GrassWay::packed)) GTEST_SKIP() << "no mesh shaders";
    drawn(GrassWay::clumps, straight_down(full_detail_m));
    EXPECT_EQ(report_.blades_near, 7200U);
    EXPECT_EQ(report_.mesh_groups, 1800U);
    // Four blades of 32 vertices a workgroup.
    drawn(GrassWay::packed, straight_down(full_detail_m));
    EXPECT_EQ(report_.mesh_groups, 1800U);
    // 21 blades of 6: each task workgroup has 128 clumps, the last one 8.
    drawn(GrassWay::packed, straight_down(1.0F));
    EXPECT_EQ(report_.blades_far, 7200U);
    EXPECT_EQ(report_.mesh_groups, 14U * 25U + 2U);
}

// What boxes leave out shows nowhere.
TEST_F(GrassPictures, BoxesLeaveOutNothingThatShows) {
    GrassRequest request = straight_down(full_detail_m);
    request.view.eye = {-9.0F, 3.0F, 36.0F};
    request.view.forward = {0.8F, 0.0F, -0.6F};
    request.view.right = {0.0F, -1.0F, 0.0F};
    request.view.up = {0.6F, 0.0F, 0.8F};
    for (const bool thins : {false, true}) {
        request.thins = thins;
        request.by_boxes = false;
        const std::vector<std::uint32_t> all = drawn(GrassWay::vertex, request);
        const std::uint32_t blades = report_.blades_near;
        request.by_boxes = true;
        const std::vector<std::uint32_t> boxed = drawn(GrassWay::vertex, request);
        EXPECT_LT(report_.blades_near, blades);
        EXPECT_LE(pixels_that_differ(boxed, all), all.size() / 5000);
    }
}

TEST_F(GrassPictures, ThinningDrawsFewerBlades) {
    GrassRequest request = straight_down(full_detail_m);
    request.view.eye.z = 226.0F;  // a blade is a tenth of a pixel wide
    drawn(GrassWay::vertex, request);
    EXPECT_EQ(report_.blades_near, 7200U);
    request.thins = true;
    const std::vector<std::uint32_t> by_vertex = drawn(GrassWay::vertex, request);
    EXPECT_LT(report_.blades_near, 1000U);
    EXPECT_GT(report_.blades_near, 500U);
    for (const GrassWay way : {GrassWay::clumps, GrassWay::packed, GrassWay::compute}) {
        if (can(way)) {
            const std::vector<std::uint32_t> pixels = drawn(way, request);
            EXPECT_LE(pixels_that_differ(pixels, by_vertex), pixels.size() / 500) << name_of(way);
        }
    }
}

// The same time gives the same picture, another time another one.
TEST_F(GrassPictures, WindIsOfTheTimeAlone) {
    GrassRequest request = straight_down(full_detail_m);
    const std::vector<std::uint32_t> still = drawn(GrassWay::vertex, request);
    request.wind_time_s = 4.0F;
    const std::vector<std::uint32_t> windy = drawn(GrassWay::vertex, request);
    EXPECT_GT(pixels_that_differ(windy, still), still.size() / 20);
    EXPECT_LE(pixels_that_differ(drawn(GrassWay::vertex, request), windy), still.size() / 5000);
    request.wind_time_s = 5.0F;
    EXPECT_GT(pixels_that_differ(drawn(GrassWay::vertex, request), windy), still.size() / 20);
}

}  // namespace
}  // namespace oro

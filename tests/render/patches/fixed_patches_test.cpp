// Must hold: patches of fixed size show the same posts by all ways, with heights of this frame or kept ones,
// and where borders are shared no gap; where they are not, there are gaps.
#include "render/patches/fixed_patches.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "tests/support/gpu_fixture.h"
#include "tests/support/made_posts.h"

namespace oro {
namespace {

constexpr int patches_width_px = 200, patches_height_px = 150;
constexpr int patches_a_side = 24;

MadeTerrain patches_terrain() {
    MadeTerrain made = test::made_example(MadeKind::fbm);
    made.posts_per_deg = 1200;
    made.west = 8 * 1200;
    made.south = 46 * 1200;
    made.east = made.west + 8 * patches_a_side;
    made.north = made.south + 8 * patches_a_side;
    made.cell_shift = 18;
    made.low = 0;
    made.high = 1500 * 2048;
    return made;
}

// Looks down into the square, so that ground is behind every pixel.
Camera eye_over_patches(double lat_deg, double lon_deg, double h_m, double heading_deg) {
    Camera camera;
    camera.width_px = patches_width_px;
    camera.height_px = patches_height_px;
    camera.vertical_fov_deg = 30.0;
    camera.eye = {lat_deg, lon_deg, h_m};
    camera.attitude = {heading_deg, -50.0, 0.0};
    return camera;
}
const Camera middle_eye = eye_over_patches(46.07, 8.08, 3200.0, 0.0);

std::size_t different(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    std::size_t count = a.size() == b.size() ? 0 : a.size() + b.size();
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
}

class FixedPatchesOnGpu : public test::GpuTest {
  protected:
    void SetUp() override {
        test::GpuTest::SetUp();
        auto made = FixedPatches::create(*gpu_, patches_terrain(), patches_width_px, patches_height_px);
        ASSERT_TRUE(made.ok()) << made.error().line();
        patches_.emplace(std::move(made).value());
    }
    std::vector<std::uint32_t> drawn(PatchWay way, const PatchRequest& request) {
        const auto report = patches_->draw(way, request);
        EXPECT_TRUE(report.ok()) << (report.ok() ? "" : report.error().line());
        auto ids = patches_->ids();
        EXPECT_TRUE(ids.ok()) << (ids.ok() ? "" : ids.error().line());
        return ids.ok() ? std::move(ids).value() : std::vector<std::uint32_t>{};
    }
    static std::size_t background(const std::vector<std::uint32_t>& ids) {
        std::size_t count = 0;
        for (const std::uint32_t id : ids) count += id == 0 ? 1 : 0;
        return count;
    }
    std::optional<FixedPatches> patches_;
};

TEST_F(FixedPatchesOnGpu, HaveThePostsOfTheProcessorAndKeepThem) {
    for (const PatchWay way : patch_ways) {
        if (!patches_->check(way).ok()) continue;
        const auto made = drawn(way, {middle_eye, 3U, PatchBorders::open, true});
        const auto kept = drawn(way, {middle_eye, 3U, PatchBorders::open, false});
        EXPECT_EQ(different(made, kept), 0U) << name_of(way);
        EXPECT_EQ(background(made), 0U) << name_of(way);
        const auto heights = patches_->heights();
        ASSERT_TRUE(heights.ok());
        EXPECT_EQ(*heights, test::heights_of(patches_terrain())) << name_of(way);
    }
}

// The mesh ways are the same arithmetic and the same rasterizer; compute snaps to the same grid of 1/256 px,
// but depths of a pixel may round otherwise: on edges of silhouettes alone.
TEST_F(FixedPatchesOnGpu, ShowTheSameTrianglesByAllWays) {
    const PatchRequest request{middle_eye, {}, PatchBorders::shared, true};
    std::vector<std::uint32_t> first;
    for (const PatchWay way : patch_ways) {
        if (!patches_->check(way).ok()) continue;
        const auto ids = drawn(way, request);
        if (first.empty()) first = ids;
        EXPECT_LE(different(first, ids), 10U) << name_of(way);
    }
}

TEST_F(FixedPatchesOnGpu, HaveNoGapWhereBordersAreShared) {
    constexpr std::uint32_t seed = 20261129;
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::size_t shared = 0, open = 0, of_all_levels = 0;
    for (int eye = 0; eye < 8; ++eye) {
        const Camera camera = eye_over_patches(between(46.07, 46.09), between(8.07, 8.09),
                                               between(2800, 3200), between(0, 360));
        for (const PatchWay way : {PatchWay::mesh, PatchWay::compute}) {
            if (!patches_->check(way).ok()) continue;
            shared += background(drawn(way, {camera, {}, PatchBorders::shared, eye == 0}));
            open += background(drawn(way, {camera, {}, PatchBorders::open, false}));
        }
        const auto levels = patches_->patches_of_levels();
        ASSERT_TRUE(levels.ok());
        std::uint32_t least = patches_a_side * patches_a_side;
        for (const std::uint32_t count : *levels) least = std::min(least, count);
        of_all_levels += least > 0 ? 1 : 0;
    }
    EXPECT_EQ(shared, 0U) << "seed " << seed;
    EXPECT_GT(open, 0U) << "the check would see a gap, seed " << seed;
    EXPECT_EQ(of_all_levels, 8U) << "each eye has patches of all levels";
}

}  // namespace
}  // namespace oro

// Depths beside colours: the same in tiles as in one piece, and where the samples say.
#include "render/frame/depth_picture.h"

#include <algorithm>
#include <cmath>

#include "core/terrain/ground.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

class DepthPictures : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    const HeightField field = test::rough_field(47.0, 8.0, 300, 300);
    std::optional<Scene> scene;

    void SetUp() override {
        GpuTest::SetUp();
        if (!gpu_) return;
        auto made = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2));
        ASSERT_TRUE(made.ok()) << made.error().line();
        scene.emplace(std::move(made).value());
    }

    // Over the region's middle, the horizon in the picture.
    Camera camera() const {
        Camera camera;
        camera.eye = {46.875, 8.125, ground_h_m(field, 46.875, 8.125).value_or(0.0) + 400.0};
        camera.attitude = {30.0, -2.0, 0.0};
        camera.width_px = 150;
        camera.height_px = 100;
        return camera;
    }
    DepthPicture draw(DepthPainter& painter, const DepthPictureOptions& options) {
        auto picture = painter.draw(*scene, camera(), {}, options);
        EXPECT_TRUE(picture.ok()) << picture.error().line();
        return picture.ok() ? std::move(picture).value() : DepthPicture{};
    }
};

TEST_P(DepthPictures, InTilesAreTheSame) {
    DepthPainter painter(*gpu_, GetParam());
    DepthPictureOptions options;
    const DepthPicture whole = draw(painter, options);
    options.largest_tile_px = 64;
    const DepthPicture tiled = draw(painter, options);
    EXPECT_EQ(whole.tiles, 1);
    EXPECT_EQ(tiled.tiles, 3 * 2) << "150 x 100 in tiles of 64";
    ASSERT_EQ(whole.depths.size(), 15000U);
    ASSERT_EQ(tiled.depths.size(), 15000U);
    // A tile's own projection rounds differently: pixels on edges may see the next triangle.
    const auto differing = [](const std::vector<float>& a, const std::vector<float>& b) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > 1e-4F * a[i] ? 1U : 0U;
        return count;
    };
    EXPECT_LE(differing(whole.depths, tiled.depths), 30U);
    for (std::size_t i = 0; i < skyline_samples; ++i)
        EXPECT_LE(differing(whole.skyline_depths[i], tiled.skyline_depths[i]), 30U) << i;
    EXPECT_EQ(whole.rgba.size(), 60000U);
    EXPECT_GT(whole.report.counts.triangles_drawn, 1000U);
    EXPECT_GT(whole.page_bytes, 100000U);
    EXPECT_TRUE(whole.settled && tiled.settled);
}

// The ground comes up from below: a lower sample of a pixel is ground where a higher one is, but for what
// stands out; the first and the last sample differ where the skyline runs between them.
TEST_P(DepthPictures, SamplesLieBelowEachOther) {
    DepthPainter painter(*gpu_, GetParam());
    const DepthPicture picture = draw(painter, {});
    const auto ground = [](const std::vector<float>& depths) {
        return static_cast<std::size_t>(
            std::count_if(depths.begin(), depths.end(), [](float d) { return d > 0.0F; }));
    };
    ASSERT_EQ(picture.skylines().size(), 4U);
    for (std::size_t i = 0; i + 1 < skyline_samples; ++i) {
        EXPECT_LT(ground(picture.skyline_depths[i]), ground(picture.skyline_depths[i + 1])) << i;
        EXPECT_EQ(picture.skylines()[i].sample_px.y, (static_cast<double>(i) + 0.5) / 4.0);
    }
    EXPECT_LE(ground(picture.skyline_depths[1]), ground(picture.depths));
    EXPECT_LE(ground(picture.depths), ground(picture.skyline_depths[2]));
    EXPECT_GT(ground(picture.depths), 3000U);
    EXPECT_LT(ground(picture.depths), 14000U);
}

TEST_P(DepthPictures, WithoutSkylinesHaveNone) {
    DepthPainter painter(*gpu_, GetParam());
    DepthPictureOptions options;
    options.skyline = false;
    const DepthPicture picture = draw(painter, options);
    EXPECT_TRUE(picture.skylines().empty());
    EXPECT_EQ(picture.depths.size(), 15000U);
}

INSTANTIATE_TEST_SUITE_P(Paths, DepthPictures, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });

}  // namespace
}  // namespace oro

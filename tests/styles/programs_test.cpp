// Which programs a picture makes: those that it needs, and others when another picture asks for them. A
// driver that compiles for processors takes longer for each than to draw a small picture with it.
#include <algorithm>

#include "apps/view/style.h"
#include "render/frame/picture_renderer.h"
#include "render/pipelines/pipeline_parts.h"
#include "tests/styles/region_with_means.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

class Programs : public test::GpuTest {
  protected:
    void SetUp() override { renew_gpu(); }

    // A picture of the bundled region from a place near its middle, RGB.
    std::vector<std::uint8_t> draw(const Gpu& gpu, const char* style_name) {
        Region region{std::vector<RegionGrid>(1)};
        std::optional<Scene> scene;
        test::open_with_means(gpu, {(test::bundled_data() / "jacksboro.tif").string()}, region, scene);
        if (!scene) return {};
        View view;
        view.style = style_name;
        view.camera.eye = {
            0.5 * (region.grids[0].field.grid.south_deg() + region.grids[0].field.grid.north_deg()),
            0.5 * (region.grids[0].field.grid.west_deg() + region.grids[0].field.grid.east_deg()), 3000.0};
        view.camera.attitude = {20.0, -20.0, 0.0};
        view.camera.width_px = 64;
        view.camera.height_px = 48;
        const auto style = load_style(view, region.grids[0].field);
        EXPECT_TRUE(style.ok()) << style.error().line();
        PictureOptions options;
        options.path = RasterPath::compute;
        std::vector<std::uint8_t> rows;
        const auto report = render_picture(gpu, *scene, view.camera, style->frame, options,
                                           [&](std::span<const std::uint8_t> row) -> Result<void> {
                                               rows.insert(rows.end(), row.begin(), row.end());
                                               return {};
                                           },
                                           {});
        EXPECT_TRUE(report.ok()) << report.error().line();
        return rows;
    }

    // All that pictures by compute have made on a device.
    static std::shared_ptr<Pipelines> made_on(const Gpu& gpu) {
        auto made = shared_pipelines(gpu, RasterPath::compute, {});
        EXPECT_TRUE(made.ok()) << made.error().line();
        return *made;
    }
    static std::size_t count(std::span<const OwnedPipeline> programs) {
        return static_cast<std::size_t>(std::ranges::count_if(
            programs, [](const OwnedPipeline& program) { return static_cast<bool>(program); }));
    }
};

TEST_F(Programs, NaturalMakesNoneForWhatIsNotInItsPicture) {
    ASSERT_FALSE(draw(*gpu_, "natural").empty());
    const auto made = made_on(*gpu_);
    const bool by_processor = gpu_->report().kind == VK_PHYSICAL_DEVICE_TYPE_CPU;
    EXPECT_EQ(made->shades.size(), by_processor ? 1U : 2U);
    EXPECT_EQ(count(made->edges), 1U);
    EXPECT_EQ(count(made->air), 6U);
    EXPECT_EQ(count(made->sun_shares[0]), by_processor ? 2U : 3U);
    // No net, no clusters, no images, no other grid, and nothing that is measured or explained.
    EXPECT_EQ(count(made->sun_shares[1]) + count(made->sun_shares[2]), 0U);
    EXPECT_EQ(count(made->texture_tile_feedback), 0U);
    EXPECT_EQ(count(made->cast_places), 0U);
    EXPECT_EQ(count(made->joined_shares[0]) + count(made->joined_shares[1]), 0U);
    for (const OwnedPipeline* program :
         {&made->join_shares, &made->triangles, &made->show, &made->choose_clusters,
          &made->choose_clusters_second_pass, &made->cluster_raster, &made->cluster_clip,
          &made->cluster_triangles, &made->terrain, &made->terrain_ties})
        EXPECT_FALSE(static_cast<bool>(*program));
}

TEST_F(Programs, AnotherStyleMakesWhatIsMissingAndDrawsTheSame) {
    const std::vector<std::uint8_t> plain = draw(*gpu_, "haze");
    ASSERT_FALSE(plain.empty());
    {
        const auto made = made_on(*gpu_);
        EXPECT_EQ(count(made->air) + count(made->sun_shares[0]), 0U);
        EXPECT_FALSE(static_cast<bool>(made->openness));
    }
    const std::vector<std::uint8_t> after = draw(*gpu_, "natural");
    EXPECT_EQ(count(made_on(*gpu_)->air), 6U);
    EXPECT_NE(after, plain);
    EXPECT_EQ(draw(*gpu_, "haze"), plain);
    auto other = Gpu::create(gpu_options_from_environment());
    ASSERT_TRUE(other.ok()) << other.error().line();
    EXPECT_EQ(draw(**other, "natural"), after);
}

// Five words of header, then a loop that asks to be unrolled, an instruction of two words and a loop that
// asks for nothing.
TEST(LoopsOfPrograms, StayLoopsWhereAProcessorDraws) {
    constexpr std::uint32_t loop_merge = 4U << 16U | 246U, branch = 2U << 16U | 249U;
    const std::vector<std::uint32_t> words{0x07230203, 0x10600, 0,   50,         0, loop_merge, 7, 8,
                                           1,          branch,  246, loop_merge, 9, 10,         0};
    const std::vector<std::uint32_t> whole{0x07230203, 0x10600, 0,   50,         0, loop_merge, 7, 8,
                                           2,          branch,  246, loop_merge, 9, 10,         2};
    EXPECT_EQ(with_whole_loops(words), whole);
}

}  // namespace
}  // namespace oro

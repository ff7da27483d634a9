// The legend in the corner of a window that explains its frames.
#include "apps/window/show_legend.h"

#include "tests/styles/drawn_style.h"
#include "tests/support/drawn/region_scene.h"

namespace oro {
namespace {

class ShownLegend : public test::StyleTest {
  protected:
    void SetUp() override {
        StyleTest::SetUp();
        region_.grids[0].field =
            test::square_field(46.5, 8.0, 30.0, 200, [](int row, int) { return 1500.0 + row; });
        view_.camera = test::straight_down(region_.grids[0].field, 30.0, 150.0, 300);
    }
    // A frame of triangles, each in its colour, seen from above; RGBA.
    std::vector<std::uint8_t> framed(ShowLegend& legend, int width, int height) {
        view_.camera.width_px = width;
        view_.camera.height_px = height;
        auto scene = test::create_scene(*gpu_, region_);
        FrameRendererOptions options;
        options.extent = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
        options.path = RasterPath::compute;
        options.show = gpu::show_triangles;
        auto renderer = FrameRenderer::create(*gpu_, options);
        EXPECT_TRUE(scene.ok() && renderer.ok());
        auto plan = scene->settled_plan({view_.camera, {0, 0, width, height, {0.5, 0.5}}, 1.0});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        EXPECT_TRUE(renderer->draw(std::move(*plan), {}).ok());
        const auto done = legend.lay_over(view_, region_, Style{}, 1, *renderer);
        EXPECT_TRUE(done.ok()) << done.error().line();
        return std::move(*renderer->read_picture(options.extent.width, options.extent.height));
    }

    Region region_{std::vector<RegionGrid>(1)};
    View view_;
};

// The panel in the corner, to the byte, and the frame beside it and below it.
TEST_F(ShownLegend, LiesOverTheCornerAlone) {
    ShowLegend legend;
    const auto bare = framed(legend, 300, 200);
    view_.show = Show::triangles;
    const auto with = framed(legend, 300, 200);
    const auto panel = names_panel(colour_key(view_, region_, Style{}), 300);
    ASSERT_TRUE(panel.ok());
    ASSERT_LT(panel->height_px, 200);
    std::size_t other = 0, changed = 0;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 300; ++x) {
            const auto at = static_cast<std::size_t>(4 * (300 * y + x));
            const bool inside = x < panel->width_px && y < panel->height_px;
            const auto there = static_cast<std::size_t>(3 * (panel->width_px * y + x));
            for (std::size_t c = 0; c < 3; ++c) {
                other += with[at + c] != (inside ? panel->rgb[there + c] : bare[at + c]);
                changed += with[at + c] != bare[at + c];
            }
        }
    EXPECT_EQ(other, 0U);
    EXPECT_GT(changed, 1000U);
}

// A window may be smaller than its legend, and becomes larger again.
TEST_F(ShownLegend, IsCutOffInASmallWindow) {
    view_.show = Show::triangles;
    ShowLegend legend;
    const auto tiny = framed(legend, 40, 12);
    EXPECT_EQ(tiny[0], 250) << "paper";
    EXPECT_EQ(tiny[1], 248);
    const auto large = framed(legend, 300, 200);
    ShowLegend anew;
    EXPECT_TRUE(large == framed(anew, 300, 200));
}

}  // namespace
}  // namespace oro

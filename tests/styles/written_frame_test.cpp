// A window's frame of an eye that rests shows what a picture of the same view does.
#include "apps/window/written_frame.h"

#include <array>
#include <fstream>

#include "apps/vectors/view_vectors.h"
#include "core/base/parallel.h"
#include "core/lod/ground_means.h"
#include "tests/styles/drawn_style.h"
#include "tests/support/drawn/region_scene.h"

namespace oro {
namespace {

double written_hills_m(int row, int column) {
    return 1500.3 + 160.0 * std::sin(column / 19.0) + 130.0 * std::cos(row / 23.0);
}

class WrittenFrame : public test::StyleTest {
  protected:
    static View view_with_names(const Region& region) {
        const std::string file =
            (std::filesystem::path(testing::TempDir()) / "written_frame.geojson").string();
        std::ofstream(file) << R"({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"name": "Zürich"},
             "geometry": {"type": "Point", "coordinates": [8.0, 46.5]}},
            {"type": "Feature", "properties": {},
             "geometry": {"type": "LineString", "coordinates": [[7.98, 46.49], [8.02, 46.51]]}}]})";
        View view;
        view.style = "contours";
        view.camera.eye = {46.5, 8.0, 12000.0};
        view.camera.attitude = {0.0, -90.0, 0.0};
        view.camera.vertical_fov_deg = 40.0;
        view.camera.width_px = 480;
        view.camera.height_px = 360;
        view.vectors.names = {file};
        view.vectors.overlay = {file};
        std::vector<Fingerprints::OfSource> fingerprints;
        auto read = open_vectors(view.vectors, region, fingerprints);
        EXPECT_TRUE(read.ok()) << read.error().line();
        view.vectors_read = *read;
        return view;
    }

    // The frame as a window has it, RGBA.
    std::vector<std::uint8_t> framed(const View& view, const HeightField& field, const Style& style,
                                     Scene& scene, bool written) {
        FrameRendererOptions options;
        options.extent = {static_cast<std::uint32_t>(view.camera.width_px),
                          static_cast<std::uint32_t>(view.camera.height_px)};
        options.path = RasterPath::compute;
        options.smooth_edges = style.frame.smooth_edges != 0;
        auto renderer = FrameRenderer::create(*gpu_, options);
        EXPECT_TRUE(renderer.ok()) << renderer.error().line();
        const Tile tile{0, 0, view.camera.width_px, view.camera.height_px, {0.5, 0.5}};
        auto plan = scene.settled_plan({view.camera, tile, view.tau_px, view.model});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        EXPECT_TRUE(renderer->draw(std::move(*plan), style.frame).ok());
        if (written) {
            const TrueSurface surface(field, 1.0, thread_count());
            const auto done =
                write_over_frame(*gpu_, scene, view, surface, style, RasterPath::compute, *renderer);
            EXPECT_TRUE(done.ok()) << done.error().line();
        }
        auto rgba = renderer->read_picture(options.extent.width, options.extent.height);
        EXPECT_TRUE(rgba.ok());
        return std::move(*rgba);
    }
};

TEST_F(WrittenFrame, IsThePictureOfTheView) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 320, written_hills_m);
    const View view = view_with_names(region);
    const auto style = load_style(view, region.grids[0].field);
    ASSERT_TRUE(style.ok()) << style.error().line();
    auto scene = test::create_scene(*gpu_, region, {.means = asks_for_means(style->frame)});
    ASSERT_TRUE(scene.ok()) << scene.error().line();
    std::vector<std::uint8_t> picture;
    const auto take = [&](std::span<const std::uint8_t> row) {
        picture.insert(picture.end(), row.begin(), row.end());
        return Result<void>();
    };
    const TrueSurface surface(region.grids[0].field, 1.0, thread_count());
    const auto drawn = render_labelled(*gpu_, *scene, view, surface, *style, RasterPath::compute, take, {});
    ASSERT_TRUE(drawn.ok()) << drawn.error().line();
    EXPECT_FALSE(drawn->labels.empty());
    EXPECT_EQ(drawn->overlay.lines, 1U);

    const auto bare = framed(view, region.grids[0].field, *style, *scene, false);
    const auto frame = framed(view, region.grids[0].field, *style, *scene, true);
    std::size_t written = 0, differ = 0;
    for (std::size_t pixel = 0; pixel < frame.size() / 4; ++pixel) {
        for (std::size_t k = 0; k < 3; ++k) {
            written += frame[4 * pixel + k] != bare[4 * pixel + k] ? 1U : 0U;
            differ += frame[4 * pixel + k] != picture[3 * pixel + k] ? 1U : 0U;
        }
        ASSERT_EQ(frame[4 * pixel + 3], bare[4 * pixel + 3]) << "what is ground stays so";
    }
    EXPECT_GT(written, 1000U) << "nothing is written over the frame";
    EXPECT_EQ(differ, 0U);
}

}  // namespace
}  // namespace oro

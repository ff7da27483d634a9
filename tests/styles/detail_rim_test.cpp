// Ground that is invented between posts: pixels beside it have the colours that the data alone give them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "apps/view/style.h"
#include "core/lod/ground_means.h"
#include "geo/refined/refined_region.h"
#include "render/frame/picture_renderer.h"
#include "tests/styles/region_with_means.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/drawn/made_renderer.h"
#include "tests/support/drawn/region_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

constexpr int rim_side_px = 96;
constexpr double rim_pixel_m = 10.0, rim_above_m = 40000.0;

class DetailRim : public test::GpuTest {
  protected:
    std::vector<std::uint8_t> picture(const Region& region, const Camera& camera) {
        auto scene = test::create_scene(*gpu_, region, {.means = true});
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        View view;
        view.style = "natural";
        view.sun = SunDirection{315.0, 38.0};
        const auto style = load_style(view, region.grids[0].field);
        EXPECT_TRUE(style.ok()) << style.error().line();
        scene->set_footprint_spacing(means_spacing_px(style->frame));
        FrameRendererOptions options;
        options.extent = {rim_side_px, rim_side_px};
        options.path = RasterPath::compute;
        options.smooth_edges = true;
        FrameRenderer renderer = test::made_renderer(*gpu_, options);
        auto plan = scene->settled_plan({camera, test::whole_picture(camera), 1.0});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        const auto drawn = renderer.draw(std::move(*plan), style->frame, 0, 1);
        EXPECT_TRUE(drawn.ok()) << drawn.error().line();
        auto rgba = renderer.read_picture(rim_side_px, rim_side_px);
        EXPECT_TRUE(rgba.ok());
        return std::move(*rgba);
    }
};

struct RimCodes {
    double pixels;  // mean of all channels
    double blocks;  // of the means of 16 pixels along the rim: what is left where single slopes differ
};
// Differences of two pictures in rows so many pixels from the middle.
RimCodes difference(const std::vector<std::uint8_t>& one, const std::vector<std::uint8_t>& other, int from_px,
                    int to_px) {
    constexpr std::size_t block_px = 16;
    std::array<double, 3 * rim_side_px / block_px> blocks{};
    double sum = 0.0, count = 0.0;
    for (int row = rim_side_px / 2 + from_px; row < rim_side_px / 2 + to_px; ++row) {
        for (std::size_t i = 0; i < 3 * std::size_t{rim_side_px}; ++i) {
            const std::size_t column = i / 3, channel = i % 3;
            const std::size_t at = 4 * (static_cast<std::size_t>(row) * rim_side_px + column) + channel;
            const int off = int{one[at]} - int{other[at]};
            sum += std::abs(off);
            count += 1.0;
            blocks[3 * (column / block_px) + channel] += off;
        }
    }
    double of_blocks = 0.0;
    for (const double block : blocks) of_blocks += std::abs(block);
    return {sum / count, of_blocks / count};
}

// Inside, colours are those of invented slopes, wherever one looks: the rim itself adds nothing to how far
// they are from the data's.
//
// Hollows and level ground are those of squares of up to 500 m, which lie on both sides of a rim. Straight
// down on the middle of the northern and the southern one, with the same picture of the data alone beside
// each.
TEST_F(DetailRim, LeavesTheColoursOfTheDataAround) {
    const auto alps = test::real_data("alps");
    if (!alps) GTEST_SKIP() << "needs alps";
    Region data;
    std::optional<Scene> scene;
    ASSERT_NO_FATAL_FAILURE(
        test::open_with_means(*gpu_, {(*alps / "N46E007.SRTMGL3.hgt.zip").string()}, data, scene));
    scene.reset();
    double at_rim = 0.0, within = 0.0;  // 20 to 60 m, and 320 to 440 m from it
    // Forest and meadows; rock, snow and ice.
    for (const auto& [lat_deg, lon_deg] : {std::pair{46.68, 7.45}, std::pair{46.55, 7.95}}) {
        Region refined = data;
        const auto added = add_detail(refined, {3, lat_deg, lon_deg, 2000.0}, nullptr);
        ASSERT_TRUE(added.ok()) << added.error().line();
        const PostGrid& grid = refined.grids.back().field.grid;
        for (const bool is_north : {true, false}) {
            const double rim_deg = is_north ? grid.north_deg() : grid.south_deg();
            Camera camera{
                {rim_deg, lon_deg, rim_above_m + 1500.0}, {0.0, -90.0, 0.0}, 0.0, rim_side_px, rim_side_px};
            camera.vertical_fov_deg =
                2.0 * std::atan(0.5 * rim_side_px * rim_pixel_m / rim_above_m) * 180.0 / std::numbers::pi;
            const auto with = picture(refined, camera), without = picture(data, camera);
            // Two pixels at the rim have ground of both.
            const RimCodes north = difference(with, without, -22, -2),
                           south = difference(with, without, 2, 22);
            const RimCodes& inside = is_north ? south : north;
            const RimCodes& outside = is_north ? north : south;
            std::printf("%.2f %.2f, %s rim: outside %.2f codes, inside %.2f (blocks of 16 pixels %.2f)\n",
                        lat_deg, lon_deg, is_north ? "northern" : "southern", outside.pixels, inside.pixels,
                        inside.blocks);
            EXPECT_LE(outside.pixels, 0.3);
            const auto inside_by = [&](int from_px, int to_px) {
                return is_north ? difference(with, without, from_px, to_px)
                                : difference(with, without, -to_px, -from_px);
            };
            at_rim += 0.25 * inside_by(2, 6).pixels;
            within += 0.25 * inside_by(32, 44).pixels;
        }
    }
    std::printf("inside: %.2f codes 20 to 60 m from the rim, %.2f codes 320 to 440 m from it\n", at_rim,
                within);
    EXPECT_LE(at_rim, 1.25 * within);
}

}  // namespace
}  // namespace oro

// Panoramas have no seams: other borders between their tiles, the same picture.
#include "render/frame/cylinder_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/frame/region_pages.h"
#include "core/terrain/ground.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

using CylinderPictureTest = test::GpuTest;

gpu::FrameStyle shaded() {
    gpu::FrameStyle style{};
    style.tint_count = 2;
    style.tints[0].colour = gpu::vec3(0.15F, 0.3F, 0.1F);
    style.tints[1].colour = gpu::vec3(0.9F);
    style.tints[1].at = 3000.0F;
    style.sun_enu = gpu::vec3(0.5F, 0.5F, 0.7071F);
    style.relief = 1.0F;
    style.ambient = 0.3F;
    style.haze_colour = gpu::vec3(0.6F, 0.7F, 0.8F);
    style.haze_distance_m = 1e5F;
    style.zenith_colour = gpu::vec3(0.1F, 0.3F, 0.7F);
    style.sky_scale_height_m = 8000.0F;
    style.smooth_edges = 1;
    return style;
}

struct Difference {
    int most{};           // of any code
    double mean{};        // of all
    double at_borders{};  // of the columns beside borders
};

Difference difference(const Cylinder& around, const CylinderPicture& a, const CylinderPicture& b,
                      const std::vector<int>& borders) {
    Difference found;
    double sum = 0.0, border_sum = 0.0;
    std::size_t border_count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const int off = std::abs(static_cast<int>(a.rgb[i]) - static_cast<int>(b.rgb[i]));
        const int column = static_cast<int>(i / 3 % static_cast<std::size_t>(around.width_px));
        found.most = std::max(found.most, off);
        sum += off;
        if (std::ranges::any_of(borders, [&](int x) { return column == x || column == x - 1; })) {
            border_sum += off;
            ++border_count;
        }
    }
    found.mean = sum / static_cast<double>(a.rgb.size());
    found.at_borders = border_sum / static_cast<double>(std::max<std::size_t>(1, border_count));
    return found;
}

TEST_F(CylinderPictureTest, HasNoSeams) {
    const HeightField field = test::rough_field(46.9, 8.1, 300, 300);
    const Geodetic eye{46.78, 8.22, *ground_h_m(field, 46.78, 8.22, 1.0) + 300.0};
    const Cylinder around = cylinder_around(0.0, 360.0, -25.0, 10.0, 1200);
    const auto draw = [&](double shift_px, double widest_deg) {
        auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2));
        EXPECT_TRUE(scene.ok());
        PictureOptions options;
        options.path = RasterPath::compute;
        options.tau_px = 0.0;  // borders choose no detail
        auto picture =
            render_cylinder(*gpu_, *scene, eye, around, {2.0, 2048, widest_deg, shift_px}, shaded(), options);
        EXPECT_TRUE(picture.ok());
        return std::move(*picture);
    };
    const CylinderPicture usual = draw(0.0, 45.0), moved = draw(61.0, 45.0);
    EXPECT_EQ(usual.tiles, 8);
    EXPECT_GT(usual.report.ground_px, 100'000U);
    // Borders of the first lie in the middle of the second's tiles: what differs there is a seam. Elsewhere
    // both are drawn in directions of their own, too, and what that costs is the measure.
    std::vector<int> borders;
    for (int i = 1; i < 8; ++i) borders.push_back(150 * i);
    const Difference found = difference(around, usual, moved, borders);
    std::printf("mean %.3f codes, beside borders %.3f, most %d\n", found.mean, found.at_borders, found.most);
    const auto [darkest, lightest] = std::ranges::minmax(usual.rgb);
    EXPECT_GT(lightest - darkest, 100) << "a picture of something";
    EXPECT_LT(found.mean, 0.3);
    EXPECT_LT(found.at_borders, 1.3 * found.mean + 0.1);
    // The left border follows on the right one: no more off than any two neighbours.
    double over = 0.0, near = 0.0;
    for (int y = 0; y < around.height_px(); ++y) {
        const std::uint8_t* const row =
            &usual.rgb[3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(around.width_px)];
        for (int i = 0; i < 3; ++i) {
            over += std::abs(row[i] - row[3 * 1199 + i]);
            near += 0.5 * (std::abs(row[i] - row[3 + i]) + std::abs(row[3 * 1199 + i] - row[3 * 1198 + i]));
        }
    }
    EXPECT_LT(over, 1.5 * near + 100.0);
}

// Letting go of the pages of columns that are drawn costs no pixel, and their buffers take no more for it.
TEST_F(CylinderPictureTest, IsTheSameWithPagesOfOneColumnAtATime) {
    const HeightField field = test::rough_field(46.9, 8.1, 900, 900);
    const Geodetic eye{46.53, 8.47, *ground_h_m(field, 46.53, 8.47, 1.0) + 30.0};
    const Cylinder around = cylinder_around(0.0, 360.0, -20.0, 6.0, 400);
    const auto draw = [&](std::uint64_t kept_page_bytes) {
        auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2));
        EXPECT_TRUE(scene.ok());
        PictureOptions options;
        options.path = RasterPath::compute;
        CylinderExtras extras;
        extras.kept_page_bytes = kept_page_bytes;
        auto picture = render_cylinder(*gpu_, *scene, eye, around, {}, shaded(), options, extras);
        EXPECT_TRUE(picture.ok());
        const std::uint64_t sent = scene->grids().front().store().bytes_sent();
        return std::pair(std::move(*picture), sent);
    };
    const auto [all, sent_once] = draw(std::uint64_t{1} << 40U);
    const auto [by_column, sent_again] = draw(0);
    EXPECT_EQ(all.rgb, by_column.rgb);
    EXPECT_GT(sent_again, sent_once) << "pages of several columns come more than once";
    EXPECT_LE(by_column.page_bytes, all.page_bytes);
    EXPECT_GT(by_column.page_bytes, 0U);
}

}  // namespace
}  // namespace oro

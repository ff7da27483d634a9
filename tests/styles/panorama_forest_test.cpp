// Panoramas over lakes and far forests: no border of their tiles is seen in what water mirrors.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "render/frame/cylinder_picture.h"
#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

class PanoramaForests : public test::StyleTest {
  protected:
    // A lake, and 900 m north of the middle a wall of 240 m; square cells of 30 m.
    static Region lake_before_wall() {
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 129, [](int row, int) {
            return 1100.0 + std::clamp(4.0 * (30.0 * (64 - row) - 900.0), 0.0, 240.0);
        });
        return region;
    }
    static gpu::FrameStyle with_trees(const Region& region) {
        std::ifstream file(test::bundled_data() / "styles" / "natural.json");
        const std::string text((std::istreambuf_iterator<char>(file)), {});
        const auto style =
            style_of(text, ".json", Camera{}, region.grids[0].field, SunDirection{180.0, 50.0});
        EXPECT_TRUE(style.ok()) << style.error().line();
        return style->frame;
    }
    CylinderPicture panorama(const Region& region, const Cylinder& around, const CylinderCut& cut) {
        auto scene = test::create_scene(*gpu_, region, {.means = true});
        EXPECT_TRUE(scene.ok());
        PictureOptions options;
        options.path = RasterPath::compute;
        CylinderExtras extras;
        extras.ridges = false;
        const Geodetic eye{46.5 - 600.0 / 111'170.0, 8.0, 1112.0};
        auto picture = render_cylinder(*gpu_, *scene, eye, around, cut, with_trees(region), options, extras);
        EXPECT_TRUE(picture.ok()) << picture.error().line();
        return std::move(*picture);
    }
    // How far apart the codes of two pictures are in the mean, in columns from one to another, below level.
    static double apart(const Cylinder& around, const CylinderPicture& one, const CylinderPicture& other,
                        int from_px, int to_px) {
        double sum = 0.0, count = 0.0;
        for (int y = around.above_px + 4; y < around.height_px(); ++y)
            for (int x = from_px; x < to_px; ++x)
                for (int i = 0; i < 3; ++i, ++count) {
                    const auto at = static_cast<std::size_t>(3 * (y * around.width_px + x) + i);
                    sum += std::abs(static_cast<int>(one.rgb[at]) - static_cast<int>(other.rgb[at]));
                }
        return sum / count;
    }
};

// Borders of the one lie in the middle of the other's tiles. Found: to both sides of each border the wall
// was mirrored less and less, in bands that are seen over the whole lake.
TEST_F(PanoramaForests, MirrorWithoutSeams) {
    const Region region = lake_before_wall();
    const Cylinder around = cylinder_around(300.0, 120.0, -14.0, 16.0, 600);
    const auto draw = [&](bool with_forests, double shift_px) {
        return panorama(region, around, {2.0, 2048, 45.0, shift_px, with_forests});
    };
    const CylinderPicture usual = draw(true, 0.0), moved = draw(true, 80.0), narrow = draw(false, 0.0);
    EXPECT_EQ(usual.tiles, 3);
    for (const int border_px : {200, 400}) {
        const double beside = apart(around, usual, moved, border_px - 8, border_px + 8),
                     before = apart(around, narrow, moved, border_px - 8, border_px + 8);
        std::printf("column %d: %.2f codes beside the border (%.2f in tiles that end there)\n", border_px,
                    beside, before);
        EXPECT_LT(beside, 1.5);
        EXPECT_GT(before, 2.0 * beside) << "or nothing is mirrored there";
    }
}

}  // namespace
}  // namespace oro

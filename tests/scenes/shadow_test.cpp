// Must hold: what lies in shadow on a picture lies in shadow in truth.
#include <cstdlib>

#include "tests/scenes/real_tiles.h"
#include "tests/scenes/shadows_of_pictures.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

using test::ShadowsOfPictures;

TEST_F(ShadowsOfPictures, OfMadeTerrainAreTheOracles) {
    const int views = (test::view_count(6) + 2) / 3;
    look_over("made terrain", test::rough_field(47.0, 8.0, 700, 900), views);
    judge(views);
}

// Posts that lie on nets: turned, and over a pole.
TEST_F(ShadowsOfPictures, OnNetsAreTheOracles) {
    const int views = (test::view_count(6) + 2) / 3;
    for (const auto& [name, plane] :
         {std::pair("a turned net", test::PlaneOfPosts{700, 900, {46.5, 8.0}, 80.0, 27.0}),
          std::pair("a net over the pole", test::PlaneOfPosts{700, 700, {89.9, 40.0}, 90.0, 0.0})})
        look_over(name, test::net_field(plane, test::patchy_H_m, 40.0F), views);
    judge(2 * views);
}

TEST_F(ShadowsOfPictures, OfRealTerrainAreTheOracles) {
    const int views = test::view_count(6);
    for (std::size_t i = 0; i < test::real_regions.size(); ++i) {
        const test::RealRegion& real = test::real_regions[i];
        if (!test::real_data(real.folder)) GTEST_SKIP() << "needs " << real.folder;
        const auto region = test::open_tiles(real.folder, real.tiles);
        ASSERT_TRUE(region.ok()) << region.error().line();
        look_over(real.folder, region->grids[0].field, test::views_of(i, views));
    }
    judge(views);
}

}  // namespace
}  // namespace oro

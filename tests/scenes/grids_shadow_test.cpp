// Must hold: terrain of each grid of a picture casts its shadows on the ground of all, as it does in truth.
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/scenes/shadows_of_pictures.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {

using test::ShadowsOfPictures;

// Low hills, and a wall along a meridian of 250 m, as wide as a post of 3 seconds is from the next.
float walled_H_m(double lat_deg, double lon_deg) {
    const double off = (lon_deg - 8.0435) / 0.0012;
    return static_cast<float>(test::Waves{500.0, 60.0, 90.0, 5}.H_m(lat_deg, lon_deg) +
                              250.0 * std::exp(-off * off));
}
HeightField walled_field(const PostPlace& north_west, double posts_per_deg, double tall_deg,
                         double wide_deg) {
    return test::made_field(north_west.lat_deg, north_west.lon_deg, posts_per_deg,
                            static_cast<int>(tall_deg * posts_per_deg) + 1,
                            static_cast<int>(wide_deg * posts_per_deg) + 1, walled_H_m);
}

// Two grids of different posts, with the wall along the rim between them.
Region walled_grids(double north_deg, double west_deg, double tall_deg) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = walled_field({north_deg, west_deg}, 1200.0, tall_deg, 8.05 - west_deg);
    region.grids[0].rank = 1;
    region.grids.emplace_back().field = walled_field({north_deg, 8.0452}, 1800.0, tall_deg, 0.0548);
    return region;
}
Region walled_grids() {
    return walled_grids(47.05, 8.0, 0.1);
}

// Looks down on a place by 30 degrees from some 2 km.
Camera small_camera(const Geodetic& at, double heading_deg) {
    const SineCosine heading = sine_cosine_deg(heading_deg);
    return {{at.lat_deg - 0.02 * heading.cosine, at.lon_deg - 0.03 * heading.sine, at.h_m},
            {heading_deg, -30.0, 0.0},
            60.0,
            96,
            64};
}
std::vector<Camera> walled_cameras() {
    constexpr Geodetic over_wall{47.0, 8.045, 1900.0};
    return {small_camera(over_wall, 0.0), small_camera(over_wall, 90.0), small_camera(over_wall, 250.0)};
}

// Each grid casts on the other, as one grid does on itself.
TEST_F(ShadowsOfPictures, BetweenGridsAreTheOracles) {
    Region whole{std::vector<RegionGrid>(1)};
    whole.grids[0].field = walled_field({47.05, 8.0}, 1200.0, 0.1, 0.1);
    const Region halves = walled_grids();
    for (const Region* const region : {&std::as_const(whole), &halves}) {
        all = {};
        ASSERT_NO_FATAL_FAILURE(look_over_grids(region == &whole ? "as one grid" : "as two grids", *region,
                                                walled_cameras(),
                                                {{275.0, 7.0}, {80.0, 4.0}, {225.0, 15.0}}));
        judge(static_cast<int>(walled_cameras().size()));
    }
}

// The western grid lies behind the eye, and no page of it is in the picture.
TEST_F(ShadowsOfPictures, OfAGridBesideThePictureAreTheOracles) {
    const std::array cameras{Camera{{47.0, 8.071, 900.0}, {90.0, -20.0, 0.0}, 40.0, 96, 64}};
    look_over_grids("beside the picture", walled_grids(47.012, 8.03, 0.024), cameras, {{270.0, 4.0}});
    judge(1, 1);
}

// ... three of them over each other, two on turned nets, with steps along their rims and holes.
TEST_F(ShadowsOfPictures, OfGridsOverEachOtherAreTheOracles) {
    constexpr Geodetic at{46.95, 8.05, 4200.0};
    const std::array cameras{small_camera(at, 20.0), small_camera(at, 140.0), small_camera(at, 260.0)};
    look_over_grids("three grids", test::three_grids(120), cameras,
                    {{250.0, 8.0}, {120.0, 20.0}, {10.0, 35.0}});
    judge(static_cast<int>(cameras.size()));
}

// The same bytes by either way of drawing, and in another run.
TEST_F(ShadowsOfPictures, BetweenGridsAreTheSameEitherWay) {
    const Region region = walled_grids();
    const auto cuts = cut_regions(region);
    ASSERT_TRUE(cuts.ok()) << cuts.error().line();
    const Seam seam = seam_between(region, *cuts, 1.0);
    const SineCosine a = sine_cosine_deg(275.0), e = sine_cosine_deg(7.0);
    const gpu::FrameStyle style = test::shares_alone({e.cosine * a.sine, e.cosine * a.cosine, e.sine});
    std::vector<std::vector<std::uint8_t>> first;
    for (const RasterPath path : {RasterPath::compute, RasterPath::compute, RasterPath::mesh}) {
        Scene scene = test::scene_of_grids(*gpu_, region, *cuts, seam);
        DepthPainter painter(*gpu_, path);
        std::vector<std::vector<std::uint8_t>> pictures;
        for (const Camera& camera : walled_cameras()) {
            auto picture = painter.draw(scene, camera, style, {});
            ASSERT_TRUE(picture.ok()) << picture.error().line();
            pictures.push_back(std::move(picture->rgba));
        }
        if (first.empty()) first = pictures;
        EXPECT_TRUE(pictures == first);
    }
}

}  // namespace
}  // namespace oro

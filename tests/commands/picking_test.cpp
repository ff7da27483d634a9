// What is seen at a point of a picture, on ground whose heights are written down here.
#include "apps/drawing/picking.h"

#include <gtest/gtest.h>

#include "core/truth/oracle.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

// H = 100 m, N = 50 m, from 46 to 47 N and 8 to 9 E, a post each 0.1 degree.
Region flat_region() {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::made_field(47.0, 8.0, 10.0, 11, 11, [](double, double) { return 100.0F; });
    region.grids[0].field.undulation.lat = {1.0, 47.0, 0, -1, 2};
    region.grids[0].field.undulation.lon = {1.0, 8.0, 0, +1, 2};
    region.grids[0].field.undulation.N_m = {50.0F, 50.0F, 50.0F, 50.0F};
    SourceReport source;
    source.path = "folder/flat.tif";
    source.lat_spacing_deg = source.lon_spacing_deg = 0.1;
    source.box = {8.0, 46.0, 9.0, 47.0};
    region.grids[0].sources = {source};
    return region;
}

View view_from(double h_m, const Attitude& attitude) {
    View view;
    view.camera.eye = {46.52, 8.33, h_m};
    view.camera.attitude = attitude;
    view.camera.width_px = view.camera.height_px = 101;
    return view;
}

std::optional<SeenPlace> seen_in_middle(const View& view, const Region& region) {
    const auto ground = RegionGround::of(region, view.exaggeration).value();
    return place_seen(view, *ground, {50.5, 50.5}).value();
}

TEST(Picking, StraightDown) {
    const Region region = flat_region();
    const View view = view_from(1150.0, {0.0, -90.0, 0.0});
    const auto place = seen_in_middle(view, region);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->lat_deg, 46.52, 1e-10);
    EXPECT_NEAR(place->lon_deg, 8.33, 1e-10);
    EXPECT_NEAR(place->H_m, 100.0, 1e-6);
    EXPECT_NEAR(place->h_m, 150.0, 1e-6);
    EXPECT_NEAR(place->seen_distance_m, 1000.0, 1e-6);
    EXPECT_NEAR(place->distance_m, 0.0, 1e-4);
    EXPECT_EQ(place->row, 4);
    EXPECT_EQ(place->column, 3);
    EXPECT_EQ(place->source, "folder/flat.tif");
    const auto middle = place_in_middle(view, *RegionGround::of(region, 1.0).value()).value();
    ASSERT_TRUE(middle);
    EXPECT_EQ(middle->lat_deg, place->lat_deg);
    EXPECT_EQ(middle->lon_deg, place->lon_deg);
    EXPECT_EQ(middle->h_m, place->h_m);
}

// The ground is drawn at 2 * 100 + 50 m and seen there; its height is still 100.
TEST(Picking, ToldHeightsAreTheGroundsOwn) {
    View view = view_from(1150.0, {0.0, -90.0, 0.0});
    view.exaggeration = 2.0;
    const auto place = seen_in_middle(view, flat_region());
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->seen_distance_m, 900.0, 1e-6);
    EXPECT_NEAR(place->H_m, 100.0, 1e-6);
    EXPECT_NEAR(place->h_m, 150.0, 1e-6);
}

// Half way from the middle to the right edge of a picture 90 degrees wide, looking down with north up: the
// sight line leans east by atan(0.5), 500 m over 1,000 m; 500 m east at 46.52 N are 0.0065141 degree
// (GeographicLib, 76,757 m a degree at 150 m).
TEST(Picking, APointOfThePictureAsideOfItsMiddle) {
    const Region region = flat_region();
    View view = view_from(1150.0, {0.0, -90.0, 0.0});
    view.camera.vertical_fov_deg = 90.0;
    view.camera.width_px = view.camera.height_px = 100;
    const auto ground = RegionGround::of(region, 1.0).value();
    const auto place = place_seen(view, *ground, {75.0, 50.0}).value();
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->lon_deg, 8.33 + 0.0065141, 1e-5);
    EXPECT_NEAR(place->lat_deg, 46.52, 1e-5);
    EXPECT_NEAR(place->bearing_deg, 90.0, 0.01);
    EXPECT_NEAR(place->distance_m, 500.0, 0.1);
    EXPECT_NEAR(place->seen_distance_m, 1118.034, 0.1);  // 500 * sqrt(5), and 2 cm for the Earth's curve
}

TEST(Picking, BendsLightAsThePictureDoes) {
    const Region region = flat_region();
    View view = view_from(1150.0, {90.0, -2.0, 0.0});
    const auto straight = seen_in_middle(view, region);
    view.model.air = {0.13};
    const auto bent = seen_in_middle(view, region);
    ASSERT_TRUE(straight && bent);
    const TrueSurface surface(region.grids[0].field, 1.0, 1);
    const auto hit = first_hit(surface, sight_from(view.camera.eye, {0.13}),
                               view.camera.ecef_direction_at({50.5, 50.5}), 1e6);
    ASSERT_TRUE(hit);
    EXPECT_EQ(bent->lat_deg, hit->point.lat_deg);
    EXPECT_EQ(bent->lon_deg, hit->point.lon_deg);
    EXPECT_EQ(bent->seen_distance_m, hit->distance_m);
    // s tan(2 degrees) - (1 - k) s^2 / (2 R) = 1,000 m, with R = 6,389 km across the meridian and
    // k = 0.13: s = 30,756 m straight, 313 m less bent. It was 274 m, with the k of standard air.
    EXPECT_NEAR(straight->distance_m, 30756.0, 10.0);
    EXPECT_NEAR(straight->distance_m - bent->distance_m, 313.4, 3.0);
}

TEST(Picking, TheSkyIsNothing) {
    const auto place = seen_in_middle(view_from(1150.0, {0.0, 90.0, 0.0}), flat_region());
    EXPECT_FALSE(place);
    EXPECT_EQ(line_of(place), "no terrain at this point: it shows sky, or a place without data");
}

// Posts of a flat region that cannot all be read.
class UnreadablePosts : public PostSource {
  public:
    [[nodiscard]] float H_m(int row, int /*column*/) const override {
        unread_ = unread_ || row == 4;
        return row == 4 ? void_height_m : 100.0F;
    }
    [[nodiscard]] Result<void> health() const override {
        if (!unread_) return {};
        return Error{ErrorKind::failed, "flat.oro", "is damaged at byte 4711: made up"};
    }

  private:
    mutable bool unread_{false};
};

TEST(Picking, GroundThatCannotBeReadIsNotNothing) {
    Region region = flat_region();
    region.grids[0].field.H_m.clear();
    region.grids[0].field.posts = std::make_shared<UnreadablePosts>();
    region.grids[0].field.range = HeightRange{100.0F, 100.0F, 0};
    const auto ground = RegionGround::of(region, 1.0).value();
    const auto middle = place_in_middle(view_from(1150.0, {0.0, -90.0, 0.0}), *ground);
    ASSERT_FALSE(middle.ok());
    EXPECT_EQ(middle.error().line(), "flat.oro: is damaged at byte 4711: made up");
}

TEST(Picking, TheLineNamesEveryFigure) {
    SeenPlace place;
    place.lat_deg = -36.5123456;
    place.lon_deg = 8.25;
    place.H_m = 512.346;
    place.h_m = 480.92;
    place.bearing_deg = 12.345;
    place.distance_m = 990.0;
    place.seen_distance_m = 1000.25;
    place.row = 17;
    place.column = 4;
    place.source = "tiles.zip/a\nb.hgt";
    EXPECT_EQ(
        line_of(place),
        "-36.512346° 8.250000°  512.35 m above sea level (480.92 m above the ellipsoid)  1000.25 m away  "
        "bearing 12.35°  cell in row 17, column 4 of the posts  from a" +
            one_line("\n") + "b.hgt");
    place.source.clear();
    EXPECT_TRUE(line_of(place).ends_with("from an unknown source"));
}

}  // namespace
}  // namespace oro

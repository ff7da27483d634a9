// What ground a picture shows, and what a legend names of it.
#include "apps/legend/shown_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/cover/cover_tables.h"
#include "apps/legend/colour_key.h"
#include "apps/legend/legend.h"
#include "shaders/shared_growth.h"
#include "tests/support/made_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

Region level_land(double north_deg, double west_deg) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field =
        test::made_field(north_deg, west_deg, 100.0, 60, 60, [](double, double) { return 0.0F; });
    return region;
}
View from_above(double lat_deg, double lon_deg, double h_m) {
    View view;
    view.camera = {{lat_deg, lon_deg, h_m}, {0.0, -90.0, 0.0}, 45.0, 400, 400};
    return view;
}
ShownGround shown_by(const View& view, const Region& region) {
    const auto ground = RegionGround::of(region, 1.0);
    EXPECT_TRUE(ground.ok());
    auto shown = ground_shown(view, **ground);
    EXPECT_TRUE(shown.ok()) << shown.error().line();
    return std::move(shown).value();
}

// Counted in the file by gdal_translate over the 2,485 m square that is seen: tree 55 %, none 20, shrub 11,
// grass 7, bare 5.1, crop 0.6, water 0.5, built 0.3, no wetland; 15 km to the west there is nothing.
TEST(ShownGround, HasTheClassesThatAreInThePicture) {
    const auto file = test::real_data("cover/li_cover_osm_worldcover_codes.tif");
    if (!file) GTEST_SKIP() << "needs cover/li_cover_osm_worldcover_codes.tif";
    const Region land = level_land(47.4, 9.2);
    View view = from_above(47.10, 9.58, 3000.0);
    CoverChoice choice{{file->string()}, "worldcover"};
    std::vector<Fingerprints::OfSource> fingerprints;
    auto cover = open_cover(choice, fingerprints);
    ASSERT_TRUE(cover.ok()) << cover.error().line();
    view.cover = *cover;
    const ShownGround shown = shown_by(view, land);
    EXPECT_EQ(shown.codes, (std::set<int>{10, 20, 30, 40, 50, 60, 80}));
    EXPECT_TRUE(shown.by_rule);
    EXPECT_NEAR(shown.nearest_m, 3000.0, 1.0);
    EXPECT_NEAR(shown.eye_over_ground_m, 3000.0, 1e-6);
    view.camera.eye.lon_deg = 9.38;
    const ShownGround beside = shown_by(view, land);
    EXPECT_TRUE(beside.codes.empty());
    EXPECT_TRUE(beside.by_rule);
    // Of the sky nothing.
    view.camera.attitude.pitch_deg = 60.0;
    const ShownGround sky = shown_by(view, land);
    EXPECT_TRUE(sky.codes.empty());
    EXPECT_FALSE(sky.by_rule);
    EXPECT_TRUE(std::isinf(sky.nearest_m));
}

// The bundled terrain's file as an image: it covers all within 84.41 to 84.08 W, 36.45 to 36.73 N.
TEST(ShownGround, IsUnderImagesWhereTheyHideAllOfIt) {
    const Region land = level_land(36.8, -84.6);
    View view = from_above(36.6, -84.25, 3000.0);
    auto image = open_image((test::bundled_data() / "jacksboro.tif").string());
    ASSERT_TRUE(image.ok()) << image.error().line();
    EXPECT_FALSE(shown_by(view, land).under_images) << "there is none";
    view.images.push_back(*image);
    const ShownGround under = shown_by(view, land);
    EXPECT_TRUE(under.under_images);
    EXPECT_FALSE(under.by_rule);
    view.drape_opacity = 0.9;
    EXPECT_FALSE(shown_by(view, land).under_images);
    view.drape_opacity = 1.0;
    view.camera.eye.lon_deg = -84.41;
    const ShownGround at_its_rim = shown_by(view, land);
    EXPECT_FALSE(at_its_rim.under_images);
    EXPECT_TRUE(at_its_rim.by_rule);
}

TEST(ShownGround, IsWhatTheKeyNames) {
    CoverTable table{"few", "few", {0}, {}};
    table.classes = {
        {.codes = {1}, .name = "wood", .colour = {56, 77, 44}, .materials = {Material::broad_forest}},
        {.codes = {2}, .name = "lake", .materials = {Material::water}}};
    CoverSource source;
    source.codes = {1, 2};
    auto cover = CoverMap::of({source}, {}, &table);
    ASSERT_TRUE(cover.ok());
    const Region land = level_land(47.4, 9.2);
    View view = from_above(47.1, 9.5, 3000.0);
    view.cover = *cover;
    Style style{};
    style.frame.colour_by = gpu::colour_by_cover;
    style.frame.materials.on = 1;
    const auto key_of = [&](const ShownGround& shown) { return colour_key(view, land, style, 1, &shown); };
    ShownGround shown;
    shown.codes = {2};
    ColourKey key = key_of(shown);
    EXPECT_EQ(key.title, "Land cover");
    ASSERT_EQ(key.names.size(), 1U);
    EXPECT_EQ(key.names[0].name, "lake");
    shown.by_rule = true;
    key = key_of(shown);
    EXPECT_EQ(key.title, "Land cover; then, where none is known, ground by a rule");
    ASSERT_EQ(key.names.size(), 10U);
    EXPECT_EQ(key.names[1].name, "rock");
    EXPECT_EQ(key.names[9].name, "snow");
    shown.codes.clear();
    key = key_of(shown);
    EXPECT_EQ(key.title, "Ground, by a rule");
    EXPECT_EQ(key.names.size(), 9U);
    shown = {};
    EXPECT_EQ(key_of(shown).shape, KeyShape::none) << "sky";
    shown.under_images = true;
    key = key_of(shown);
    EXPECT_EQ(key.title, "The ground has the colours of an image");
    EXPECT_TRUE(key.names.empty());
}

// Found: moss, lichens and sedge of NLCD had three squares of one colour.
TEST(ShownGround, HasOneSquareForClassesOfOneColour) {
    CoverTable table{"few", "few", {0}, {}};
    table.classes = {
        {.codes = {1}, .name = "moss", .colour = {125, 122, 88}, .materials = {Material::meadow}},
        {.codes = {2}, .name = "lake", .colour = {11, 42, 60}, .materials = {Material::water}},
        {.codes = {3}, .name = "sedge", .colour = {125, 122, 88}, .materials = {Material::meadow}},
        {.codes = {4},
         .name = std::string(60, 'l'),
         .colour = {125, 122, 88},
         .materials = {Material::meadow}}};
    CoverSource source;
    source.codes = {1, 2, 3, 4};
    auto cover = CoverMap::of({source}, {}, &table);
    ASSERT_TRUE(cover.ok());
    View view = from_above(47.1, 9.5, 3000.0);
    view.cover = *cover;
    Style style{};
    style.frame.colour_by = gpu::colour_by_cover;
    ShownGround shown;
    shown.codes = {1, 2, 3, 4};
    const ColourKey key = colour_key(view, level_land(47.4, 9.2), style, 1, &shown);
    ASSERT_EQ(key.names.size(), 3U);
    EXPECT_EQ(key.names[0].name, "moss / sedge");
    EXPECT_EQ(key.names[0].colour, (StripColour{125, 122, 88}));
    EXPECT_EQ(key.names[1].name, "lake");
    EXPECT_EQ(key.names[2].name.size(), 60U) << "there is no room for it in the first";
}

class ShownGrowth : public testing::Test {
  protected:
    ShownGrowth() {
        style.frame.materials.on = 1 | gpu::materials_with_trees | gpu::materials_with_grass;
        style.frame.colour_by = gpu::colour_by_cover;
    }
    [[nodiscard]] std::ptrdiff_t lines_with(const std::string& words, const ShownGround* shown) const {
        return std::ranges::count_if(legend_lines(view, land, style, shown), [&](const std::string& line) {
            return line.find(words) != std::string::npos;
        });
    }
    const Region land = level_land(47.4, 9.2);
    View view = from_above(47.1, 9.5, 3000.0);
    Style style{};
};

// 400 rows of 45 degrees are 482.8 px a tangent: 12 m are 2 px to 2,897 m.
TEST_F(ShownGrowth, IsSaidWhereItIsDrawn) {
    ShownGround shown;
    shown.nearest_m = 2896.0, shown.eye_over_ground_m = 3000.0;
    EXPECT_EQ(lines_with("Trees: invented", &shown), 1);
    EXPECT_EQ(lines_with("Grass within 60 m", &shown), 0);
    shown.nearest_m = 2898.0;
    EXPECT_EQ(lines_with("Trees: invented", &shown), 0);
    shown.nearest_m = 59.0;
    EXPECT_EQ(lines_with("Grass within 60 m", &shown), 1);
    // Low in a forest, looking up: the ground is not in the picture, trees are.
    shown = {};
    shown.eye_over_ground_m = 2.0;
    EXPECT_EQ(lines_with("Trees: invented", &shown), 1);
    EXPECT_EQ(lines_with("Grass within 60 m", &shown), 0);
    EXPECT_EQ(lines_with("Trees: invented", nullptr), 1);
    EXPECT_EQ(lines_with("Ground cover: invented", &shown), 1);
    shown.under_images = true;
    EXPECT_EQ(lines_with("Ground cover: invented", &shown), 0);
    EXPECT_EQ(lines_with("clefts of rock", &shown), 0);
}

TEST_F(ShownGrowth, IsOnNoMap) {
    view.map = MapFrame{"EPSG:4326", {9.2, 0.001, 0.0, 47.4, 0.0, -0.001}, 400, 400};
    ShownGround shown;
    shown.nearest_m = shown.eye_over_ground_m = 1.0;
    EXPECT_EQ(lines_with("Trees: invented", &shown), 0);
    EXPECT_EQ(lines_with("Grass within 60 m", &shown), 0);
}

}  // namespace
}  // namespace oro

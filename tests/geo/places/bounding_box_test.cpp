#include <gtest/gtest.h>

#include "geo/region/region.h"
#include "geo/sources/hgt_source.h"

namespace oro {
namespace {

void expect_box(const Result<BoundingBox>& box, double west, double south, double east, double north) {
    ASSERT_TRUE(box.ok()) << box.error().line();
    EXPECT_EQ(box->west_deg, west);
    EXPECT_EQ(box->south_deg, south);
    EXPECT_EQ(box->east_deg, east);
    EXPECT_EQ(box->north_deg, north);
}

TEST(BoundingBox, FourNumbersInDegrees) {
    expect_box(parse_bounding_box("8,46,9,47"), 8, 46, 9, 47);
    expect_box(parse_bounding_box(" -84.5 , 36.25,-84,+36.5"), -84.5, 36.25, -84, 36.5);
    expect_box(parse_bounding_box("-180,-90,180,90"), -180, -90, 180, 90);
}

TEST(BoundingBox, WestBeyondEastCrossesTheAntimeridian) {
    expect_box(parse_bounding_box("175,-20,-175,-15"), 175, -20, -175, -15);
}

TEST(BoundingBox, BadTextIsOneUsageErrorThatNamesIt) {
    for (const char* text : {"",
                             "8",
                             "8,46,9",
                             "8,46,9,47,1",
                             "8,46,9,x",
                             "8;46;9;47",
                             "8,46,,47",
                             "nan,46,9,47",
                             "8,46,inf,47",
                             "8,-inf,9,47",
                             "8,47,9,46",
                             "8,46,9,46",
                             "8,46,8,47",
                             "180,0,-180,1",
                             "8,-91,9,47",
                             "8,46,9,90.5",
                             "-181,46,9,47",
                             "8,46,360,47",
                             "1e999,0,1,1",
                             "8,46,9,47 extra",
                             ",,,"}) {
        const auto box = parse_bounding_box(text);
        ASSERT_FALSE(box.ok()) << text;
        EXPECT_EQ(box.error().kind, ErrorKind::usage) << text;
        EXPECT_NE(box.error().line().find(std::string("'") + text + "'"), std::string::npos)
            << box.error().line();
        EXPECT_EQ(box.error().line().find('\n'), std::string::npos);
    }
}

TEST(BoundingBox, ControlCharactersStayOutOfTheMessage) {
    EXPECT_EQ(parse_bounding_box("8,46\n9,47").error().line().find('\n'), std::string::npos);
    EXPECT_EQ(parse_tile_range("N46\nE008").error().line().find('\n'), std::string::npos);
}

TEST(BoundingBox, ReversedBoxGetsTheOrderToldAgain) {
    EXPECT_NE(parse_bounding_box("8,47,9,46").error().line().find("west,south,east,north"),
              std::string::npos);
}

// Found: --at gave the hint, --bbox did not.
TEST(BoundingBox, LatitudeFirstGetsAHint) {
    EXPECT_NE(parse_bounding_box("36,-100,37,-99").error().line().find("-100,36,-99,37 may be meant"),
              std::string::npos);
    EXPECT_EQ(parse_bounding_box("136,-100,137,-99").error().line().find("may be meant"), std::string::npos);
    const auto swapped = with_latitude_first({46.0, 8.0, 47.0, 9.0});
    ASSERT_TRUE(swapped);
    EXPECT_EQ(bounding_box_text(*swapped), "8,46,9,47");
    EXPECT_FALSE(with_latitude_first({170.0, -20.0, 175.0, -15.0}));
    EXPECT_FALSE(with_latitude_first({47.0, 8.0, 46.0, 9.0}));
}

TEST(TileRange, OneTileAndRanges) {
    expect_box(parse_tile_range("N46E008"), 8, 46, 9, 47);
    expect_box(parse_tile_range("s46w066"), -66, -46, -65, -45);
    expect_box(parse_tile_range("N46E006:N47E010"), 6, 46, 11, 48);
    expect_box(parse_tile_range("N47E010:N46E006"), 6, 46, 11, 48);
    expect_box(parse_tile_range("S01W001:N00E000"), -1, -1, 1, 1);
}

TEST(TileRange, OverTheAntimeridianAndRoundTheWorld) {
    expect_box(parse_tile_range("N10E179:N10W180"), 179, 10, -179, 11);
    expect_box(parse_tile_range("N46E179"), 179, 46, 180, 47);
    expect_box(parse_tile_range("S90W180:N89E179"), -180, -90, 180, 90);
}

TEST(TileRange, BadNamesAreUsageErrors) {
    for (const char* text :
         {"", "N46", "N46E08", "N46E0080", "X46E008", "N46X008", "N4aE008", "N90E008", "S91E008", "N46E180",
          "N46W181", "N46E008:", ":N46E008", "N46E008:N47", "N46E008.hgt"}) {
        const auto box = parse_tile_range(text);
        ASSERT_FALSE(box.ok()) << text;
        EXPECT_EQ(box.error().kind, ErrorKind::usage) << text;
    }
}

TEST(TileName, IsWrittenAsItIsRead) {
    EXPECT_EQ(tile_name(46, 8), "N46E008");
    EXPECT_EQ(tile_name(-46, -66), "S46W066");
    EXPECT_EQ(tile_name(0, 0), "N00E000");
    for (int lat = -90; lat < 90; lat += 7) {
        for (int lon = -180; lon < 180; lon += 11) {
            const auto tile = parse_tile_name(tile_name(lat, lon));
            ASSERT_TRUE(tile.has_value()) << lat << " " << lon;
            EXPECT_EQ(tile->lat_deg, lat);
            EXPECT_EQ(tile->lon_deg, lon);
        }
    }
}

}  // namespace
}  // namespace oro

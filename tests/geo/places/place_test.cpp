#include "geo/places/place.h"

#include <gtest/gtest.h>

#include <GeographicLib/DMS.hpp>
#include <GeographicLib/Geohash.hpp>
#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace oro {
namespace {

struct Row {
    std::string text;
    double lat_deg;
    double lon_deg;
    std::string form;
    double tolerance_deg{1e-9};
};

// All of a form in one test: a process takes longer to start than a thousand texts to be read.
using Rows = std::vector<Row>;

class PlaceForms : public ::testing::TestWithParam<Rows> {};

void expect_read(const Row& row) {
    SCOPED_TRACE(row.text);
    const Result<Place> place = parse_place(row.text);
    ASSERT_TRUE(place.ok()) << place.error().line();
    EXPECT_NEAR(place->lat_deg, row.lat_deg, row.tolerance_deg);
    EXPECT_NEAR(place->lon_deg, row.lon_deg, row.tolerance_deg);
    EXPECT_EQ(place->form, row.form);
}

TEST_P(PlaceForms, AreRead) {
    for (const Row& row : GetParam()) expect_read(row);
}

// 46 + 34/60 + 35/3600 and 7 + 59/60 + 25/3600.
constexpr double jungfrau_lat = 46.576388888888889;
constexpr double jungfrau_lon = 7.990277777777778;

INSTANTIATE_TEST_SUITE_P(
    Degrees, PlaceForms,
    ::testing::Values(Rows{
        Row{"46.5763,7.9904", 46.5763, 7.9904, "degrees"}, Row{"46.5763 7.9904", 46.5763, 7.9904, "degrees"},
        Row{"46.5763, 7.9904", 46.5763, 7.9904, "degrees"},
        Row{"  46.5763 ,7.9904\n", 46.5763, 7.9904, "degrees"}, Row{"+46.5,-8.25", 46.5, -8.25, "degrees"},
        Row{"-33.5 -70", -33.5, -70, "degrees"},
        Row{"\u221233.5 \u221270", -33.5, -70, "degrees"},  // the typographic minus
        Row{"1e-5,-2.5E1", 1e-5, -25, "degrees"}, Row{"46.,.5", 46, .5, "degrees"},
        Row{"46,5", 46, 5, "degrees"},  // two whole numbers, not 46.5
        Row{"90,0", 90, 0, "degrees"}, Row{"-90,12", -90, 12, "degrees"}, Row{"0,180", 0, 180, "degrees"},
        Row{"0,-180", 0, 180, "degrees"}, Row{"0,-179.999", 0, -179.999, "degrees"}}));

INSTANTIATE_TEST_SUITE_P(DegreesMinutesSeconds, PlaceForms,
                         ::testing::Values(Rows{
                             Row{"46d34'35\"N 7d59'25\"E", jungfrau_lat, jungfrau_lon, "DMS"},
                             Row{"46°34'35″N 7°59'25″E", jungfrau_lat, jungfrau_lon, "DMS"},
                             Row{"46°34′35″N,7°59′25″E", jungfrau_lat, jungfrau_lon, "DMS"},
                             Row{"46°34’35”N 7°59’25”E", jungfrau_lat, jungfrau_lon, "DMS"},
                             Row{"46° 34' 35\" N 7° 59' 25\" E", jungfrau_lat, jungfrau_lon, "DMS"},
                             Row{"46° 34' 35\" N, 7° 59' 25\" E", jungfrau_lat, jungfrau_lon, "DMS"},
                             Row{"N 46° 34' 35\" E 7° 59' 25\"", jungfrau_lat, jungfrau_lon, "DMS"},
                             Row{"7°59'25\"E 46°34'35\"N", jungfrau_lat, jungfrau_lon, "DMS"},
                             Row{"46:34:35 7:59:25", jungfrau_lat, jungfrau_lon, "DMS"},
                             Row{"-46:34:35 -7:59:25", -jungfrau_lat, -jungfrau_lon, "DMS"},
                             Row{"46d34'35''S 7d59'25''W", -jungfrau_lat, -jungfrau_lon, "DMS"},
                             // GeographicLib 2.1, GeoCoords: spellings of Ar Ramadi Bridge.
                             Row{"N33d26.4'  E43d16.2'", 33.44, 43.27, "DMS"},
                             Row{"43d16'12\"E 33d26'24\"N", 33.44, 43.27, "DMS"},
                             Row{"43:16:12E  33:26:24", 33.44, 43.27, "DMS"}, Row{"46N 8E", 46, 8, "DMS"},
                             Row{"46 N 8 E", 46, 8, "DMS"}, Row{"46.5763N,7.9904E", 46.5763, 7.9904, "DMS"},
                             // A point, unlike the tile N46E008.
                             Row{"N46 E008", 46, 8, "DMS"}}));

// Literals: PROJ 9.1 through gdaltransform, EPSG:32632, 32732, 32638, 32661 and 32604 to 4326.
INSTANTIATE_TEST_SUITE_P(UtmUps, PlaceForms,
                         ::testing::Values(Rows{
                             Row{"32T 422000 5158000", 46.5710371631246, 7.98214422294598, "UTM/UPS"},
                             Row{"32N 422000 5158000", 46.5710371631246, 7.98214422294598, "UTM/UPS"},
                             Row{"32n,422000,5158000", 46.5710371631246, 7.98214422294598, "UTM/UPS"},
                             Row{"32north 422000 5158000", 46.5710371631246, 7.98214422294598, "UTM/UPS"},
                             Row{"422000 5158000 32N", 46.5710371631246, 7.98214422294598, "UTM/UPS"},
                             Row{"32S 422000 8000000", -18.0873008598801, 8.26284895632942, "UTM/UPS"},
                             Row{"32K 422000 8000000", -18.0873008598801, 8.26284895632942, "UTM/UPS"},
                             Row{"38n 339188 3701405", 33.4399979749709, 43.2700015710273, "UTM/UPS"},
                             Row{"4Q 612345.5 2356785.5", 21.3094825776779, -157.916814052525, "UTM/UPS"},
                             Row{"n 2100000 1900000", 88.726257367269, 45, "UTM/UPS"},
                             Row{"Z 2100000 1900000", 88.726257367269, 45, "UTM/UPS"},
                             Row{"south 2100000 2100000", -88.726257367269, 45, "UTM/UPS"}}));

// The square's centre: GeographicLib 2.1's documentation of GeoCoords gives 38SMB4484 = 38n 444500 3684500;
// the others with PROJ as above.
INSTANTIATE_TEST_SUITE_P(Mgrs, PlaceForms,
                         ::testing::Values(Rows{
                             Row{"32TMS2200058000", 46.5710417201837, 7.98215066244043, "MGRS"},
                             Row{"32T MS 22000 58000", 46.5710417201837, 7.98215066244043, "MGRS"},
                             Row{"32TMS 22000 58000", 46.5710417201837, 7.98215066244043, "MGRS"},
                             Row{"4QFJ1234556785", 21.3094825776779, -157.916814052525, "MGRS"},
                             Row{"32tls2200058000", 46.551997909969, 6.67799272677457, "MGRS"}}));

// ezs42 is 42.605 N 5.603 W in G. Niemeyer's description of the method; u4pruydqqvj is 57.64911 N 10.40744 E,
// his example of 2008.
INSTANTIATE_TEST_SUITE_P(Geohash, PlaceForms,
                         ::testing::Values(Rows{Row{"ezs42", 42.605, -5.603, "geohash", 5e-4},
                                                Row{"u4pruydqqvj", 57.64911, 10.40744, "geohash", 1e-5},
                                                // 20 bits by hand: 11010 00000 10011 00110; lon 1000001010 ->
                                                // 532/1024, lat 1100010... (even bits first)
                                                Row{"u0m6", 46.845703125, 7.55859375, "geohash"},
                                                Row{"geohash:GBSUV", 48.669, -4.329, "geohash", 5e-4}}));

INSTANTIATE_TEST_SUITE_P(Others, PlaceForms,
                         ::testing::Values(Rows{
                             Row{"N46E008", 46.5, 8.5, "tile cell"}, Row{"n46e008", 46.5, 8.5, "tile cell"},
                             Row{"S01W180", -0.5, -179.5, "tile cell"},
                             Row{"S90E179", -89.5, 179.5, "tile cell"}, Row{"N00E000", 0.5, 0.5, "tile cell"},
                             Row{"geo:46.57,7.99", 46.57, 7.99, "geo URI"},
                             Row{"GEO:-46.57,-7.99;CRS=WGS84;u=10", -46.57, -7.99, "geo URI"},
                             Row{"geo:46.57,7.99;name=Eiger", 46.57, 7.99, "geo URI"},
                             Row{"geo:46.57,7.99?z=11", 46.57, 7.99, "geo URI"}}));

TEST(Place, HeightComesFromGeoUriOnly) {
    const auto with = parse_place("geo:48.2010,16.3695,183");  // RFC 5870, section 6.1
    ASSERT_TRUE(with.ok()) << with.error().line();
    EXPECT_EQ(with->height_m, 183.0);
    EXPECT_EQ(parse_place("geo:48.2010,16.3695")->height_m, std::nullopt);
    EXPECT_EQ(parse_place("48.2010,16.3695")->height_m, std::nullopt);
}

struct Refusal {
    std::string text;
    std::string reason;  // a part of the line
};

using Refusals = std::vector<Refusal>;

class PlaceRefusals : public ::testing::TestWithParam<Refusals> {};

void expect_refused(const Refusal& refusal) {
    SCOPED_TRACE(refusal.text);
    const auto place = parse_place(refusal.text);
    ASSERT_FALSE(place.ok()) << place->form << ' ' << place->lat_deg << ' ' << place->lon_deg;
    EXPECT_EQ(place.error().kind, ErrorKind::usage);
    const std::string line = place.error().line();
    EXPECT_NE(line.find(refusal.reason), std::string::npos) << line;
    for (const char c : line) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << line;
}

TEST_P(PlaceRefusals, SayWhy) {
    for (const Refusal& refusal : GetParam()) expect_refused(refusal);
}

INSTANTIATE_TEST_SUITE_P(
    All, PlaceRefusals,
    ::testing::Values(Refusals{
        Refusal{"", "is empty"}, Refusal{" \t\n", "is empty"}, Refusal{"46.5", "is one number"},
        Refusal{"1234", "is one number"}, Refusal{"nan,nan", "names are not looked up"},
        Refusal{"nan nan", "names are not looked up"}, Refusal{"Hoher Riffler", "names are not looked up"},
        Refusal{"Grünhorn", "names are not looked up"}, Refusal{"nan", "no known form"},
        Refusal{"inf,0", "not an angle"}, Refusal{"1e999,0", "not an angle"},
        Refusal{"0x10,8", "not an angle"}, Refusal{"46.5,8.5x", "not an angle"},
        Refusal{"46.5,8.5 x", "not one angle"}, Refusal{"46.5,8.5,", "more than two"},
        Refusal{"46.5,", "nothing on one side"}, Refusal{",8.5", "nothing on one side"},
        Refusal{"46.5,8.5,1000", "geo:"}, Refusal{"46.5 8.5 9.5", "no known form"},
        Refusal{"46.5-1 8", "not an angle"},
        Refusal{"46\xE2\x80\x93"
                "1 8",
                "not an angle"},
        Refusal{"S-46 E8", "not an angle"}, Refusal{"46N 47N", "two latitudes"},
        Refusal{"7E 8E", "two longitudes"}, Refusal{"46d61' 8d", "61"}, Refusal{"46d34'60.5\" 8d", "60.5"},
        // Found by the fuzzer: GeographicLib 2.1.2 crashes on four components.
        Refusal{"46:36:34:346:36:34:35 7", "not an angle"}, Refusal{"1d2d3d4d5d,7", "not an angle"},
        Refusal{"46d35\",7d", "not an angle"}, Refusal{"46d34'35\"36 7d", "not an angle"},
        Refusal{"46.5d34' 7d", "place"}, Refusal{"34',7d", "not an angle"}, Refusal{"46:,7", "not an angle"},
        // out of range
        Refusal{"90.0001,8", "latitude 90.0001 is outside"}, Refusal{"200,8", "latitude 200 is outside"},
        Refusal{"95N 8E", "latitude 95 is outside"}, Refusal{"0,190", "write -170"},
        Refusal{"0,-190", "write 170"}, Refusal{"0,360", "write 0"}, Refusal{"0,400", "outside [-180, 180]"},
        Refusal{"0N 181E", "write -179"}, Refusal{"geo:91,0", "latitude 91"},
        Refusal{"geo:0,181", "longitude 181"},
        // swapped
        Refusal{"120.5,46.5", "swapped, 46.5,120.5"}, Refusal{"-157.9,21.3", "swapped, 21.3,-157.9"},
        Refusal{"geo:120.5,46.5", "swapped"},
        // decimal commas
        Refusal{"46,5763 7,9904", "decimal commas"}, Refusal{"46,5763,7,9904", "decimal commas"},
        Refusal{"46,5763;7,9904", "decimal commas"}, Refusal{"46,5763, 7,9904", "decimal commas"},
        Refusal{"46,5763 7,9904", "write points: 46.5763,7.9904"},
        Refusal{"-33,9, 18,4", "write points: -33.9,18.4"}, Refusal{"46,5763", "decimal mark"},
        Refusal{"46°34,5'N 7°59,4'E", "decimal marks"},
        // tiles
        Refusal{"N90E000", "no such tile"}, Refusal{"S91E000", "no such tile"},
        Refusal{"N46E180", "no such tile"}, Refusal{"N46W181", "no such tile"},
        Refusal{"n46e8", "not a tile's name"}, Refusal{"46n8e", "needs a space"},
        // grids
        Refusal{"32S 422000 4000000", "write 32south or 32north"},
        Refusal{"32P 422000 5158000", "outside the band P"}, Refusal{"61N 422000 5158000", "zone 61"},
        Refusal{"0N 422000 5158000", "zone 0"}, Refusal{"32N 5 5158000", "5"},
        Refusal{"32N 422000 nan", "no known form"}, Refusal{"32N 422000 99158000", "99158"},
        Refusal{"Y 2100000 1900000", "half Y"}, Refusal{"N 46 8", "46"},
        Refusal{"32TMS22000", "as many digits"}, Refusal{"32T MS 2200 58000", "as many digits"},
        Refusal{"32TZZ2258", "place"}, Refusal{"61TMS2258", "place"},
        Refusal{"32tms2200058000", "as a geohash"}, Refusal{"32T", "geohash"},
        // geohash and names
        Refusal{"U0M6", "small letters"}, Refusal{"gbsuv", "geohash:gbsuv"},
        Refusal{"bern", "names are not looked up"}, Refusal{"Zermatt", "names are not looked up"},
        Refusal{"BAY", "names are not looked up"}, Refusal{"geohash:", "1 to 18"},
        Refusal{"geohash:ail", "1 to 18"}, Refusal{"u0m6u0m6u0m6u0m6u0m", "no known form"},
        // geo URIs
        Refusal{"geo:", "not a geo URI"}, Refusal{"geo:46.5", "not a geo URI"},
        Refusal{"geo:46.5,", "not a number"}, Refusal{"geo:46.5,8.5x", "not a number"},
        Refusal{"geo:+46.5,8.5", "not a number"}, Refusal{"geo:46.5,8.5,1e3", "not a number"},
        Refusal{"geo:46.5,8.5,1,2", "not a geo URI"}, Refusal{"geo:46.5,8.5;crs=epsg2056", "epsg2056"},
        Refusal{"geo:0,0?q=46.5,8.5", "not a geo URI"},
        // characters
        Refusal{"46\n8", "character"}, Refusal{std::string("46,8\0", 5), "character"},
        Refusal{"46\x1b[31m,8", "\\x1b"}, Refusal{"四六,8", "character"}, Refusal{"46\xB0,8", "character"},
        Refusal{std::string(201, '4'), "too long"}}));

TEST(Place, NoSwapHintWhereLettersSayWhichIsWhich) {
    EXPECT_EQ(parse_place("120N 46E").error().what.find("swapped"), std::string::npos);
    EXPECT_EQ(parse_place("200,46").error().what.find("swapped"), std::string::npos);
    EXPECT_EQ(parse_place("120,100").error().what.find("swapped"), std::string::npos);
}

// Whatever GeographicLib writes for a random position is read back as that position, in each form.
TEST(Place, ReadsWhatGeographicLibWrites) {
    constexpr unsigned seed = 20240607;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> latitude(-90, 90);
    std::uniform_real_distribution<double> longitude(-180, 180);
    using namespace GeographicLib;
    for (int i = 0; i < 2000; ++i) {
        const double lat = latitude(random);
        const double lon = longitude(random);
        const auto expect = [&](const std::string& text, double metres, const std::string& form) {
            const auto place = parse_place(text);
            ASSERT_TRUE(place.ok()) << place.error().line();
            EXPECT_EQ(place->form, form) << text;
            const double degrees = metres / 111'000;
            EXPECT_NEAR(place->lat_deg, lat, degrees) << text;
            const double apart = std::remainder(place->lon_deg - lon, 360);
            EXPECT_NEAR(apart * std::cos(lat * Math::degree()), 0, degrees) << text;
        };
        expect(DMS::Encode(lat, DMS::SECOND, 6, DMS::LATITUDE) + ' ' +
                   DMS::Encode(lon, DMS::SECOND, 6, DMS::LONGITUDE),
               1e-4, "DMS");
        int zone = 0;
        bool north = false;
        double x = 0;
        double y = 0;
        UTMUPS::Forward(lat, lon, zone, north, x, y);
        char grid[100];
        std::snprintf(grid, sizeof grid, "%s %.6f %.6f", UTMUPS::EncodeZone(zone, north, false).c_str(), x,
                      y);
        expect(grid, 1e-4, "UTM/UPS");
        std::string square;
        MGRS::Forward(zone, north, x, y, lat, 5, square);
        expect(square, 1, "MGRS");
        std::string hash;
        Geohash::Forward(lat, lon, 12, hash);
        expect("geohash:" + hash, 0.1, "geohash");
    }
}

}  // namespace
}  // namespace oro

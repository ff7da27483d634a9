#include "geo/coordinates/crs_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "geo/places/geodesic.h"

namespace oro {
namespace {

CrsPlaces crs(const std::string& text) {
    Result<CrsPlaces> places = CrsPlaces::of(text);
    EXPECT_TRUE(places.ok()) << text << ": " << places.error().line();
    return std::move(places).value();
}

double metres_between(const Place& place, double lat_deg, double lon_deg) {
    return geodesic_between(place.lat_deg, place.lon_deg, lat_deg, lon_deg).distance_m;
}

TEST(CrsPlaces, PublishedPlaces) {
    // The origin of LV95, the old observatory of Bern: 46 57' 03.898" N, 7 26' 19.077" E. Source: swisstopo,
    // "Formulas and constants for the calculation of the Swiss cylindrical projection and for the
    // transformation between coordinate systems" (2016). The last digit is 3 cm.
    const Place bern = crs("EPSG:2056").place(2600000.0, 1200000.0).value();
    EXPECT_LT(metres_between(bern, 46.0 + 57.0 / 60 + 3.898 / 3600, 7.0 + 26.0 / 60 + 19.077 / 3600), 0.03);
    // What gdaltransform (GDAL 3.6.2, PROJ 9.1.1) says of it.
    EXPECT_LT(metres_between(bern, 46.9510827718711, 7.43863242087181), 0.001);
    const Place other = crs("EPSG:2056").place(2642950.0, 1166825.0).value();
    EXPECT_LT(metres_between(other, 46.6512836892845, 7.99970586595196), 0.001);
    EXPECT_EQ(bern.form, "EPSG:2056 CH1903+ / LV95");
    // On the middle meridian: 0.9996 of the meridian's arc from the equator to 45 degrees, 4,984,944.378 m.
    // Source: J. P. Snyder, "Map Projections: A Working Manual", USGS Professional Paper 1395 (1987), 3-21.
    const Place middle = crs("EPSG:32632").place(500000.0, 0.9996 * 4984944.378).value();
    EXPECT_LT(metres_between(middle, 45.0, 9.0), 0.001);
    const Place degrees = crs("EPSG:4326").place(7.5, 46.25).value();
    EXPECT_EQ(degrees.lat_deg, 46.25) << "the longitude comes first, whatever order EPSG:4326 states";
    EXPECT_EQ(degrees.lon_deg, 7.5);
    EXPECT_FALSE(crs("EPSG:4326").is_projected());
    EXPECT_TRUE(crs("EPSG:2056").is_projected());
}

// Two programs: PROJ here, GeographicLib in parse_place().
TEST(CrsPlaces, UtmIsGeographicLibs) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> east_m(170000.0, 830000.0), north_m(0.0, 9300000.0);
    for (int i = 0; i < 40; ++i) {
        const int zone = 1 + static_cast<int>(random() % 60);
        const double x = east_m(random), y = north_m(random);
        // Near the pole zones are narrower than that.
        const CrsPlaces utm =
            CrsPlaces::of("EPSG:" + std::to_string(32600 + zone), CrsPlaces::Reach::anywhere).value();
        const Place ours = utm.place(x, y).value();
        char text[80];
        std::snprintf(text, sizeof text, "%dnorth %.9f %.9f", zone, x, y);
        const auto theirs = parse_place(text);
        ASSERT_TRUE(theirs.ok()) << theirs.error().line();
        EXPECT_LT(metres_between(ours, theirs->lat_deg, theirs->lon_deg), 0.001) << text;
        const auto back = utm.coordinates(ours.lat_deg, ours.lon_deg);
        ASSERT_TRUE(back);
        EXPECT_NEAR((*back)[0], x, 0.001);
        EXPECT_NEAR((*back)[1], y, 0.001);
    }
}

TEST(CrsPlaces, WhatHasNoPlaceIsOneLine) {
    const auto refusal = [](const CrsPlaces& places, double x, double y) {
        const auto place = places.place(x, y);
        EXPECT_FALSE(place.ok()) << x << "," << y;
        if (place.ok()) return std::string();
        EXPECT_EQ(place.error().kind, ErrorKind::usage);
        EXPECT_EQ(place.error().line().find('\n'), std::string::npos);
        return place.error().line();
    };
    const CrsPlaces swiss = crs("EPSG:2056"), utm = crs("EPSG:32632"), degrees = crs("EPSG:4326");
    EXPECT_EQ(refusal(swiss, 642950.0, 166825.0),
              "642950,166825 is outside the area of use of EPSG:2056 CH1903+ / LV95");
    EXPECT_EQ(
        refusal(swiss, 1166825.0, 2642950.0),
        "1166825,2642950 is outside the area of use of EPSG:2056 CH1903+ / LV95; the easting comes first: "
        "the two may be swapped, 2642950,1166825");
    EXPECT_NE(refusal(utm, 2642950.0, 1166825.0).find("2642950,1166825 is outside the area of use"),
              std::string::npos);
    EXPECT_NE(refusal(utm, 1e12, 1e12).find("has no place in EPSG:32632"), std::string::npos);
    EXPECT_NE(refusal(degrees, 8.0, 91.0).find("has no place in EPSG:4326"), std::string::npos);
    // Data beyond the area keep their places.
    EXPECT_TRUE(CrsPlaces::of("EPSG:32632", CrsPlaces::Reach::anywhere)->place(1500000.0, 5200000.0).ok());
    for (const char* text : {"", "EPSG:999999", "nonsense", "EPSG:5728", "ENGCRS[\"x\"]"})
        EXPECT_FALSE(CrsPlaces::of(text).ok()) << text;
    // Of a compound CRS the horizontal part counts.
    EXPECT_LT(metres_between(crs("EPSG:2056+5728").place(2600000.0, 1200000.0).value(), 46.9510827718711,
                             7.43863242087181),
              0.001);
}

void expect_holds(const BoundingBox& box, double lat_deg, double lon_deg) {
    constexpr double slack_deg = 1e-9;  // 0.1 mm
    EXPECT_GE(lat_deg, box.south_deg - slack_deg);
    EXPECT_LE(lat_deg, box.north_deg + slack_deg);
    EXPECT_GE(lon_deg, box.west_deg - slack_deg);
    EXPECT_LE(lon_deg, box.east_deg + slack_deg);
}

// Brute force: places all over it and along its edges lie inside, and each side is reached to 1 mm.
TEST(CrsPlaces, TheBoxAroundABoxHoldsItAndNoMore) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const CrsPlaces places = CrsPlaces::of("EPSG:32632", CrsPlaces::Reach::anywhere).value();
    for (int i = 0; i < 10; ++i) {
        const double low_x = 200000.0 + 400000.0 * share(random),
                     low_y = 100000.0 + 8000000.0 * share(random);
        const double high_x = low_x + 1000.0 + 200000.0 * share(random),
                     high_y = low_y + 1000.0 + 200000.0 * share(random);
        const auto box = places.box(low_x, low_y, high_x, high_y);
        ASSERT_TRUE(box.ok()) << box.error().line();
        BoundingBox seen{1e9, 1e9, -1e9, -1e9};
        // 50 m apart: between two of them a side lies at most 0.2 mm beyond both, as parallels bend at 75
        // degrees.
        constexpr int of_side = 4000;
        for (int j = 0; j < 4 * of_side; ++j) {
            const int side = j / of_side;
            const double along = (j % of_side) / (of_side - 1.0);
            const double x = side == 0 ? low_x : side == 1 ? high_x : std::lerp(low_x, high_x, along);
            const double y = side < 2 ? std::lerp(low_y, high_y, along) : side == 2 ? low_y : high_y;
            const Place place = places.place(x, y).value();
            expect_holds(*box, place.lat_deg, place.lon_deg);
            seen = {std::min(seen.west_deg, place.lon_deg), std::min(seen.south_deg, place.lat_deg),
                    std::max(seen.east_deg, place.lon_deg), std::max(seen.north_deg, place.lat_deg)};
        }
        for (int j = 0; j < 100; ++j) {
            const Place place =
                places.place(std::lerp(low_x, high_x, share(random)), std::lerp(low_y, high_y, share(random)))
                    .value();
            expect_holds(*box, place.lat_deg, place.lon_deg);
        }
        constexpr double millimetre_deg = 1e-8;
        EXPECT_NEAR(box->west_deg, seen.west_deg, millimetre_deg);
        EXPECT_NEAR(box->south_deg, seen.south_deg, millimetre_deg);
        EXPECT_NEAR(box->east_deg, seen.east_deg, millimetre_deg);
        EXPECT_NEAR(box->north_deg, seen.north_deg, millimetre_deg);
    }
}

TEST(CrsPlaces, BoxesAroundAPoleAndOverTheAntimeridian) {
    // Polar stereographic, the pole in the middle.
    const BoundingBox pole = crs("EPSG:3413").box(-1000000.0, -1000000.0, 1000000.0, 1000000.0).value();
    EXPECT_EQ(pole.west_deg, -180.0);
    EXPECT_EQ(pole.east_deg, 180.0);
    EXPECT_EQ(pole.north_deg, 90.0);
    EXPECT_NEAR(pole.south_deg, 77.0, 0.3);
    // New Zealand's continental shelf, whose middle meridian is 173 E.
    const BoundingBox over = crs("EPSG:3851").box(3000000.0, 6000000.0, 4400000.0, 6500000.0).value();
    EXPECT_GT(over.west_deg, 160.0);
    EXPECT_LT(over.east_deg, -160.0);
    const BoundingBox degrees = crs("EPSG:4326").box(175.0, -20.0, -175.0, -15.0).value();
    EXPECT_NEAR(degrees.west_deg, 175.0, 1e-9);
    EXPECT_NEAR(degrees.east_deg, -175.0, 1e-9);
    EXPECT_FALSE(crs("EPSG:2056").box(2700000.0, 1100000.0, 2600000.0, 1200000.0).ok());
    EXPECT_FALSE(crs("EPSG:2056").box(2600000.0, 1200000.0, 2700000.0, 1100000.0).ok());
    EXPECT_FALSE(crs("EPSG:2056").box(600000.0, 100000.0, 700000.0, 200000.0).ok());
}

TEST(Coordinates, AsPeopleWriteThem) {
    using Two = std::optional<std::array<double, 2>>;
    const std::array<double, 2> eiger{2642950.0, 1166825.5};
    for (const char* text : {"2642950,1166825.5", " 2642950 , 1166825.5 ", "2642950 1166825.5",
                             "2642950   1166825.5", "2642950/1166825.5", "2'642'950 / 1'166'825.5",
                             "2\u2019642\u2019950, 1\u2019166\u2019825.5", "+2642950,+1166825.5"})
        EXPECT_EQ(two_coordinates(text), Two(eiger)) << text;
    for (const char* text :
         {"", "2642950", "2642950,", ",1", "1,2,3", "1 2 3", "N46E008", "46.5N,7.9E", "nan,1", "1e999,1",
          "2642950,1166825m", "'1,2", "1',2", "1,2;", "32T 422000 5158000", "geo:1,2", "+-1,2", "0x10,1"})
        EXPECT_EQ(two_coordinates(text), Two()) << text;
    EXPECT_EQ(four_coordinates("1,2, 3,4e1"), (std::optional<std::array<double, 4>>({1.0, 2.0, 3.0, 40.0})));
    EXPECT_FALSE(four_coordinates("1,2,3"));
    EXPECT_FALSE(four_coordinates("1,2,3,4,5"));
}

}  // namespace
}  // namespace oro

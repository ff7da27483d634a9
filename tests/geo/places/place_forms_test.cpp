// Places written in the forms of maps, read back by the parser of places.
#include "geo/places/place_forms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geo/places/place.h"

namespace {

// The Jungfrau's mapped summit. Source: GeographicLib's GeoConvert 2.1 -p 0: 32T 422629 5155128 of 46.53673,
// 7.99102 (46 32 12.23 N, 7 59 27.67 E).
TEST(PlaceForms, AreThoseOfMaps) {
    EXPECT_EQ(oro::dms_text(46.5, -7.25), "46°30'00.00\"N 7°15'00.00\"W");
    EXPECT_EQ(oro::dms_text(-0.0001, 179.9999999), "0°00'00.36\"S 180°00'00.00\"E");
    EXPECT_EQ(oro::mgrs_text(0.0, 3.0).substr(0, 5), "31NEA");
    EXPECT_EQ(oro::utm_text(0.0, 3.0), "31N 500000 0");
}

// Within a hundredth of a second of arc, or half a metre and a square's half diagonal; everywhere.
TEST(PlaceForms, AreReadBackAsThePlace) {
    std::mt19937 random(20261127);
    std::uniform_real_distribution<double> lat(-89.9, 89.9), lon(-179.9, 179.9);
    for (int i = 0; i < 2000; ++i) {
        const double lat_deg = lat(random), lon_deg = lon(random);
        for (const std::string& text : {oro::dms_text(lat_deg, lon_deg), oro::utm_text(lat_deg, lon_deg),
                                        oro::mgrs_text(lat_deg, lon_deg)}) {
            const auto place = oro::parse_place(text);
            ASSERT_TRUE(place.ok()) << text << ": " << place.error().line();
            const double north_m = (place->lat_deg - lat_deg) * 111'000.0;
            const double east_m = std::remainder(place->lon_deg - lon_deg, 360.0) * 111'000.0 *
                                  std::cos(lat_deg * 3.14159265358979 / 180.0);
            EXPECT_LT(std::hypot(north_m, east_m), 1.0) << text << " of " << lat_deg << "," << lon_deg;
        }
    }
}

}  // namespace

// Units of heights that a caller of the library names.
#include <gtest/gtest.h>

#include <string>

#include "apps/library/orograph.h"
#include "tests/support/test_data.h"

namespace {

// H of the bundled ground where its heights count in a unit; 0 with a failed expectation.
double height_m(const char* unit) {
    const std::string path = (oro::test::bundled_data() / "jacksboro.tif").string();
    const char* const paths[] = {path.c_str()};
    oro_open_options options = ORO_OPEN_OPTIONS;
    options.height_unit = unit;
    oro_region region = 0;
    EXPECT_EQ(oro_open(paths, 1, &options, nullptr, nullptr, &region), ORO_OK) << oro_error_text();
    const double lat_deg = 36.605, lon_deg = -84.176;
    double H_m = 0.0;
    EXPECT_EQ(oro_heights(region, 1, &lat_deg, &lon_deg, &H_m, nullptr), ORO_OK) << oro_error_text();
    EXPECT_EQ(oro_close(region), ORO_OK);
    return H_m;
}

// A foot has 0.3048 m, that of US surveys 1200/3937 m (NIST Special Publication 811, 2008, B.6). Heights are
// stored in float: 0.1 mm at 400 m.
TEST(LibraryHeightUnits, AreThoseOfTheProgram) {
    const double H_m = height_m("m");
    EXPECT_GT(H_m, 300.0);
    EXPECT_NEAR(height_m("ft"), 0.3048 * H_m, 1.0e-4);
    EXPECT_NEAR(height_m("us-ft"), 1200.0 / 3937.0 * H_m, 1.0e-4);
    EXPECT_NEAR(height_m("dm"), 0.1 * H_m, 1.0e-4);
    EXPECT_NEAR(height_m("cm"), 0.01 * H_m, 1.0e-4);
    EXPECT_NEAR(height_m("mm"), 0.001 * H_m, 1.0e-4);
}

TEST(LibraryHeightUnits, OthersAreRefused) {
    const std::string path = (oro::test::bundled_data() / "jacksboro.tif").string();
    const char* const paths[] = {path.c_str()};
    oro_open_options options = ORO_OPEN_OPTIONS;
    options.height_unit = "km";
    oro_region region = 1;
    EXPECT_EQ(oro_open(paths, 1, &options, nullptr, nullptr, &region), ORO_USAGE);
    EXPECT_EQ(region, 0U);
    EXPECT_STREQ(oro_error_text(), "height_unit: km is none of m, ft, us-ft, cm, dm, mm");
}

}  // namespace

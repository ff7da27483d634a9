// --coordinates: places and boxes in the coordinates of a CRS.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"

namespace {
using nlohmann::json;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::object_said_by;
using oro::test::run_orograph;
using oro::test::Words;

json place_of_sun(const Words& more) {
    return object_said_by(oro::test::joined({"sun", "--date", "2026-06-21", "--json"}, more)).at("place");
}

// The places are those of gdaltransform (GDAL 3.6.2, PROJ 9.1.1); 1e-8 degree is 1 mm.
TEST(CoordinatesOption, PlacesOfACrs) {
    const auto expect_place = [](const Words& words, double lat_deg, double lon_deg) {
        const json place = place_of_sun(words);
        EXPECT_NEAR(place.at("lat_deg").get<double>(), lat_deg, 1e-8) << words[1];
        EXPECT_NEAR(place.at("lon_deg").get<double>(), lon_deg, 1e-8) << words[1];
    };
    expect_place({"--at", "2600000,1200000", "--coordinates", "EPSG:2056"}, 46.9510827718711,
                 7.43863242087181);
    expect_place({"--at", "2'642'950 / 1'166'825", "--coordinates", "EPSG:2056"}, 46.6512836892845,
                 7.99970586595196);
    expect_place({"--at", "500000,4982950.4002", "--coordinates", "EPSG:32632"}, 45.0, 9.0);
    expect_place({"--at", "7.5,46.25", "--coordinates", "EPSG:4326"}, 46.25, 7.5);
    // Other forms stay what they are.
    expect_place({"--at", "N46E008", "--coordinates", "EPSG:2056"}, 46.5, 8.5);
    expect_place({"--at", "46d30'N 8d15'E", "--coordinates", "EPSG:2056"}, 46.5, 8.25);
}

TEST(CoordinatesOption, RefusalsAreOneLine) {
    const auto refused = [](const Words& more, const std::string& line) {
        expect_refusal(run_orograph(oro::test::joined({"sun"}, more)), oro::test::usage, {line});
    };
    refused({"--at", "642950,166825", "--coordinates", "EPSG:2056"},
            "--at 642950,166825: 642950,166825 is outside the area of use of EPSG:2056 CH1903+ / LV95");
    refused({"--at", "1166825,2642950", "--coordinates", "EPSG:2056"},
            "the easting comes first: the two may be swapped, 2642950,1166825");
    refused({"--at", "46.5,8.5", "--coordinates", "EPSG:2056"},
            "if these are degrees, leave --coordinates out");
    refused({"--at", "1,2", "--coordinates", "EPSG:999999"},
            "--coordinates EPSG:999999: is no coordinate reference system that PROJ knows; e.g. EPSG:2056");
    refused({"--at", "1,2", "--coordinates", "EPSG:5728"}, "--coordinates EPSG:5728:");
    refused({"--at", "1,2", "--coordinates", "source"}, "PATH: is missing");
    expect_refusal(run_orograph({"info", bundled(), "--coordinates", "EPSG:2056"}), oro::test::usage,
                   {"--coordinates EPSG:2056: says nothing without a place or --bbox"});
    expect_refusal(run_orograph({"info", bundled(), "--coordinates", "EPSG:32616", "--bbox", "1,2,3"}),
                   oro::test::usage, {"--bbox 1,2,3: needs four numbers: XMIN,YMIN,XMAX,YMAX in EPSG:32616"});
    expect_refusal(run_orograph({"info", bundled(), "--coordinates", "EPSG:32616", "--bbox", "3,2,1,4"}),
                   oro::test::usage, {"--bbox 3,2,1,4: is no box"});
}

// A box in UTM: the same posts as in the box of degrees around it.
TEST(CoordinatesOption, ABoxIsTheBoxOfDegreesAroundIt) {
    const auto region = [](const std::string& box, const std::string& crs) {
        Words words{"info", bundled(), "--json", "--bbox", box};
        if (!crs.empty()) words.insert(words.end(), {"--coordinates", crs});
        return object_said_by(words).at("region");
    };
    // NAD83 and WGS84 are taken as the same: the data's own degrees.
    EXPECT_EQ(region("-84.3,36.5,-84.2,36.6", "source"), region("-84.3,36.5,-84.2,36.6", ""));
    const json utm = region("740000,4045000,750000,4055000", "EPSG:32616").at("bbox");
    // Its corners by gdaltransform, the outermost of them; a post is 0.000833 degrees.
    const double post_deg = 0.000834;
    EXPECT_NEAR(utm[0].get<double>(), -84.31967895, post_deg);
    EXPECT_NEAR(utm[1].get<double>(), 36.51772124, post_deg);
    EXPECT_NEAR(utm[2].get<double>(), -84.20487197, post_deg);
    EXPECT_NEAR(utm[3].get<double>(), 36.61033407, post_deg);
}

// The highest post of the Swiss tile, by its coordinates in the file.
TEST(CoordinatesOption, SourceIsTheCrsOfTheData) {
    const auto file = oro::test::real_data("geotiff/N46E008_EPSG2056_f32_cog.tif");
    if (!file) GTEST_SKIP() << "needs geotiff";
    const json from = object_said_by({"sight", file->string(), "--json", "-q", "--coordinates", "source",
                                      "--from", "2652695,1154145", "--to", "46d42'N 8d18'E"})["from"];
    EXPECT_NEAR(from.at("lat_deg").get<double>(), 46.536526910, 1e-8);
    EXPECT_NEAR(from.at("lon_deg").get<double>(), 8.125552471, 1e-8);
    EXPECT_NEAR(from.at("H_m").get<double>(), 4107.896 + 2.0, 1e-3);
    const json line = object_said_by({"profile", file->string(), "--json", "-q", "--coordinates", "source",
                                      "--along", "2652695,1154145; 2655695,1158145"});
    // 3-4-5; LV95 stretches by 0.003 % there.
    EXPECT_NEAR(line.at("length_m").get<double>(), 5000.0, 0.5);
}

}  // namespace

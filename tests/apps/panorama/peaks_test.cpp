// A panorama from a summit of the Alps: names against GeographicLib and against orograph sight.
#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
using nlohmann::json;
using oro::test::object_said_by;
using oro::test::Words;
using oro::test::write_bytes;

struct Peak {
    const char* name;
    double lat_deg;
    double lon_deg;
};
// The highest posts of SRTM within 5 posts of the summits' published places.
constexpr Peak peaks[]{{"Schreckhorn", 46.5891667, 8.1183333},
                       {"Lauteraarhorn", 46.5866667, 8.1275},
                       {"Eiger", 46.5775, 8.005},
                       {"Mönch", 46.5583333, 7.9975},
                       {"Jungfrau", 46.5366667, 7.9625},
                       {"Aletschhorn", 46.465, 7.9941667},
                       {"Gross Fiescherhorn", 46.5516667, 8.0608333},
                       {"Gross Grünhorn", 46.5308333, 8.0775},
                       {"Gross Wannenhorn", 46.4933333, 8.0983333},
                       {"Wetterhorn", 46.6391667, 8.1158333},
                       {"Bietschhorn", 46.3925, 7.85},
                       {"Lauterbrunnen Breithorn", 46.4783333, 7.8766667},
                       {"Gspaltenhorn", 46.5125, 7.8308333},
                       {"Blüemlisalphorn", 46.4891667, 7.7725},
                       {"Balmhorn", 46.425, 7.6933333},
                       {"Doldenhorn", 46.4691667, 7.7341667},
                       {"Dammastock", 46.6433333, 8.4208333},
                       {"Galenstock", 46.6125, 8.4175},
                       {"Titlis", 46.7725, 8.4358333},
                       {"Sustenhorn", 46.6983333, 8.455},
                       {"Monte Leone", 46.25, 8.1108333},
                       {"Oberaarhorn", 46.5316667, 8.175},
                       {"Niesen", 46.6458333, 7.6525},
                       {"Tödi", 46.8116667, 8.915},
                       {"Weisshorn", 46.1016667, 7.7166667},
                       {"Dom", 46.095, 7.86},
                       {"Täschhorn", 46.0841667, 7.8575},
                       {"Weissmies", 46.1275, 8.0125},
                       {"Lagginhorn", 46.1575, 8.0033333},
                       {"Fletschhorn", 46.1675, 8.0025}};
constexpr double eye_lat_deg = 46.5366667, eye_lon_deg = 8.1258333;

std::string place(double lat_deg, double lon_deg) {
    char text[60];
    std::snprintf(text, sizeof text, "%.7f,%.7f", lat_deg, lon_deg);
    return text;
}

TEST(PanoramaPeaks, AreWhereGeographicLibHasThemAndNamedWhereTheyAreSeen) {
    const auto west = oro::test::real_data("alps/N46E007.SRTMGL3.hgt.zip"),
               east = oro::test::real_data("alps/N46E008.SRTMGL3.hgt.zip");
    if (!west || !east) GTEST_SKIP() << "needs alps/N46E007 and N46E008";
    const auto folder = oro::test::scratch_folder();
    json features = json::array();
    for (const Peak& peak : peaks)
        features.push_back(
            {{"type", "Feature"},
             {"properties", {{"name", peak.name}}},
             {"geometry", {{"type", "Point"}, {"coordinates", {peak.lon_deg, peak.lat_deg}}}}});
    const std::string file = (folder / "peaks.geojson").string();
    write_bytes(file, json{{"type", "FeatureCollection"}, {"features", features}}.dump());
    const Words words{"panorama", west->string(), east->string(), "--at", place(eye_lat_deg, eye_lon_deg),
                      "--width",  "2400",         "--names",      file,   "-q",
                      "--json",   "--out"};
    const auto said_of = [&](const std::string& name) {
        Words all = words;
        all.push_back((folder / name).string());
        return object_said_by(all);
    };
    const json said = said_of("p.png");
    EXPECT_EQ(said_of("p.svg")["names"], said["names"]);
    int named = 0, hidden = 0;
    double farthest_deg = 0.0;
    for (const Peak& peak : peaks) {
        const json* found = nullptr;
        for (const json& name : said["names"]["named"]) {
            if (name["name"] == peak.name) found = &name;
        }
        const json sight = object_said_by({"sight", west->string(), east->string(), "-q", "--json", "--from",
                                           place(eye_lat_deg, eye_lon_deg), "--to",
                                           place(peak.lat_deg, peak.lon_deg), "--target", "2"});
        EXPECT_EQ(found != nullptr, sight["visible"].get<bool>()) << peak.name;
        (found != nullptr ? named : hidden) += 1;
        if (found == nullptr) continue;
        double there_deg = 0.0, back_deg = 0.0;
        GeographicLib::Geodesic::WGS84().Inverse(eye_lat_deg, eye_lon_deg, peak.lat_deg, peak.lon_deg,
                                                 there_deg, back_deg);
        const double off_deg = std::remainder((*found)["azimuth_deg"].get<double>() - there_deg, 360.0);
        EXPECT_NEAR(off_deg, 0.0, 0.05) << peak.name;
        farthest_deg = std::max(farthest_deg, std::abs(off_deg));
    }
    std::printf("named %d, hidden %d, azimuths at most %.6f degrees off\n", named, hidden, farthest_deg);
    EXPECT_GE(named, 20);
    EXPECT_GE(hidden, 3);
    EXPECT_EQ(said["names"]["hidden"], hidden);
}

}  // namespace

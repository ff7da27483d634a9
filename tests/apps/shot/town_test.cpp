// Towns on the terrain, as users see them: CityJSON and footprints in pictures, picking, sight, profiles and
// viewsheds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/apps/layer_value.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;

constexpr double west_deg = -84.1765, east_deg = -84.1755, south_deg = 36.604, north_deg = 36.606;

// A hall 89 m by 222 m from 300 m to 420 m above sea level; the ground is at some 350 m. With an annex of 400
// m to the west of it, which is a part of the same building.
std::string hall_cityjson() {
    const auto box = [](int first) {
        const auto side = [&](std::array<int, 4> corners) {
            std::string text = "[[";
            for (const int corner : corners)
                text += std::to_string(first + corner) + (corner == corners[3] ? "" : ",");
            return text + "]]";
        };
        return "[[" + side({0, 3, 2, 1}) + "," + side({4, 5, 6, 7}) + "," + side({0, 1, 5, 4}) + "," +
               side({1, 2, 6, 5}) + "," + side({2, 3, 7, 6}) + "," + side({3, 0, 4, 7}) + "]]";
    };
    std::string vertices;
    const auto add_box = [&](double w, double e, double low_m, double high_m) {
        for (const double height_m : {low_m, high_m})
            for (const auto& [lon, lat] :
                 {std::pair{w, south_deg}, {e, south_deg}, {e, north_deg}, {w, north_deg}}) {
                std::ostringstream text;
                text.precision(10);
                text << "[" << lon << "," << lat << "," << height_m << "]";
                vertices += (vertices.empty() ? "" : ",") + text.str();
            }
    };
    add_box(west_deg, east_deg, 300.0, 420.0);
    add_box(west_deg - 0.0005, west_deg, 300.0, 400.0);
    const auto part = [&](const char* name, int first) {
        return std::string("\"") + name +
               R"(":{"type":"BuildingPart","parents":["h1"],"geometry":[{"type":"Solid","lod":"2","boundaries":)" +
               box(first) + "}]}";
    };
    return R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/4326"},)"
           R"("CityObjects":{"h1":{"type":"Building","attributes":{"name":"Town hall","year":1890},"children":["big","small"]},)" +
           part("big", 0) + "," + part("small", 8) + R"(},"vertices":[)" + vertices + "]}";
}

// The same hall alone as a footprint that is 70 m high from 350 m.
std::string hall_footprint() {
    return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"height":70,"floor":350,"name":"Hall"},)"
           R"("geometry":{"type":"Polygon","coordinates":[[[-84.1765,36.604],[-84.1755,36.604],[-84.1755,36.606],)"
           R"([-84.1765,36.606],[-84.1765,36.604]]]}}]})";
}

class Town : public ::testing::Test {
  protected:
    void SetUp() override {
        oro::test::write_bytes(city_, hall_cityjson());
        oro::test::write_bytes(footprints_, hall_footprint());
    }
    static json said_by(const Words& words) {
        const Outcome outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.exit_code == 0 ? json::parse(outcome.out) : json::object();
    }
    // From 620 m west of the hall, 40 m over the ground.
    json shot(const Words& more) const { return shot_from({"--above", "40", "--pitch", "-1"}, more); }
    json shot_from(const Words& eye, const Words& more) const {
        return said_by(joined(joined({"shot", bundled(), "--at", "36.605,-84.1834", "--heading", "90",
                                      "--size", "160x120", "--out", picture_, "--overwrite", "-q", "--json"},
                                     eye),
                              more));
    }

    const fs::path folder_ = oro::test::scratch_folder();
    const std::string city_ = (folder_ / "hall.city.json").string(),
                      footprints_ = (folder_ / "hall.geojson").string(),
                      picture_ = (folder_ / "town.png").string();
    const Words raised_{"--mesh-file", footprints_,       "--building-height",
                        "height",      "--building-base", "floor"};
};

// A mesh may be named as elevation data are; what is in the middle is picked with its building.
TEST_F(Town, PickingNamesTheBuilding) {
    const json said = shot({city_});
    const json feature = said["destination"]["feature"];
    EXPECT_EQ(feature["type"], "BuildingPart") << said.dump();
    EXPECT_EQ(feature["name"], "small") << "the annex stands before the hall";
    EXPECT_EQ(feature["part_of"], "h1");
    EXPECT_EQ(feature["attributes"]["name"], "Town hall");
    EXPECT_EQ(feature["attributes"]["year"], "1890");
    const json raised = shot(raised_);
    EXPECT_EQ(raised["destination"]["feature"]["name"], "Hall");
    EXPECT_EQ(raised["destination"]["feature"]["attributes"]["floor"], "350");
    EXPECT_FALSE(shot({})["destination"].contains("feature"));
}

TEST_F(Town, AnEyeInABuildingIsSaid) {
    const Words inside{"shot",
                       bundled(),
                       city_,
                       "--at",
                       "36.605,-84.17552",
                       "--heading",
                       "90",
                       "--pitch",
                       "0",
                       "--size",
                       "64x48",
                       "--overwrite",
                       "--out",
                       (folder_ / "in.png").string()};
    const std::string words = " before the eye, in the middle of the picture: --stand-on top stands on it";
    const Outcome in = run_orograph(joined(inside, {"--above", "2"}));
    EXPECT_EQ(in.exit_code, 0) << in.err;
    EXPECT_TRUE(says(in.err, "note: BuildingPart big of h1 is 1.8 m" + words)) << in.err;
    for (const Words& over : {Words{"--above", "200"}, Words{"--above", "2", "--stand-on", "top"}}) {
        const Outcome out = run_orograph(joined(inside, over));
        EXPECT_EQ(out.exit_code, 0) << out.err;
        EXPECT_FALSE(says(out.err, words)) << out.err;
    }
}

TEST_F(Town, ViewsKeepHowTheTownIsRead) {
    shot(raised_);
    const json view = json::parse(view_in(picture_));
    EXPECT_EQ(view["meshes"]["building_height"], "height");
    EXPECT_EQ(view["meshes"]["building_base"], "floor");
    const std::string again = (folder_ / "again.png").string();
    const Outcome redrawn = run_orograph({"shot", "--view", picture_, "--out", again, "--overwrite", "-q"});
    ASSERT_EQ(redrawn.exit_code, 0) << redrawn.err;
    EXPECT_EQ(json::parse(view_in(again))["fingerprints"]["pixels"], view["fingerprints"]["pixels"]);
    shot({city_, "--lod", "2"});
    EXPECT_EQ(json::parse(view_in(picture_))["meshes"]["lod"], "2");
}

// Whether a line from 402 m over the annex to a target clears the west edge of the hall's roof at 420 m.
// Points in ECEF by hand; the line stays within a metre of the edge's latitude.
bool clears_the_edge(double eye_lon, double target_lon, double target_h_m, double N_m) {
    using Place = std::array<long double, 3>;
    constexpr long double rad = 3.14159265358979323846L / 180.0L, lat = 36.605L * rad;
    const auto place = [](double lon_deg, double h_m) {
        const long double a = 6378137.0L, f = 1.0L / 298.257223563L, e2 = f * (2.0L - f);
        const long double lon = lon_deg * rad, n = a / sqrtl(1.0L - e2 * sinl(lat) * sinl(lat));
        return Place{(n + h_m) * cosl(lat) * cosl(lon), (n + h_m) * cosl(lat) * sinl(lon),
                     (n * (1.0L - e2) + h_m) * sinl(lat)};
    };
    const Place from = place(eye_lon, 402.0 + N_m), to = place(target_lon, target_h_m),
                foot = place(west_deg, 420.0 + N_m);
    const auto at = [&](long double share) {
        return Place{from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]),
                     from[2] + share * (to[2] - from[2])};
    };
    long double low = 0.0L, up = 1.0L;  // of the line, until it is over the wall's meridian
    for (int i = 0; i < 80; ++i) {
        const long double middle = 0.5L * (low + up);
        const Place there = at(middle);
        (atan2l(there[1], there[0]) < west_deg * rad ? low : up) = middle;
    }
    const Place over = at(low);
    const auto from_axis = [](const Place& p) { return sqrtl(p[0] * p[0] + p[1] * p[1]); };
    return (from_axis(over) - from_axis(foot)) * cosl(lat) + (over[2] - foot[2]) * sinl(lat) > 0.0L;
}

// From the annex's roof over the edge of the hall's roof: the line that just clears it, by a formula of its
// own. In the plane of the meridian frame at the eye, the edge is at 0.0001 degrees of longitude east of the
// eye (a parallel's arc) and 20 m higher; light is straight.
TEST_F(Town, SightPassesARoofsEdgeToACentimetre) {
    const double eye_lon = west_deg - 0.0001, target_lon = east_deg + 0.004;
    const auto ask = [&](double target_m) {
        char from[60], to[60], target[30];
        std::snprintf(from, sizeof from, "36.605,%.7f", eye_lon);
        std::snprintf(to, sizeof to, "36.605,%.7f", target_lon);
        std::snprintf(target, sizeof target, "%.4f", target_m);
        return said_by({"sight", bundled(), city_, "--from", from, "--to", to, "--above", "2", "--target",
                        target, "--stand-on", "top", "--refraction", "0", "-q", "--json"});
    };
    const json said = ask(0.0);
    ASSERT_EQ(said["visible"], false) << said.dump();
    EXPECT_NEAR(said["from"]["H_m"].get<double>(), 402.0, 0.001) << "2 m over the annex's roof";
    EXPECT_EQ(said["obstacle"]["feature"]["name"], "big");
    const double N_m = said["from"]["h_m"].get<double>() - said["from"]["H_m"].get<double>();
    double low = 0.0, least = 2000.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + least);
        (clears_the_edge(eye_lon, target_lon, middle, N_m) ? least : low) = middle;
    }
    const double ground_h_m = said["to"]["h_m"].get<double>();
    EXPECT_NEAR(said["target_missed_by_m"].get<double>(), least - ground_h_m, 0.01 * 450.0 / 8.9)
        << "m, a centimetre at the edge";
    EXPECT_EQ(ask(least - ground_h_m + 0.51)["visible"], true);
    EXPECT_EQ(ask(least - ground_h_m - 0.51)["visible"], false);
}

// Along the parallel through both: the annex's roof, then the hall's.
TEST_F(Town, ProfilesHaveASecondLine) {
    const std::string csv = (folder_ / "p.csv").string();
    const Words words{"profile", bundled(),    "--along", "36.605,-84.1775; 36.605,-84.1745",
                      "-q",      "--overwrite"};
    const json said = said_by(joined(words, {city_, "--out", csv, "--json"}));
    // 0.0015 degrees at 36.605 N are 134.2 m (a parallel of 5,126.7 km).
    EXPECT_NEAR(said["roofs"]["over_m"].get<double>(), 134.2, 0.3) << said.dump();
    EXPECT_NEAR(said["roofs"]["highest"]["H_m"].get<double>(), 420.0, 0.01);
    EXPECT_EQ(said["roofs"]["highest"]["on"], "BuildingPart big of h1");
    std::istringstream lines(bytes_of(csv));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "distance_m,lat_deg,lon_deg,H_m,h_m,top_H_m,top_h_m,on");
    int on_small = 0, on_big = 0, on_ground = 0;
    while (std::getline(lines, line)) {
        on_small += says(line, ",400.0") && says(line, "small") ? 1 : 0;
        on_big += says(line, "\"BuildingPart big of h1\"") ? 1 : 0;
        on_ground += line.ends_with(",,,") ? 1 : 0;
    }
    EXPECT_GE(on_small, 2);
    EXPECT_GE(on_big, 2);
    EXPECT_GE(on_ground, 4);
    // Without meshes nothing is told of roofs.
    EXPECT_FALSE(said_by(joined(words, {"--json"})).contains("roofs"));
}

// What the hall hides from 100 m over the ground, 30 m over its roof; posts on roofs are seen where targets
// stand on top.
TEST_F(Town, ViewshedsKnowRoofs) {
    const auto seen = [&](const Words& more) {
        return said_by(joined({"viewshed", bundled(), "--at", "36.605,-84.181", "--above", "100", "--radius",
                               "1.5", "--out", (folder_ / "v.tif").string(), "--overwrite", "-q", "--json"},
                              more));
    };
    const json bare = seen({}), with_hall = seen({city_}), on_roofs = seen({city_, "--target-on", "top"});
    EXPECT_EQ(bare["cells"], with_hall["cells"]);
    EXPECT_LT(with_hall["seen"].get<int>(), bare["seen"].get<int>()) << "the hall hides ground";
    EXPECT_GT(on_roofs["seen"].get<int>(), with_hall["seen"].get<int>()) << "roofs are seen over walls";
    expect_refusal(run_orograph({"viewshed", bundled(), "--at", "36.605,-84.181", "--target-on", "top",
                                 "--out", (folder_ / "w.tif").string(), "-q"}),
                   usage, {"--target-on top", "needs a mesh"});
}

TEST_F(Town, RefusesInOneLine) {
    const Words eye{"shot", bundled(), "--at", "36.605,-84.1834", "--above", "40", "-q", "--out", picture_};
    expect_refusal(run_orograph(joined(eye, {"--lod", "2"})), usage, {"--lod", "without --mesh-file"});
    expect_refusal(run_orograph(joined(eye, {city_, "--lod", "two"})), usage,
                   {"--lod two", "no level of detail"});
    expect_refusal(run_orograph(joined(eye, {"--mesh-file", footprints_, "--building-base", "floor"})), usage,
                   {"--building-base", "without --building-height"});
    expect_refusal(run_orograph(joined(eye, {"--mesh-file", footprints_})), 1,
                   {"hall.geojson", "--building-height FIELD"});
    expect_refusal(run_orograph(joined(eye, {"--mesh-file", footprints_, "--building-height", "hoehe"})),
                   usage, {"--building-height hoehe", "is no field", "height"});
    expect_refusal(run_orograph(joined(eye, {city_, "--building-height", "height"})), usage,
                   {"--building-height", "no --mesh-file holds any"});
    expect_refusal(run_orograph({"shot", city_, "--at", "36.605,-84.1834", "--out", picture_, "-q"}), usage,
                   {"hall.city.json", "name elevation data as well"});
    expect_refusal(run_orograph({"bake", city_, "--out", (folder_ / "x.oro").string(), "-q"}), usage,
                   {"hall.city.json", "name elevation data as well"});
    expect_refusal(run_orograph(joined(eye, {"--stand-on", "top"})), usage,
                   {"--stand-on top", "needs a mesh"});
}

// From above: the hall's roof in the sun, and its number.
TEST_F(Town, LayersKnowFeatures) {
    shot_from({"--above", "300", "--pitch", "-20"}, {city_, "--layers", "--sun", "180,50"});
    const auto layer = [&](const char* name, int x, int y) {
        const double value = oro::test::layer_value(folder_ / ("town." + std::string(name) + ".tif"), x, y);
        return std::isnan(value) ? -1.0 : value;
    };
    int roofs = 0, annex = 0;
    for (int y = 40; y < 80; ++y) {
        const double feature = layer("feature", 80, y), height_m = layer("height", 80, y);
        if (feature != 1.0 && feature != 2.0) continue;
        annex += feature == 2.0 ? 1 : 0;
        if (std::abs(height_m - 420.0) > 0.01) continue;
        ++roofs;
        EXPECT_EQ(feature, 1.0) << "the first part of the file";
        EXPECT_EQ(layer("shadow", 80, y), 1.0) << "a roof in the sun";
    }
    EXPECT_GE(roofs, 3);
    EXPECT_GE(annex, 1);
    EXPECT_EQ(layer("feature", 80, 118), -1.0) << "the ground before it";
    const Outcome info = oro::test::run_program({"gdalinfo", (folder_ / "town.feature.tif").string()});
    EXPECT_TRUE(says(info.out, "FEATURE_1=BuildingPart big of h1")) << info.out;
}

}  // namespace

// Buildings on footprints: the ground below them against many places of the true surface, literal heights of
// roofs and walls, and what is left out.
#include "geo/meshes/footprints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/truth/true_surface.h"
#include "geo/meshes/ground_below.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

double between(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

const BaseLift no_lift = [](std::span<const VectorPlace>, std::span<double>) -> Result<void> { return {}; };

// Polygons of 3 to 9 corners around a place, on 30 posts or less: 1,500 places of each are never below.
TEST(Footprints, TheLowestGroundIsExact) {
    const unsigned seed = 5204;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const HeightField field = test::rough_field(47.0, 8.0, 90, 90);
    const HeightField* const fields[] = {&field};
    const TrueSurface surface(field, 1.0, 1);
    double least_gap_m = 1.0e9, most_gap_m = 0.0;
    for (int round = 0; round < 80; ++round) {
        const double lat_deg = between(random, 46.945, 46.99), lon_deg = between(random, 8.01, 8.06);
        const double radius_deg = std::exp(between(random, std::log(2.0e-5), std::log(5.0e-3)));
        std::vector<VectorPlace> ring;
        const auto corners = 3 + random() % 7;
        for (std::size_t i = 0; i < corners; ++i) {
            const double angle =
                             2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners),
                         far = radius_deg * between(random, 0.3, 1.0);
            ring.push_back({lat_deg + far * std::sin(angle), lon_deg + far * std::cos(angle)});
        }
        const auto lowest_H_m = lowest_ground_H_m({ring}, fields);
        ASSERT_TRUE(lowest_H_m);
        double found_m = 1.0e9;
        for (int i = 0; i < 1500; ++i) {
            // In a triangle of the fan around the middle, often near its rim.
            const std::size_t side = random() % corners;
            const VectorPlace &a = ring[side], &b = ring[(side + 1) % corners];
            const double out = std::sqrt(between(random, 0.0, 1.0)), along = between(random, 0.0, 1.0);
            const auto h_m = surface.h_m(lat_deg + out * (std::lerp(a.lat_deg, b.lat_deg, along) - lat_deg),
                                         lon_deg + out * (std::lerp(a.lon_deg, b.lon_deg, along) - lon_deg));
            ASSERT_TRUE(h_m);
            found_m = std::min(found_m, *h_m);
        }
        const double N_m = field.undulation.N_m.empty() ? 0.0 : field.undulation.at_m(lat_deg, lon_deg);
        least_gap_m = std::min(least_gap_m, found_m - N_m - *lowest_H_m);
        most_gap_m = std::max(most_gap_m, (found_m - N_m - *lowest_H_m) / (radius_deg * 111000.0));
    }
    EXPECT_GE(least_gap_m, -1.0e-3) << "m: a place below what was said";
    EXPECT_LE(most_gap_m, 0.15) << "of the radius: what was said is far below all that was found";
}

// A footprint of 4 corners near the middle of a field of plain 400 m.
std::string footprint(double side_deg, const std::string& properties) {
    const auto at = [&](double east, double north) {
        return "[" + std::to_string(8.03 + east) + "," + std::to_string(46.97 + north) + "]";
    };
    return test::feature("Polygon",
                         "[[" + at(0, 0) + "," + at(side_deg, 0) + "," + at(side_deg, side_deg) + "," +
                             at(0, side_deg) + "," + at(0, 0) + "]]",
                         properties);
}

HeightField plain_400() {
    HeightField field = test::rough_field(47.0, 8.0, 90, 90);
    std::ranges::fill(field.H_m, 400.0F);
    return field;
}

TEST(Footprints, RoofsAndWallsAreWhereFieldsSay) {
    const HeightField field = plain_400();
    const HeightField* const fields[] = {&field};
    const std::string path = test::written(
        "town.geojson", test::collection(footprint(0.0002, R"("height":12.5,"name":"Mill","floor":380)") +
                                         "," + footprint(0.0003, R"("height":"7 m","floor":410.25)")));
    const auto on_ground = buildings_on_footprints(path, {"height", ""}, fields, no_lift);
    ASSERT_TRUE(on_ground.ok()) << on_ground.error().line();
    ASSERT_EQ(on_ground->features.size(), 2U);
    EXPECT_EQ(on_ground->features[0].name, "Mill");
    EXPECT_EQ(on_ground->features[1].name, "2") << "the number of its record";
    EXPECT_EQ(on_ground->triangles.size(), 2U * (8U + 2U));
    EXPECT_EQ(on_ground->vertices[0].z, 412.5);
    EXPECT_EQ(on_ground->vertices[1].z, 399.5) << "half a metre below the ground";
    EXPECT_EQ(on_ground->vertices[8].z, 407.0);
    const auto on_base = buildings_on_footprints(path, {"HEIGHT", "floor"}, fields, no_lift);
    ASSERT_TRUE(on_base.ok()) << on_base.error().line();
    EXPECT_EQ(on_base->vertices[0].z, 392.5);
    EXPECT_EQ(on_base->vertices[1].z, 380.0) << "the base is below the ground";
    EXPECT_EQ(on_base->vertices[8].z, 417.25);
    EXPECT_EQ(on_base->vertices[9].z, 399.5);
}

// 0.3048 m a foot; "m" behind a number means metres in any case.
TEST(Footprints, AUnitScalesHeightsAndBases) {
    const HeightField field = plain_400();
    const HeightField* const fields[] = {&field};
    const std::string path = test::written(
        "feet.geojson", test::collection(footprint(0.0002, R"("height":100,"floor":1300)") + "," +
                                         footprint(0.0003, R"("height":"7 m","floor":"405 m")")));
    const auto in_feet = buildings_on_footprints(path, {"height", "floor", 0.3048, 0.3048}, fields, no_lift);
    ASSERT_TRUE(in_feet.ok()) << in_feet.error().line();
    EXPECT_NEAR(in_feet->vertices[0].z, 426.72, 1.0e-9) << "m: 1,400 ft";
    EXPECT_NEAR(in_feet->vertices[1].z, 396.24, 1.0e-9) << "m: 1,300 ft, below the ground";
    EXPECT_NEAR(in_feet->vertices[8].z, 412.0, 1.0e-9) << "m";
    const std::string other =
        test::written("other.geojson", test::collection(footprint(0.0002, R"("height":12000)") + "," +
                                                        footprint(0.0002, R"("height":9999)")));
    const auto in_mm = buildings_on_footprints(other, {"height", "", 0.001}, fields, no_lift);
    ASSERT_TRUE(in_mm.ok()) << in_mm.error().line();
    EXPECT_NEAR(in_mm->vertices[0].z, 412.0, 1.0e-9) << "m";
    EXPECT_EQ(in_mm->features.size(), 2U) << "9,999 mm are a height";
    EXPECT_FALSE(buildings_on_footprints(other, {"height", "", 0.3048}, fields, no_lift).ok())
        << "9,999 ft stand for none, and so do 12,000";
}

// Bases of 402 and 406 m over ground of 400 m.
TEST(Footprints, HowBasesLieIsTold) {
    const HeightField field = plain_400();
    const HeightField* const fields[] = {&field};
    const std::string path = test::written(
        "bases.geojson", test::collection(footprint(0.0002, R"("height":10,"floor":402)") + "," +
                                          footprint(0.0003, R"("height":10,"floor":402)") + "," +
                                          footprint(0.0003, R"("height":10,"floor":406)")));
    const auto on_base = buildings_on_footprints(path, {"height", "floor"}, fields, no_lift);
    ASSERT_TRUE(on_base.ok()) << on_base.error().line();
    EXPECT_EQ(on_base->notes,
              (std::vector<std::string>{"its bases lie 2.0 m over the terrain in the median"}));
    EXPECT_TRUE(buildings_on_footprints(path, {"height", ""}, fields, no_lift)->notes.empty())
        << "they lie on the ground";
}

TEST(Footprints, WhatHasNoHeightIsLeftOutAndCounted) {
    const HeightField field = plain_400();
    const HeightField* const fields[] = {&field};
    std::string features;
    for (const char* height : {"0", "-3", "9999", "\"\"", "\"tall\"", "null", "1200", "5"})
        features += footprint(0.0002, std::string("\"height\":") + height) + ",";
    features += test::feature("Polygon", "[[[9,50],[9.001,50],[9,50.001],[9,50]]]", R"("height":5)");
    const auto mesh = buildings_on_footprints(test::written("some.geojson", test::collection(features)),
                                              {"height", ""}, fields, no_lift);
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->features.size(), 2U);
    const auto has = [&](const std::string& note) {
        return std::ranges::find(mesh->notes, note) != mesh->notes.end();
    };
    EXPECT_TRUE(has("6 footprints left out, without a height above 0 and below 9,999 m"));
    EXPECT_TRUE(has("1 footprint left out, without ground below"));
    EXPECT_TRUE(has("1 building higher than 1,000 m: is its height in metres?"));
}

// A bow tie becomes two triangles; a line that goes there and back nothing.
TEST(Footprints, CrossingOnesAreMadeValid) {
    const HeightField field = plain_400();
    const HeightField* const fields[] = {&field};
    const auto mesh = buildings_on_footprints(
        test::written(
            "bow.geojson",
            test::collection(
                test::feature("Polygon",
                              "[[[8.03,46.97],[8.031,46.971],[8.031,46.97],[8.03,46.971],[8.03,46.97]]]",
                              R"("height":5)") +
                "," +
                test::feature("Polygon",
                              "[[[8.03,46.97],[8.031,46.971],[8.032,46.972],[8.031,46.971],[8.03,46.97]]]",
                              R"("height":5)"))),
        {"height", ""}, fields, no_lift);
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->triangles.size(), 2U * (6U + 1U)) << "two prisms of three sides";
    EXPECT_EQ(mesh->polygons_crossing, 0U);
}

TEST(Footprints, ErrorsAreToldInOneLine) {
    const HeightField field = plain_400();
    const HeightField* const fields[] = {&field};
    const auto why = [&](const std::string& text, const FootprintFields& asked) {
        const auto read = buildings_on_footprints(test::written("e.geojson", text), asked, fields, no_lift);
        return read.ok() ? "" : read.error().line();
    };
    EXPECT_NE(why(test::collection(footprint(0.0002, R"("hoehe":5,"name":"a")")), {"height", ""})
                  .find("--building-height height: is no field of e.geojson: it has hoehe, name"),
              std::string::npos);
    EXPECT_NE(why(test::collection(footprint(0.0002, R"("height":null,"name":"a")")), {"height", ""})
                  .find("--building-height height: has no value in any footprint of e.geojson"),
              std::string::npos);
    EXPECT_NE(why(test::collection(footprint(0.0002, R"("height":0)")), {"height", ""})
                  .find("has no building: 1 footprint left out"),
              std::string::npos);
    const auto elsewhere = buildings_on_footprints(
        test::written("e.geojson", test::collection(footprint(0.0002, R"("height":5)"))), {"height", ""},
        fields, no_lift, {"EPSG:2056", {}});
    EXPECT_NE(elsewhere.error().line().find("without ground below; is --mesh-crs right?"), std::string::npos);
    EXPECT_NE(why(test::collection(test::feature("Point", "[8,47]", R"("height":5)")), {"height", ""})
                  .find("has no polygons"),
              std::string::npos);
}

}  // namespace
}  // namespace oro

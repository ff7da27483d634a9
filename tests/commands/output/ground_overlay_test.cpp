// A map as KML lays it on the ground.
#include "apps/output/ground_overlay.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace oro {
namespace {

MapFrame frame(const std::string& crs, double left, double top, double pixel, int width_px, int height_px) {
    return {crs, {left, pixel, 0.0, top, 0.0, -pixel}, width_px, height_px};
}

// All numbers within an element.
std::vector<double> numbers_in(const std::string& kml, const std::string& element) {
    const std::size_t begin = kml.find("<" + element + ">"), end = kml.find("</" + element + ">");
    std::vector<double> numbers;
    if (begin == std::string::npos || end == std::string::npos) return numbers;
    std::string text = kml.substr(begin + element.size() + 2, end - begin - element.size() - 2);
    for (std::size_t at = 0; at < text.size();) {
        double number = 0.0;
        int length = 0;
        if (std::sscanf(text.c_str() + at, "%lf%n", &number, &length) != 1) break;
        numbers.push_back(number);
        at += static_cast<std::size_t>(length);
        if (at < text.size() && text[at] == ',') ++at;
    }
    return numbers;
}

void expect_numbers(const std::string& kml, const std::string& element, const std::vector<double>& expected,
                    double slack) {
    const std::vector<double> found = numbers_in(kml, element);
    ASSERT_EQ(found.size(), expected.size()) << element << " in " << kml;
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], slack) << element << " " << i;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// 8 to 8.5 E, 46.8 to 47 N. Its lower corners are 22.07 km from the middle, by chords of the ellipsoid: three
// times that.
TEST(GroundOverlays, OfMapsInDegreesAreBoxes) {
    const MapFrame map = frame("EPSG:4326", 8.0, 47.0, 0.001, 500, 200);
    const auto overlay = ground_overlay(map, 0, "a&b \xC3\xA9.png", "Survey & Co");
    ASSERT_TRUE(overlay.ok()) << overlay.error().line();
    EXPECT_LT(overlay->off_px, 1e-6);
    const std::string& kml = overlay->kml;
    for (const char* part :
         {"<name>a&amp;b \xC3\xA9.png</name>", "<description>Survey &amp; Co</description>",
          "<Icon><href>a%26b%20%C3%A9.png</href></Icon>", "<tilt>0.000000000</tilt>",
          "<altitudeMode>clampToGround</altitudeMode></LookAt>"})
        EXPECT_TRUE(has(kml, part)) << part << " in " << kml;
    expect_numbers(kml, "north", {47.0}, 1e-8);
    expect_numbers(kml, "south", {46.8}, 1e-8);
    expect_numbers(kml, "west", {8.0}, 1e-8);
    expect_numbers(kml, "east", {8.5}, 1e-8);
    expect_numbers(kml, "longitude", {8.25}, 1e-8);
    expect_numbers(kml, "latitude", {46.9}, 1e-8);
    expect_numbers(kml, "heading", {0.0}, 1e-6);
    expect_numbers(kml, "range", {66213.6}, 1.0);
    EXPECT_FALSE(has(kml, "LatLonQuad"));
    // A strip of 50 pixels is 0.05 degree; the look stays on the map's middle.
    const auto with_strip = ground_overlay(map, 50, "a.png", "");
    ASSERT_TRUE(with_strip.ok()) << with_strip.error().line();
    expect_numbers(with_strip->kml, "south", {46.75}, 1e-8);
    expect_numbers(with_strip->kml, "latitude", {46.9}, 1e-8);
    EXPECT_FALSE(has(with_strip->kml, "description"));
}

// East is greater than west, as KML wants it: past 180 where the map is.
TEST(GroundOverlays, GoPastTheAntimeridian) {
    const auto overlay = ground_overlay(frame("EPSG:4326", 179.5, 10.0, 0.01, 120, 100), 0, "a.png", "");
    ASSERT_TRUE(overlay.ok()) << overlay.error().line();
    expect_numbers(overlay->kml, "longitude", {-179.9}, 1e-8);
    expect_numbers(overlay->kml, "west", {-180.5}, 1e-8);
    expect_numbers(overlay->kml, "east", {-179.3}, 1e-8);
    const auto world = ground_overlay(frame("EPSG:4326", -180.0, 90.0, 1.0, 360, 180), 0, "a.png", "");
    ASSERT_TRUE(world.ok()) << world.error().line();
    expect_numbers(world->kml, "west", {-180.0}, 1e-8);
    expect_numbers(world->kml, "east", {180.0}, 1e-8);
    expect_numbers(world->kml, "south", {-90.0}, 1e-8);
}

// 30 km by 20 km from the projection's origin to the east and south. Corners by gdaltransform of GDAL 3.6 to
// OGC:CRS84, lower left first, counter-clockwise; the upper left one is swisstopo's 46 57 03.898 N, 7 26
// 19.077 E. How far off: by the same program on a grid of 41 x 41, 18.888 m, as a parallel leaves the line
// between two of its places by w^2 tan(latitude) / (8 R) = 18.9 m in the middle of w = 30 km.
TEST(GroundOverlays, OfProjectedMapsAreQuadrilaterals) {
    const auto overlay =
        ground_overlay(frame("EPSG:2056", 2600000.0, 1200000.0, 25.0, 1200, 800), 0, "a.png", "");
    ASSERT_TRUE(overlay.ok()) << overlay.error().line();
    EXPECT_NEAR(overlay->off_px, 18.888 / 25.0, 0.002);
    EXPECT_FALSE(has(overlay->kml, "LatLonBox"));
    expect_numbers(overlay->kml, "coordinates",
                   {7.438635592, 46.771176802, 7.831399818, 46.770504104, 7.832712748, 46.950407851,
                    7.438632421, 46.951082772},
                   2e-8);
    expect_numbers(overlay->kml, "longitude", {7.635345827}, 2e-8);
    expect_numbers(overlay->kml, "latitude", {46.860962747}, 2e-8);
    // Clockwise from north, where up is on the map: east of the origin, grid north lies to the east.
    expect_numbers(overlay->kml, "heading", {0.1430615}, 1e-5);
    EXPECT_TRUE(has(overlay->kml, "xmlns:gx=\"http://www.google.com/kml/ext/2.2\"")) << overlay->kml;
}

// What the pages say of maps in EPSG:2056: 19 m off where they are 30 km wide, 209 m of 100 km.
TEST(GroundOverlays, AreOffByTheSquareOfTheWidth) {
    for (const auto& [width_px, off_m] : {std::pair{1200, 18.94}, {4000, 209.4}}) {
        const auto overlay = ground_overlay(
            frame("EPSG:2056", 2600000.0, 1200000.0, 25.0, width_px, width_px), 0, "a.png", "");
        ASSERT_TRUE(overlay.ok()) << overlay.error().line();
        EXPECT_NEAR(overlay->off_px * 25.0, off_m, 0.1);
    }
}

// Corners of Mercator are a box; its rows do not lie evenly in degrees.
TEST(GroundOverlays, OfMercatorAreNoBoxes) {
    const auto overlay =
        ground_overlay(frame("EPSG:3857", 800000.0, 5900000.0, 100.0, 1000, 1000), 0, "a.png", "");
    ASSERT_TRUE(overlay.ok()) << overlay.error().line();
    EXPECT_TRUE(has(overlay->kml, "<gx:LatLonQuad>")) << overlay->kml;
    EXPECT_GT(overlay->off_px, 1.0);
    EXPECT_LT(overlay->off_px, 2.0);
}

// A pole in the middle of a map in UPS; a strip below the south pole.
TEST(GroundOverlays, RefuseWhatCornersDoNotHold) {
    const auto pole =
        ground_overlay(frame("EPSG:5041", 1000000.0, 3000000.0, 2000.0, 1000, 1000), 0, "a.png", "");
    ASSERT_FALSE(pole.ok());
    EXPECT_EQ(pole.error().kind, ErrorKind::usage);
    EXPECT_TRUE(has(pole.error().line(), "--kml: a GroundOverlay cannot show this map: it does not lie"))
        << pole.error().line();
    const auto strip = ground_overlay(frame("EPSG:4326", -180.0, 90.0, 1.0, 360, 180), 20, "a.png", "");
    ASSERT_FALSE(strip.ok());
    EXPECT_TRUE(has(strip.error().line(), "has no place on the Earth")) << strip.error().line();
}

}  // namespace
}  // namespace oro

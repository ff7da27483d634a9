// STAC items of pictures and maps.
#include "apps/output/stac_item.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/output/pose_files.h"

namespace oro {
namespace {
using nlohmann::json;

View level_view() {
    View view;
    view.camera.eye = {46.5, 188.0, 1050.0};
    view.camera.attitude = {-155.0, -4.0, 3.0};
    view.camera.vertical_fov_deg = 45.0;
    view.time_utc_s = 0;
    return view;
}

View map_view(const std::string& crs, const std::array<double, 6>& crs_from_pixel, int width_px,
              int height_px) {
    View view;
    view.map = MapFrame{crs, crs_from_pixel, width_px, height_px};
    return view;
}

json item_of(const View& view, const std::string& name = "a.tif") {
    return json::parse(
        stac_item_json(view, name, {{"picture", name, picture_media_type(name, true), "visual"}}));
}

// What the item specification 1.0.0 wants of each, and the eye in three numbers.
TEST(StacItems, OfPicturesStandAtTheEye) {
    const auto texts = pose_texts("x/p q.png", {true, true, true}, level_view(), {.N_m = 50.0});
    ASSERT_TRUE(texts.ok()) << texts.error().line();
    ASSERT_EQ(texts->size(), 3U);
    EXPECT_EQ((*texts)[2].file, "x/p q.stac.json");
    EXPECT_EQ(json::parse((*texts)[2].text), json::parse(R"({
        "type": "Feature", "stac_version": "1.0.0",
        "stac_extensions": ["https://stac-extensions.github.io/view/v1.0.0/schema.json"],
        "id": "p q",
        "geometry": {"type": "Point", "coordinates": [-172.0, 46.5, 1050.0]},
        "bbox": [-172.0, 46.5, 1050.0, -172.0, 46.5, 1050.0],
        "properties": {"datetime": "1970-01-01T00:00:00Z", "view:azimuth": 205.0, "view:off_nadir": 86.0,
                       "orograph:heading_deg": -155.0, "orograph:pitch_deg": -4.0, "orograph:roll_deg": 3.0,
                       "orograph:fov_deg": 45.0},
        "links": [],
        "assets": {
          "picture": {"href": "./p%20q.png", "type": "image/png", "roles": ["visual"]},
          "kml": {"href": "./p%20q.kml", "type": "application/vnd.google-earth.kml+xml", "roles": ["metadata"]},
          "geopose": {"href": "./p%20q.geopose.json", "type": "application/json", "roles": ["metadata"]}}})"));
}

// The extension's off-nadir angle ends at level; the sun's azimuth is 0 to 360.
TEST(StacItems, SayWhatTheExtensionHas) {
    View view = level_view();
    view.camera.attitude.pitch_deg = 5.0;
    view.sun = SunDirection{};
    view.sun->azimuth_deg = -45.0;
    view.sun->elevation_deg = 38.0;
    const json properties = item_of(view)["properties"];
    EXPECT_FALSE(properties.contains("view:off_nadir"));
    EXPECT_EQ(properties["view:sun_azimuth"], 315.0);
    EXPECT_EQ(properties["view:sun_elevation"], 38.0);
}

// E 2,600,000 N 1,200,000 of EPSG:2056 is 46.951083 N 7.438632 E (swisstopo's formulas).
TEST(StacItems, OfMapsHaveTheirOutlineAndTheirPixels) {
    const json item = item_of(map_view("EPSG:2056", {2600000.0, 50.0, 0.0, 1200000.0, 0.0, -50.0}, 100, 80));
    EXPECT_EQ(item["properties"]["proj:epsg"], 2056);
    EXPECT_EQ(item["properties"]["proj:shape"], json::parse("[80, 100]"));
    EXPECT_EQ(item["properties"]["proj:transform"],
              json::parse("[50.0, 0.0, 2600000.0, 0.0, -50.0, 1200000.0]"));
    EXPECT_EQ(item["assets"]["picture"]["type"], "image/tiff; application=geotiff");
    const json ring = item["geometry"]["coordinates"][0];
    ASSERT_EQ(item["geometry"]["type"], "Polygon");
    EXPECT_EQ(ring.front(), ring.back());
    EXPECT_NEAR(item["bbox"][0].get<double>(), 7.438632, 1e-4);
    EXPECT_NEAR(item["bbox"][3].get<double>(), 46.951083, 1e-4);
    double twice_area = 0.0;  // above 0: counter-clockwise (RFC 7946, 3.1.6)
    for (std::size_t i = 0; i + 1 < ring.size(); ++i)
        twice_area += ring[i][0].get<double>() * ring[i + 1][1].get<double>() -
                      ring[i + 1][0].get<double>() * ring[i][1].get<double>();
    // 5 km by 4 km there are 0.0657 by 0.0360 degrees.
    EXPECT_NEAR(twice_area / 2.0, 0.0657 * 0.0360, 1e-5);
}

// RFC 7946, 3.1.9 and 5.2: cut at the meridian, and a box whose west is more than its east.
TEST(StacItems, OfMapsOverTheAntimeridianAreInTwoParts) {
    const json item = item_of(map_view("EPSG:4326", {179.0, 0.01, 0.0, 10.0, 0.0, -0.01}, 300, 100));
    EXPECT_EQ(item["geometry"]["type"], "MultiPolygon");
    ASSERT_EQ(item["geometry"]["coordinates"].size(), 2U);
    double west = 180.0, east = -180.0;
    for (const json& place : item["geometry"]["coordinates"][0][0]) {
        EXPECT_GE(place[0].get<double>(), 179.0 - 1e-9);
        EXPECT_LE(place[0].get<double>(), 180.0);
        west = std::min(west, place[0].get<double>());
    }
    for (const json& place : item["geometry"]["coordinates"][1][0]) {
        EXPECT_GE(place[0].get<double>(), -180.0);
        EXPECT_LE(place[0].get<double>(), -178.0 + 1e-9);
        east = std::max(east, place[0].get<double>());
    }
    EXPECT_NEAR(west, 179.0, 1e-9);
    EXPECT_NEAR(east, -178.0, 1e-9);
    EXPECT_NEAR(item["bbox"][0].get<double>(), 179.0, 1e-9);
    EXPECT_NEAR(item["bbox"][2].get<double>(), -178.0, 1e-9);
}

// EPSG:3031 has the south pole in its middle; its corners, 2,000 km away, are at about 64 S.
TEST(StacItems, OfMapsAroundAPoleReachIt) {
    const json item =
        item_of(map_view("EPSG:3031", {-2000000.0, 40000.0, 0.0, 2000000.0, 0.0, -40000.0}, 100, 100));
    EXPECT_EQ(item["bbox"][0], -180.0);
    EXPECT_EQ(item["bbox"][1], -90.0);
    EXPECT_EQ(item["bbox"][2], 180.0);
    EXPECT_NEAR(item["bbox"][3].get<double>(), -64.0, 1.0);
}

}  // namespace
}  // namespace oro

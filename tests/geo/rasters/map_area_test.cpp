// What is said of a map in a CRS that is made for another part of the Earth. Areas are those of EPSG's
// database.
#include <gtest/gtest.h>

#include <string>

#include "geo/rasters/map_frame.h"

namespace oro {
namespace {

std::string note_at(const std::string& crs, double lat_deg, double lon_deg) {
    MapFrame frame;
    frame.crs = crs;
    return note_of_map_area(frame, {lat_deg, lon_deg});
}

TEST(MapArea, OutsideItIsTold) {
    EXPECT_EQ(note_at("EPSG:32733", 47.1, 9.5),
              "the map's middle lies 47 degrees outside the area that its coordinate reference system, "
              "EPSG:32733 WGS 84 / UTM zone 33S, is made for (80 S to 0 N, 12 E to 18 E): the system may be "
              "wrong");
    // British National Grid: to 2.01 E.
    EXPECT_NE(note_at("EPSG:27700", 51.0, 9.5).find("lies 7.5 degrees outside"), std::string::npos)
        << note_at("EPSG:27700", 51.0, 9.5);
    EXPECT_NE(note_at("EPSG:32660", -10.0, 175.0).find("lies 10 degrees outside"), std::string::npos);
}

TEST(MapArea, WithinItNothingIs) {
    EXPECT_EQ(note_at("EPSG:32632", 47.1, 9.5), "");
    EXPECT_EQ(note_at("EPSG:2056", 47.1, 9.5), "");
    EXPECT_EQ(note_at("EPSG:4326", -80.0, 179.0), "");
    // New Zealand, whose area crosses the antimeridian, in any turn.
    EXPECT_EQ(note_at("EPSG:4167", -44.0, -176.5), "");
    EXPECT_EQ(note_at("EPSG:4167", -44.0, 183.5), "");
    EXPECT_EQ(note_at("+proj=tmerc +lat_0=47 +lon_0=9 +ellps=bessel", 47.1, 9.5), "");
}

}  // namespace
}  // namespace oro

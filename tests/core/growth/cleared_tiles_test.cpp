// Tiles on which no trees are planted, since triangles lie over them.
#include "core/growth/cleared_tiles.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/growth/tree_sites.h"

namespace oro {
namespace {

struct TileNumber {
    std::uint32_t row, column;
};
TileNumber tile_at(double lat_deg, double lon_deg) {
    const double tile_deg = site_tile_south_deg(1) - site_tile_south_deg(0);
    const auto row = static_cast<std::uint32_t>((lat_deg + 90.0) / tile_deg);
    return {row, static_cast<std::uint32_t>((lon_deg + 180.0) / 360.0 * site_tile_columns(row))};
}

std::vector<glm::dvec3> triangle(double lat_deg, double lon_deg, double side_deg) {
    return {ecef_from_geodetic({lat_deg, lon_deg, 400.0}).m,
            ecef_from_geodetic({lat_deg, lon_deg + side_deg, 420.0}).m,
            ecef_from_geodetic({lat_deg + side_deg, lon_deg, 400.0}).m};
}

TEST(ClearedTiles, AreThoseUnderTriangles) {
    const ClearedTiles none{std::vector<glm::dvec3>{}};
    const TileNumber town = tile_at(47.37, 8.54);
    EXPECT_EQ(none.size(), 0U);
    EXPECT_FALSE(none.contains(town.row, town.column));
    const ClearedTiles one(triangle(47.37, 8.54, 1.0e-7));
    EXPECT_EQ(one.size(), 1U);
    EXPECT_TRUE(one.contains(town.row, town.column));
    EXPECT_FALSE(one.contains(town.row + 1, town.column));
    EXPECT_FALSE(one.contains(town.row, town.column + 1));
}

// Of every tile that holds a corner, however the triangle lies; over 180 degrees, too.
TEST(ClearedTiles, GoRoundTheEarth) {
    for (const double lon_deg : {-179.999, 179.995, 0.0, 8.54}) {
        const ClearedTiles cleared(triangle(60.0, lon_deg, 0.02));
        for (const auto& [north, east] : {std::pair{0.0, 0.0}, {0.0, 0.01999}, {0.01999, 0.0}}) {
            const TileNumber tile =
                tile_at(60.0 + north + 1.0e-9, normalised_lon_deg(lon_deg + east + 1.0e-9));
            EXPECT_TRUE(cleared.contains(tile.row, tile.column)) << lon_deg << " " << north << " " << east;
        }
    }
}

TEST(ClearedTiles, OfATriangleOverHalfTheEarthAreNone) {
    EXPECT_EQ(ClearedTiles(triangle(10.0, 20.0, 40.0)).size(), 0U);
}

}  // namespace
}  // namespace oro

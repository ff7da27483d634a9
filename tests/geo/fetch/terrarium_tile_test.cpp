// Which pictures of web maps a tile has, and what their colours stand for.
#include "geo/fetch/terrarium_tile.h"

#include <gtest/gtest.h>

namespace {
using oro::PictureBlock;

PictureBlock block_of(int zoom, int lat_deg, int lon_deg) {
    oro::TileLayout layout;
    layout.format = oro::TileFormat::terrarium;
    layout.zoom = zoom;
    return pictures_of(layout, {lat_deg, lon_deg});
}

// Source: https://github.com/tilezen/joerd/blob/master/docs/formats.md, (red * 256 + green + blue / 256) -
// 32768.
TEST(TerrariumTiles, ColoursAreHeights) {
    EXPECT_EQ(oro::H_of_terrarium_m({128, 0, 0}), 0.0);
    EXPECT_EQ(oro::H_of_terrarium_m({143, 127, 128}), 3967.5);
    EXPECT_EQ(oro::H_of_terrarium_m({0, 0, 0}), -32768.0);
}

// By Python: x = (lon + 180) / 360 * 2^z, y = (1 / 2 - asinh(tan(lat)) / (2 pi)) * 2^z at both corners.
TEST(TerrariumTiles, PicturesOfATile) {
    const PictureBlock alps = block_of(12, 46, 8);  // x 2139.02 to 2150.4, y 1440.67 to 1457.20
    EXPECT_EQ(alps.west, 2139);
    EXPECT_EQ(alps.columns, 12);
    EXPECT_EQ(alps.north, 1440);
    EXPECT_EQ(alps.rows, 18);
    // One degree beside the map's middle: y 5.69 and 11.38 of 2048 away from it.
    const PictureBlock south = block_of(11, -1, 0);
    EXPECT_EQ(south.west, 1024);
    EXPECT_EQ(south.north, 1024);
    EXPECT_EQ(south.columns, 6);
    EXPECT_EQ(south.rows, 6);
    // Its last column ends with the map.
    EXPECT_EQ(block_of(12, 0, 179).west + block_of(12, 0, 179).columns, 4096);
    // North of the map's end there is one row.
    EXPECT_EQ(block_of(5, 85, 10).north, 0);
    EXPECT_EQ(block_of(5, 89, 10).rows, 1);
}

}  // namespace

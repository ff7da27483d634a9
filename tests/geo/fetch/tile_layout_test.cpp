// Which tiles a box has, and where they lie.
#include "geo/fetch/tile_layout.h"

#include <gtest/gtest.h>

namespace {
using oro::BoundingBox;
using oro::TileLayout;

TileLayout layout_of(int side_deg) {
    TileLayout layout;
    layout.name = "test";
    layout.url = "https://example.org/{latitude}/{latitude}{longitude}.hgt.gz";
    layout.file = "{latitude}{longitude}.hgt.gz";
    layout.side_deg = side_deg;
    return layout;
}

std::string names_of(const BoundingBox& box, int side_deg) {
    const auto tiles = tiles_in(box, layout_of(side_deg), 100);
    if (!tiles.ok()) return tiles.error().line();
    std::string names;
    for (const auto& tile : *tiles)
        names += (names.empty() ? "" : " ") + oro::tile_name(tile.lat_deg, tile.lon_deg);
    return names;
}

TEST(TileLayouts, TilesOfABox) {
    EXPECT_EQ(names_of({8, 46, 9, 47}, 1), "N46E008");
    EXPECT_EQ(names_of({7.9, 46.5, 8.1, 47.1}, 1), "N47E007 N47E008 N46E007 N46E008");
    EXPECT_EQ(names_of({-0.5, -0.5, 0.5, 0.5}, 1), "N00W001 N00E000 S01W001 S01E000");
    EXPECT_EQ(names_of({179.5, 10.2, -179.5, 10.4}, 1), "N10E179 N10W180");
    // ESA WorldCover's names: the Bernese Oberland lies in N45E006.
    EXPECT_EQ(names_of({7.5, 46.2, 8.5, 46.9}, 3), "N45E006");
    EXPECT_EQ(names_of({-1, -1, 1, 1}, 3), "N00W003 N00E000 S03W003 S03E000");
    EXPECT_EQ(names_of({-180, -90, 180, 90}, 1),
              "-180,-90,180,90: holds more than 100 tiles of test: name a smaller box");
}

TEST(TileLayouts, AddressesOfATile) {
    EXPECT_EQ(url_of(layout_of(1), {46, 8}), "https://example.org/N46/N46E008.hgt.gz");
    EXPECT_EQ(file_of(layout_of(1), {-7, -73}), "S07W073.hgt.gz");
}

// Sides in degrees, and a key that is in nothing but the address that is asked.
TEST(TileLayouts, AddressesWithAKey) {
    TileLayout layout = layout_of(1);
    layout.url = "https://example.org/API?south={south}&north={north}&west={west}&east={east}&k={key}";
    EXPECT_EQ(fault_of(layout), "an address with {key} and 'key_variable' belong together");
    layout.key_variable = "KEY";
    EXPECT_EQ(fault_of(layout), "");
    EXPECT_EQ(url_of(layout, {-1, 179}),
              "https://example.org/API?south=-1&north=0&west=179&east=180&k={key}");
    const oro::FetchAddress address = address_of(layout, {-1, 179}, "secret12");
    EXPECT_EQ(address.url, "https://example.org/API?south=-1&north=0&west=179&east=180&k=secret12");
    EXPECT_EQ(address.shown(), url_of(layout, {-1, 179}));
    EXPECT_EQ(address.without_key("secret12 and secret12"), "{key} and {key}");
    layout.url.replace(0, 5, "http");
    EXPECT_EQ(fault_of(layout), "'url' must begin with https://, for it has a key");
}

TEST(TileLayouts, WhatIsNoLayout) {
    EXPECT_EQ(fault_of(layout_of(1)), "");
    const auto fault = [](auto change) {
        TileLayout layout = layout_of(1);
        change(layout);
        return fault_of(layout);
    };
    EXPECT_NE(fault([](TileLayout& one) { one.url = "file:///etc/{latitude}{longitude}"; }), "");
    EXPECT_NE(fault([](TileLayout& one) { one.url = "https://me:word@host/{latitude}{longitude}"; }), "");
    EXPECT_NE(fault([](TileLayout& one) { one.url = "https:///{latitude}{longitude}"; }), "");
    EXPECT_NE(fault([](TileLayout& one) { one.url = "https://host/{latitude}"; }), "");
    EXPECT_NE(fault([](TileLayout& one) { one.file = "../{latitude}{longitude}"; }), "");
    EXPECT_NE(fault([](TileLayout& one) { one.file = ".{latitude}{longitude}"; }), "");
}

}  // namespace

// Tiles of web maps against the surface: where pixels lie by PROJ, what they hold by GDAL's PNG reader.
#include "geo/web_maps/terrain_tiles.h"

#include <gdal.h>
#include <gdal_frmts.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include "geo/files/numbered_tiles.h"
#include "geo/files/raster_library.h"
#include "geo/together/region_ground.h"
#include "tests/support/made_terrain.h"
#include "tests/support/test_data.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

using Rgb = std::array<std::uint8_t, 3>;

// Of one file; empty where there is none.
std::vector<std::uint8_t> png_pixels(const fs::path& file) {
    start_gdal();
    if (GDALGetDriverByName("PNG") == nullptr) GDALRegister_PNG();
    const GdalMessages messages;
    const Dataset png(GDALOpen(file.c_str(), GA_ReadOnly));
    constexpr int side = 256;
    if (!png || GDALGetRasterXSize(png.get()) != side || GDALGetRasterYSize(png.get()) != side ||
        GDALGetRasterCount(png.get()) != 3)
        return {};
    std::vector<std::uint8_t> rgb(std::size_t{3} * side * side);
    const bool read = GDALDatasetRasterIO(png.get(), GF_Read, 0, 0, side, side, rgb.data(), side, side,
                                          GDT_Byte, 3, nullptr, 3, 3 * side, 1) == CE_None;
    return read ? rgb : std::vector<std::uint8_t>();
}

// By the definition of Web Mercator on the ground, through PROJ.
class PixelPlaces {
  public:
    PixelPlaces() {
        start_gdal();
        from_.reset(OSRNewSpatialReference(nullptr));
        OSRImportFromEPSG(from_.get(), 3857);
        OSRSetAxisMappingStrategy(from_.get(), OAMS_TRADITIONAL_GIS_ORDER);
        to_ = wgs84_degrees();
        transformation_.reset(OCTNewCoordinateTransformation(from_.get(), to_.get()));
    }
    PostPlace centre(const MercatorTile& tile, int row, int column) const {
        constexpr double half_m = 20037508.342789244;
        const double pixel_m = 2.0 * half_m / 256.0 / std::pow(2.0, tile.zoom);
        double x = -half_m + (static_cast<double>(tile.x) * 256.0 + column + 0.5) * pixel_m;
        double y = half_m - (static_cast<double>(tile.y) * 256.0 + row + 0.5) * pixel_m;
        EXPECT_TRUE(OCTTransform(transformation_.get(), 1, &x, &y, nullptr));
        return {y, x};
    }

  private:
    SpatialReference from_, to_;
    CoordinateTransformation transformation_;
};

std::map<std::string, std::string> files_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::ifstream file(entry.path(), std::ios::binary);
        files[fs::relative(entry.path(), folder).string()] = {std::istreambuf_iterator<char>(file), {}};
    }
    return files;
}

Region one_grid(HeightField field) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = std::move(field);
    return region;
}

struct Compared {
    int ground{}, holes{}, tiles{}, off{};
};

// Pixels of written tiles, `count` at random or those of the tiles' rims, against the ground.
Compared held_against(const TrueGround& ground, const fs::path& folder, const ZoomRange& zooms, int count,
                      bool rims, double hole_H_m) {
    constexpr unsigned seed = 20261128;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const PixelPlaces places;
    std::vector<std::pair<MercatorTile, std::vector<std::uint8_t>>> tiles;
    for (int zoom = zooms.low; zoom <= zooms.high; ++zoom)
        for (const auto& [name, bytes] : files_in(folder / std::to_string(zoom))) {
            MercatorTile tile{zoom, 0, 0};
            long long x = 0, y = 0;
            EXPECT_EQ(std::sscanf(name.c_str(), "%lld/%lld.png", &x, &y), 2) << name;
            tile.x = x, tile.y = y;
            tiles.emplace_back(tile, png_pixels(folder / std::to_string(zoom) / name));
            EXPECT_FALSE(tiles.back().second.empty()) << name;
        }
    Compared compared;
    compared.tiles = static_cast<int>(tiles.size());
    for (int i = 0; i < count && !tiles.empty(); ++i) {
        const auto& [tile, rgb] = tiles[random() % tiles.size()];
        const int row = static_cast<int>(random() % 256);
        const int column = rims ? (random() % 2 == 0 ? 0 : 255) : static_cast<int>(random() % 256);
        const PostPlace at = places.centre(tile, row, column);
        const std::size_t pixel =
            3 * (static_cast<std::size_t>(row) * 256 + static_cast<std::size_t>(column));
        const double has_m = H_of_terrain_rgb_m({rgb[pixel], rgb[pixel + 1], rgb[pixel + 2]});
        const auto h_m = ground.h_m(at.lat_deg, at.lon_deg);
        (h_m ? compared.ground : compared.holes) += 1;
        const double is_m = h_m ? *h_m - ground.N_m(at.lat_deg, at.lon_deg) : hole_H_m;
        compared.off += std::abs(has_m - is_m) > 0.051 ? 1 : 0;
    }
    return compared;
}

// docs.mapbox.com/data/tilesets/guides/access-elevation-data: -10000 + (R * 256 * 256 + G * 256 + B) * 0.1.
TEST(TerrainRgb, IsThePublishedCode) {
    EXPECT_EQ(terrain_rgb(-10000.0), (Rgb{0, 0, 0}));
    EXPECT_EQ(terrain_rgb(0.0), (Rgb{1, 134, 160}));
    EXPECT_EQ(terrain_rgb(8848.8), (Rgb{2, 224, 72}));
    EXPECT_EQ(terrain_rgb(8848.84), (Rgb{2, 224, 72}));
    EXPECT_EQ(terrain_rgb(-20000.0), (Rgb{0, 0, 0}));
    EXPECT_EQ(terrain_rgb(3.0e6), (Rgb{255, 255, 255}));
    EXPECT_DOUBLE_EQ(H_of_terrain_rgb_m({1, 134, 160}), 0.0);
    for (double H_m = -500.0; H_m < 9000.0; H_m += 7.3)
        EXPECT_LE(std::abs(H_of_terrain_rgb_m(terrain_rgb(H_m)) - H_m), 0.05 + 1.0e-9);
}

// Tile 10/534/362 holds 46.5 N, 8 E: wiki.openstreetmap.org/wiki/Slippy_map_tilenames.
TEST(MercatorTiles, LieWhereWebMapsHaveThem) {
    const MercatorPixel middle = mercator_pixel(0, 0.0, 0.0);
    EXPECT_NEAR(middle.x_px, 128.0, 1e-12);
    EXPECT_NEAR(middle.y_px, 128.0, 1e-12);
    EXPECT_NEAR(mercator_pixel(0, mercator_limit_deg, -180.0).y_px, 0.0, 1e-9);
    const MercatorPixel pixel = mercator_pixel(10, 46.5, 8.0);
    EXPECT_EQ(std::floor(pixel.x_px / 256.0), 534.0);
    EXPECT_EQ(std::floor(pixel.y_px / 256.0), 362.0);
    const PostPlace back = mercator_place(10, pixel);
    EXPECT_NEAR(back.lat_deg, 46.5, 1e-11);
    EXPECT_NEAR(back.lon_deg, 8.0, 1e-11);
}

// Posts every 3 seconds at 47 N: a pixel of zoom 11 is 52 m wide there, one of zoom 10 104 m.
TEST(MercatorTiles, ZoomsFitThePosts) {
    const HeightField field =
        test::made_field(47.0, 8.0, 1200.0, 400, 400, [](double, double) { return 0.0F; });
    const std::vector<const PostGrid*> grids{&field.grid};
    const ZoomRange zooms = mercator_zooms(grids);
    EXPECT_EQ(zooms.high, 11);
    EXPECT_LE(mercator_tiles(zooms.low, grids).size(), 4U);
    EXPECT_GT(mercator_tiles(zooms.low + 2, grids).size(), 4U);
}

TEST(TerrainTiles, HoldTheGroundAtCentresOfPixels) {
    const Region region = test::three_grids(200);
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const TrueGround& ground = (*grids)->ground();
    const fs::path folder = test::scratch_folder();
    const ZoomRange zooms{9, 11};
    const auto written = write_terrain_tiles(folder, ground, {zooms, -500.0, 2}, {});
    ASSERT_TRUE(written.ok()) << written.error().line();
    const Compared at_random = held_against(ground, folder, zooms, 10000, false, -500.0);
    EXPECT_EQ(at_random.off, 0);
    EXPECT_GT(at_random.ground, 1000);
    EXPECT_GT(at_random.holes, 1000);
    EXPECT_EQ(static_cast<std::uint64_t>(at_random.tiles), written->tiles);
    const Compared at_rims = held_against(ground, folder, zooms, 2000, true, -500.0);
    EXPECT_EQ(at_rims.off, 0);
    EXPECT_GT(at_rims.ground, 100);
}

TEST(TerrainTiles, GoOverTheAntimeridian) {
    const Region region = one_grid(test::made_field(10.0, 179.8, 600.0, 240, 240, [](double lat, double lon) {
        return static_cast<float>(100.0 * (lat - 9.0) + 50.0 * (lon - 179.0));
    }));
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const fs::path folder = test::scratch_folder();
    const auto written = write_terrain_tiles(folder, (*grids)->ground(), {{10, 10}, 0.0, 2}, {});
    ASSERT_TRUE(written.ok());
    EXPECT_TRUE(fs::exists(folder / "10" / "1023"));
    EXPECT_TRUE(fs::exists(folder / "10" / "0"));
    const Compared compared = held_against((*grids)->ground(), folder, {10, 10}, 2000, false, 0.0);
    EXPECT_EQ(compared.off, 0);
    EXPECT_GT(compared.ground, 500);
}

TEST(TerrainTiles, AreTheSameForAnyNumberOfThreads) {
    const Region region = test::three_grids(120);
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const fs::path one = test::scratch_folder(), five = test::scratch_folder();
    ASSERT_TRUE(write_terrain_tiles(one, (*grids)->ground(), {{8, 10}, 0.0, 1}, {}).ok());
    ASSERT_TRUE(write_terrain_tiles(five, (*grids)->ground(), {{8, 10}, 0.0, 5}, {}).ok());
    EXPECT_EQ(files_in(one), files_in(five));
    EXPECT_GT(files_in(one).size(), 3U);
}

// A level ground of 123.44 m is 123.4 m in tiles, 0.04 m off everywhere.
TEST(TerrainTiles, ErrorIsWhatRoundingMakesOnLevelGround) {
    const Region region =
        one_grid(test::made_field(47.0, 8.0, 1200.0, 200, 200, [](double, double) { return 123.44F; }));
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const auto errors = terrain_tiles_error((*grids)->ground(), {10, 12}, 1000, 2);
    ASSERT_TRUE(errors.ok());
    ASSERT_EQ(errors->size(), 3U);
    for (const ZoomError& error : *errors) {
        EXPECT_EQ(error.places, 1000U);
        EXPECT_NEAR(error.largest_m, 0.04, 1e-5);
        EXPECT_NEAR(error.rms_m, 0.04, 1e-5);
    }
}

// A ridge of 100 m along a meridian, as narrow as two posts: pixels of 100 m and more miss most of it, those
// of 6 m nearly nothing.
TEST(TerrainTiles, ErrorFallsWithTheZoom) {
    const Region region = one_grid(test::made_field(47.0, 8.0, 1200.0, 200, 200, [](double, double lon) {
        return std::abs(lon - 8.08) < 1.0e-6 ? 100.0F : 0.0F;
    }));
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const auto errors = terrain_tiles_error((*grids)->ground(), {8, 14}, 4000, 2);
    ASSERT_TRUE(errors.ok());
    EXPECT_GT(errors->front().largest_m, 50.0);
    EXPECT_LT(errors->back().largest_m, 6.0);
    EXPECT_LT(errors->back().rms_m, errors->front().rms_m);
}

TEST(TerrainTiles, OtherThingsInAFolderAreNoTiles) {
    const fs::path folder = test::scratch_folder();
    fs::create_directories(folder / "9" / "267");
    std::ofstream(folder / "9" / "267" / "181.png") << "x";
    std::ofstream(folder / "tiles.json") << "{}";
    EXPECT_TRUE(check_holds_tiles_alone(folder, ".png", "tiles.json").ok());
    for (const char* other : {"notes.txt", "9/readme", "9/267/a.png", "9/267/1.txt", "9/267/tiles.json"}) {
        std::ofstream(folder / other) << "x";
        EXPECT_FALSE(check_holds_tiles_alone(folder, ".png", "tiles.json").ok()) << other;
        fs::remove(folder / other);
    }
    fs::create_directories(folder / "pictures");
    EXPECT_FALSE(check_holds_tiles_alone(folder, ".png", "tiles.json").ok());
    EXPECT_FALSE(check_holds_tiles_alone(folder / "none", ".png", "tiles.json").ok());
}

}  // namespace
}  // namespace oro

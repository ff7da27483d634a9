// Must hold: a map from straight above lies over its source, in every CRS. Against GDAL: heights warped by
// gdalwarp and shaded by gdaldem on the map's own pixels; the offset between the two pictures is found by
// least squares.
#include <gdal_utils.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "apps/maps/ortho_map.h"
#include "core/base/parallel.h"
#include "core/lod/ground_means.h"
#include "tests/styles/drawn_style.h"
#include "tests/support/drawn/region_scene.h"

namespace oro {
namespace {

constexpr double allowed_px = 0.1;

struct Offset {
    double x_px{}, y_px{}, correlation{};
    std::size_t pixels{};
};

struct Map {
    MapFrame frame;
    double heading_deg{};            // of its up
    std::vector<std::uint8_t> rgba;  // rows from the top
};

// Heights of a source by gdalwarp on a map's pixels, void -9999.
std::string warped(const std::string& source, const MapFrame& frame) {
    const std::string out = (test::scratch_folder() / "warped.tif").string();
    const auto& m = frame.crs_from_pixel;
    std::array<std::array<char, 40>, 4> rims{};
    const std::array<double, 4> values{m[0], m[3] + m[5] * frame.height_px, m[0] + m[1] * frame.width_px,
                                       m[3]};
    for (std::size_t i = 0; i < 4; ++i) std::snprintf(rims[i].data(), 40, "%.17g", values[i]);
    std::string width = std::to_string(frame.width_px), height = std::to_string(frame.height_px),
                crs = frame.crs;
    std::vector<const char*> words{
        "-t_srs", crs.c_str(), "-te",        rims[0].data(), rims[1].data(), rims[2].data(), rims[3].data(),
        "-et",    "0",         "-ts",        width.c_str(),  height.c_str(), "-r",           "bilinear",
        "-ot",    "Float32",   "-dstnodata", "-9999",        nullptr};
    GDALWarpAppOptions* const options = GDALWarpAppOptionsNew(const_cast<char**>(words.data()), nullptr);
    GDALDatasetH from = GDALOpen(source.c_str(), GA_ReadOnly);
    EXPECT_NE(from, nullptr) << source;
    if (!from) return out;
    int fault = 0;
    const GDALDatasetH made = GDALWarp(out.c_str(), nullptr, 1, &from, options, &fault);
    EXPECT_NE(made, nullptr);
    if (made) GDALClose(made);
    GDALClose(from);
    GDALWarpAppOptionsFree(options);
    return out;
}

// By how much `drawn` is `reference` moved: drawn = a + b (reference + x d/dx + y d/dy), by least squares
// over all pixels that both have, with their neighbours.
Offset offset_of(const Map& map, const test::Band& reference) {
    const int width = map.frame.width_px, height = map.frame.height_px;
    const auto valid = [&](int x, int y) {
        return map.rgba[4 * static_cast<std::size_t>(y * width + x) + 3] == 255 && reference.at(y, x) > 0.0F;
    };
    std::array<std::array<double, 5>, 4> sums{};
    double mean_a = 0.0, mean_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    Offset found;
    for (int y = 2; y < height - 2; ++y)
        for (int x = 2; x < width - 2; ++x) {
            bool whole = true;
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i) whole = whole && valid(x + i, y + j);
            if (!whole) continue;
            const auto at = [&](int i, int j) { return static_cast<double>(reference.at(y + j, x + i)); };
            const double drawn = map.rgba[4 * static_cast<std::size_t>(y * width + x)];
            const std::array<double, 5> terms{1.0, at(0, 0), 0.5 * (at(1, 0) - at(-1, 0)),
                                              0.5 * (at(0, 1) - at(0, -1)), drawn};
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < 5; ++j) sums[i][j] += terms[i] * terms[j];
            ++found.pixels;
            mean_a += drawn;
            mean_b += at(0, 0);
            aa += drawn * drawn;
            bb += at(0, 0) * at(0, 0);
            ab += drawn * at(0, 0);
        }
    // Gauss and Jordan.
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            if (j == i) continue;
            const double times = sums[j][i] / sums[i][i];
            for (std::size_t k = 0; k < 5; ++k) sums[j][k] -= times * sums[i][k];
        }
    }
    const double scale = sums[1][4] / sums[1][1];
    found.x_px = -(sums[2][4] / sums[2][2]) / scale;
    found.y_px = -(sums[3][4] / sums[3][3]) / scale;
    const auto n = static_cast<double>(found.pixels);
    found.correlation =
        (ab - mean_a * mean_b / n) / std::sqrt((aa - mean_a * mean_a / n) * (bb - mean_b * mean_b / n));
    return found;
}

class OrthoMaps : public test::GpuTest {
  protected:
    Map drawn(const Region& region, const std::string& crs, const std::string& style_name,
              double resolution) {
        Map map;
        ShotOptions options;
        options.ortho = true;
        options.crs = crs;
        if (resolution > 0.0) options.resolution = resolution;
        View view;
        view.style = style_name;
        view.labels = false;
        const Result<void> made = make_map(view, options, region);
        if (!made.ok()) ADD_FAILURE() << made.error().line();
        if (!made.ok()) return map;
        const auto style = load_style(view, region.grids[0].field);
        if (!style.ok()) ADD_FAILURE() << style.error().line();
        if (!style.ok()) return map;
        auto scene = test::create_scene(*gpu_, region, {.means = asks_for_means(style->frame)});
        if (!scene.ok()) ADD_FAILURE() << scene.error().line();
        if (!scene.ok()) return map;
        const TrueSurface surface(region.grids[0].field, 1.0, thread_count());
        const auto report = draw_map(*gpu_, *scene, view, surface, *style, RasterPath::compute,
                                     [&](std::span<const std::uint8_t> row) {
                                         map.rgba.insert(map.rgba.end(), row.begin(), row.end());
                                         return Result<void>();
                                     },
                                     {});
        if (!report.ok()) ADD_FAILURE() << report.error().line();
        map.frame = *view.map;
        map.heading_deg = view.camera.attitude.heading_deg;
        return map;
    }

    // Against heights as they are, and as gdaldem shades them.
    void compare(const Region& region, const std::string& source, const std::string& crs, double resolution,
                 double least_share) {
        const std::filesystem::path heights = test::scratch_folder() / "heights.json";
        std::ofstream(heights) << R"({"colour_by": "height", "tints": [{"H_m": 0, "colour": "#000000"},
            {"H_m": 4200, "colour": "#ffffff"}], "light": "none", "background": "#000000"})";
        for (const bool shaded : {false, true}) {
            const Map map = drawn(region, crs, shaded ? "hillshade" : heights.string(), resolution);
            if (map.rgba.empty()) return;
            const std::string raster = warped(source, map.frame);
            char azimuth[40];
            std::snprintf(azimuth, sizeof azimuth, "%.6f", std::fmod(315.0 - map.heading_deg + 360.0, 360.0));
            std::array<const char*, 5> words{"-az", azimuth, "-s", crs == "EPSG:4326" ? "111120" : "1",
                                             nullptr};
            const auto bands =
                shaded ? test::gdaldem(raster, "hillshade", nullptr, const_cast<char**>(words.data()))
                       : values_of(raster);
            ASSERT_EQ(bands.size(), 1U);
            const Offset offset = offset_of(map, bands[0]);
            std::printf("%s, %s: %d x %d px, %zu compared, offset %+.3f %+.3f px, correlation %.4f\n",
                        crs.c_str(), shaded ? "hillshade" : "heights", map.frame.width_px,
                        map.frame.height_px, offset.pixels, offset.x_px, offset.y_px, offset.correlation);
            EXPECT_GT(static_cast<double>(offset.pixels),
                      least_share * map.frame.width_px * map.frame.height_px);
            EXPECT_GT(offset.correlation, shaded ? 0.8 : 0.99);
            EXPECT_LE(std::hypot(offset.x_px, offset.y_px), allowed_px);
        }
    }

    static std::vector<test::Band> values_of(const std::string& raster) {
        const GDALDatasetH dataset = GDALOpen(raster.c_str(), GA_ReadOnly);
        test::Band band{GDALGetRasterXSize(dataset), GDALGetRasterYSize(dataset), {}};
        band.values.resize(static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.height));
        EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Read, 0, 0, band.width, band.height,
                               band.values.data(), band.width, band.height, GDT_Float32, 0, 0),
                  CE_None);
        GDALClose(dataset);
        return {band};
    }
};

TEST_F(OrthoMaps, LieOverTheirSourceInEveryCrs) {
    const auto tile = test::real_data("geotiff/nfong_N46E008.tif");
    if (!tile) GTEST_SKIP() << "needs N46E008";
    RegionRequest request;
    request.paths = {tile->string()};
    request.box = BoundingBox{8.0, 46.4, 8.5, 46.8};
    const auto region = open_region(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    const std::string source = tile->string();
    compare(*region, source, "EPSG:4326", 0.0, 0.6);
    compare(*region, source, "EPSG:32632", 0.0, 0.6);
    compare(*region, source, "EPSG:2056", 60.0, 0.6);
    compare(*region, source, "EPSG:3857", 100.0, 0.6);
    compare(*region, source, "EPSG:3413", 90.0, 0.3);  // polar stereographic, turned by 53 degrees
}

// A region across 180 degrees: in a CRS made for it, and in degrees that run on.
TEST_F(OrthoMaps, LieOverTheirSourceAcrossTheAntimeridian) {
    test::Raster raster;
    raster.rows = 240;
    raster.columns = 300;
    raster.cell_corners = {179.9, 1.0 / 1200.0, 0.0, -16.6, 0.0, -1.0 / 1200.0};
    const std::filesystem::path file = test::scratch_folder() / "fiji.tif";
    ASSERT_NE(test::write_raster(file, raster,
                                 [](int row, int column) {
                                     return static_cast<float>(
                                         1500.0 + 900.0 * std::sin(0.11 * row) * std::cos(0.09 * column) +
                                         400.0 * std::sin(0.031 * row + 0.07 * column));
                                 }),
              "");
    RegionRequest request;
    request.paths = {file.string()};
    const auto region = open_region(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    compare(*region, file.string(), "EPSG:32701", 0.0, 0.7);
    compare(*region, file.string(), "EPSG:4326", 0.0, 0.9);
}

// A point is where the CRS says, exactly: Bern's old observatory is 2,600,000 1,200,000 in Swiss coordinates.
// Source: swisstopo, Formulas and constants for the Swiss map projection, 2016; 46.951083 N, 7.438639 E on
// WGS84 to a second of arc's hundredth.
TEST(MapPlaces, AreThoseOfTheCrs) {
    const MapFrame frame{"EPSG:2056", {2599990.0, 20.0, 0.0, 1200010.0, 0.0, -20.0}, 3, 3};
    auto places = MapPlaces::of(frame);
    ASSERT_TRUE(places.ok()) << places.error().line();
    const auto bern = places->at(0.5, 0.5);
    ASSERT_TRUE(bern);
    EXPECT_NEAR(bern->lat_deg, 46.951083, 2e-5);
    EXPECT_NEAR(bern->lon_deg, 7.438639, 2e-5);
}

TEST(MapFrame, IsOnWholeMultiplesAndAroundAllPosts) {
    const HeightField field = test::square_field(46.5, 8.0, 100.0, 60, [](int, int) { return 500.0; });
    const auto usual = map_frame({}, field.grid);
    ASSERT_TRUE(usual.ok());
    EXPECT_EQ(map_crs_name(usual->crs), "EPSG:32632 WGS 84 / UTM zone 32N");
    EXPECT_EQ(usual->crs_from_pixel[1], 99.0);
    const auto by_30 = map_frame({"EPSG:32632", 30.0, {}}, field.grid);
    ASSERT_TRUE(by_30.ok());
    EXPECT_EQ(std::remainder(by_30->crs_from_pixel[0], 30.0), 0.0);
    EXPECT_EQ(std::remainder(by_30->crs_from_pixel[3], 30.0), 0.0);
    EXPECT_NEAR(by_30->width_px * 30.0, 5900.0 * 1.012, 90.0) << "turned by 0.7 degrees";
    const auto by_size = map_frame({"EPSG:32632", {}, {{640, 480}}}, field.grid);
    ASSERT_TRUE(by_size.ok());
    EXPECT_EQ(by_size->width_px, 640);
    EXPECT_EQ(by_size->height_px, 480);
    EXPECT_EQ(world_file_path("a/p.tiff"), "a/p.tfw");
    EXPECT_EQ(world_file_path("p.PNG"), "p.pgw");
    EXPECT_EQ(world_file_path("p.jpeg"), "p.jgw");
    EXPECT_EQ(world_file({"", {400.0, 10.0, 0.0, 900.0, 0.0, -10.0}, 5, 5}), "10\n0\n0\n-10\n405\n895\n");
}

TEST(MapFrame, RefusesWhatCannotBe) {
    const HeightField field = test::square_field(46.5, 8.0, 100.0, 60, [](int, int) { return 500.0; });
    const auto line = [&](const MapRequest& request) {
        const auto frame = map_frame(request, field.grid);
        return frame.ok() ? std::string("fine") : frame.error().line();
    };
    EXPECT_EQ(line({"EPSG:99999", {}, {}}),
              "--crs EPSG:99999: is no coordinate reference system that PROJ knows; e.g. EPSG:32632");
    EXPECT_EQ(
        line({"EPSG:4978", {}, {}}),
        "--crs EPSG:4978: is no map's coordinate reference system: name a projected one or one of degrees");
    EXPECT_NE(line({"+proj=ortho +lat_0=-46 +lon_0=-170", {}, {}}).find("cannot hold this region"),
              std::string::npos);
    EXPECT_EQ(line({"EPSG:32632", 0.01, {}}).find("--resolution: makes a map of "), 0U);
    HeightField crossing = field;
    crossing.grid.lon.phase_deg += 172.0 - 0.0;
    const auto cut = map_frame({"EPSG:3857", {}, {}}, crossing.grid);
    ASSERT_FALSE(cut.ok());
    EXPECT_NE(cut.error().line().find("the CRS is cut through it"), std::string::npos);
}

}  // namespace
}  // namespace oro

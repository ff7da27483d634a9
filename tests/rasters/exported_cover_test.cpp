// Must hold: the colour that 3D Tiles of --landcover have at a vertex is that of the class that GDAL reads
// there: GDAL's pixel, GDAL's transformation, and the colours of the published table.
#include <cpl_error.h>
#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "apps/commands/commands.h"
#include "apps/options/export_options.h"
#include "core/earth/ellipsoid.h"
#include "tests/geo/tilesets/read_tileset.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// sRGB codes by the code of a class.
using ColoursOfClasses = std::map<int, std::array<int, 3>>;

// Codes of a raster as GDAL reads them.
class ReadByGdal {
  public:
    explicit ReadByGdal(const std::string& file) : dataset_(GDALOpen(file.c_str(), GA_ReadOnly)) {
        EXPECT_NE(dataset_, nullptr) << file;
        const OGRSpatialReferenceH wgs84 = OSRNewSpatialReference(nullptr);
        OSRImportFromEPSG(wgs84, 4326);
        OSRSetAxisMappingStrategy(wgs84, OAMS_TRADITIONAL_GIS_ORDER);
        crs_from_wgs84_ = OCTNewCoordinateTransformation(wgs84, GDALGetSpatialRef(dataset_));
        OSRDestroySpatialReference(wgs84);
        std::array<double, 6> corners{};
        GDALGetGeoTransform(dataset_, corners.data());
        EXPECT_TRUE(GDALInvGeoTransform(corners.data(), pixel_from_crs_.data()));
    }
    ~ReadByGdal() {
        OCTDestroyCoordinateTransformation(crs_from_wgs84_);
        GDALClose(dataset_);
    }
    ReadByGdal(const ReadByGdal&) = delete;
    ReadByGdal& operator=(const ReadByGdal&) = delete;

    // The code of the pixel that a place lies in; nothing within half a pixel of another code, or of the rim.
    [[nodiscard]] std::optional<int> clear_code_at(double lat_deg, double lon_deg) const {
        double x = lon_deg, y = lat_deg;
        if (!OCTTransform(crs_from_wgs84_, 1, &x, &y, nullptr)) return std::nullopt;
        double column = 0.0, row = 0.0;
        GDALApplyGeoTransform(const_cast<double*>(pixel_from_crs_.data()), x, y, &column, &row);
        const std::optional<int> code = code_of(column, row);
        for (const double down : {-0.5, 0.0, 0.5})
            for (const double right : {-0.5, 0.0, 0.5})
                if (code_of(column + right, row + down) != code) return std::nullopt;
        return code;
    }

  private:
    [[nodiscard]] std::optional<int> code_of(double column, double row) const {
        const int x = static_cast<int>(std::floor(column)), y = static_cast<int>(std::floor(row));
        if (x < 0 || y < 0 || x >= GDALGetRasterXSize(dataset_) || y >= GDALGetRasterYSize(dataset_))
            return std::nullopt;
        std::int32_t code = 0;
        if (GDALRasterIO(GDALGetRasterBand(dataset_, 1), GF_Read, x, y, 1, 1, &code, 1, 1, GDT_Int32, 0, 0) !=
            CE_None)
            return std::nullopt;
        return code;
    }
    GDALDatasetH dataset_;
    OGRCoordinateTransformationH crs_from_wgs84_{};
    std::array<double, 6> pixel_from_crs_{};
};

// The light of an sRGB code. Source: IEC 61966-2-1.
double light_of_code(int code) {
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

struct HeldToClasses {
    std::uint64_t vertices{}, clear{}, others{};
    std::map<int, std::uint64_t> of_each;
};

// Every vertex of the tiles that are rounded to less than half a cell: by an eighth of their error at most.
HeldToClasses held_to_classes(const std::filesystem::path& tileset, const std::string& cover, double cell_m,
                              const ColoursOfClasses& colours) {
    const ReadByGdal by_gdal(cover);
    HeldToClasses held;
    for (const test::ReadTile& tile : test::read_tileset(tileset)) {
        if (tile.error_m / 8.0 > 0.5 * cell_m) continue;
        EXPECT_EQ(tile.colours.size(), tile.posts_m.size());
        if (tile.colours.size() != tile.posts_m.size()) continue;
        // Feet of walls have the colour of the vertex above, and lean aside.
        std::vector<char> is_ground(tile.posts_m.size(), 0);
        for (std::size_t i = 0; i < tile.ground_triangles; ++i)
            for (const std::uint32_t corner : tile.triangles[i]) is_ground[corner] = 1;
        for (std::size_t i = 0; i < tile.posts_m.size(); ++i) {
            if (!is_ground[i]) continue;
            ++held.vertices;
            const Geodetic at = geodetic_from_ecef({tile.posts_m[i]});
            const std::optional<int> code = by_gdal.clear_code_at(at.lat_deg, at.lon_deg);
            const auto known = code ? colours.find(*code) : colours.end();
            if (known == colours.end()) continue;
            ++held.clear;
            ++held.of_each[*code];
            constexpr double step = 0.5 / 255.0 + 1.0e-6;  // colours of vertices have 8 bits
            for (std::size_t j = 0; j < 3; ++j)
                if (std::abs(tile.colours[i][static_cast<int>(j)] - light_of_code(known->second[j])) > step) {
                    ++held.others;
                    break;
                }
        }
    }
    std::printf("%llu vertices, %llu beyond half a cell from borders, %llu of another class\n",
                static_cast<unsigned long long>(held.vertices), static_cast<unsigned long long>(held.clear),
                static_cast<unsigned long long>(held.others));
    return held;
}

std::filesystem::path exported(const std::string& bbox, std::vector<std::string> paths,
                               const std::string& cover) {
    ExportOptions options;
    options.region.paths = std::move(paths);
    options.region.bbox = bbox;
    options.to = "3dtiles";
    const std::filesystem::path out = test::scratch_folder() / "tiles";
    options.out = out.string();
    options.landcover = {cover};
    options.quiet = true;
    const Result<void> done = run_export(options);
    EXPECT_TRUE(done.ok()) << done.error().line();
    return out;
}

// Cells of 300 m of a UTM zone, in spots of several: their borders lie askew to the posts.
TEST(ExportedCover, AMadeOneInUtmHasGdalsClasses) {
    constexpr std::array codes{10, 20, 30, 40, 50, 60, 80, 90};
    test::Raster raster;
    raster.rows = 180, raster.columns = 200;
    raster.cell_corners = {720000.0, 300.0, 0.0, 4075000.0, 0.0, -300.0};
    raster.crs = "EPSG:32616";
    raster.type = GDT_Byte;
    const std::string cover =
        test::write_raster(test::scratch_folder() / "cover.tif", raster, [&](int row, int column) {
            return static_cast<double>(
                codes[static_cast<std::size_t>((row / 5) * 7 + (column / 4) * 3) % codes.size()]);
        });
    // Source: data/cover/worldcover.json, "colour".
    const ColoursOfClasses colours{{10, {0x46, 0x5d, 0x37}}, {20, {0x75, 0x6b, 0x39}},
                                   {30, {0x74, 0x84, 0x41}}, {40, {0x98, 0x88, 0x52}},
                                   {50, {0x8d, 0x86, 0x80}}, {60, {0xac, 0xa2, 0x8c}},
                                   {80, {0x0b, 0x2a, 0x3c}}, {90, {0x4e, 0x6b, 0x62}}};
    const HeldToClasses held = held_to_classes(
        exported("", {(test::bundled_data() / "jacksboro.tif").string()}, cover), cover, 300.0, colours);
    EXPECT_EQ(held.others, 0U);
    EXPECT_GT(held.clear, 8000U);
    EXPECT_EQ(held.of_each.size(), codes.size());
    for (const auto& [code, vertices] : held.of_each) EXPECT_GT(vertices, 300U) << code;
}

// Liechtenstein, on WorldCover's own grid.
TEST(ExportedCover, ThatOfLiechtensteinHasGdalsClasses) {
    const auto ground = test::real_data("alps/N47E009.SRTMGL3.hgt.zip"),
               cover = test::real_data("cover/li_cover_osm_worldcover_codes.tif");
    if (!ground || !cover) GTEST_SKIP() << "needs alps and cover";
    const ColoursOfClasses colours{{10, {0x46, 0x5d, 0x37}}, {20, {0x75, 0x6b, 0x39}},
                                   {30, {0x74, 0x84, 0x41}}, {40, {0x98, 0x88, 0x52}},
                                   {50, {0x8d, 0x86, 0x80}}, {60, {0xac, 0xa2, 0x8c}},
                                   {80, {0x0b, 0x2a, 0x3c}}, {90, {0x4e, 0x6b, 0x62}}};
    const HeldToClasses held =
        held_to_classes(exported("9.47,47.05,9.64,47.27", {ground->string()}, cover->string()),
                        cover->string(), 6.2, colours);
    EXPECT_EQ(held.others, 0U);
    EXPECT_GT(held.clear, 3000U);
    EXPECT_GE(held.of_each.size(), 5U);
}

}  // namespace
}  // namespace oro

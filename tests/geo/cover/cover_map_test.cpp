// Land cover by place: held against GDAL's own nearest, and what is wrong with files.
#include "geo/cover/cover_map.h"

#include <gdal_utils.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/terrain/level_grid.h"
#include "geo/cover/cover_over_ground.h"
#include "tests/drape/written_image.h"
#include "tests/support/made_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// A table with a class for each code from 1 to 250: colours differ in groups of 20.
CoverTable any_table() {
    CoverTable table{"any", "any", {0}, {}};
    for (int code = 1; code <= 250; ++code)
        table.classes.push_back({.codes = {code},
                                 .name = "class " + std::to_string(code),
                                 .colour = {static_cast<std::uint8_t>(code / 20), 0, 0},
                                 .materials = {Material::meadow}});
    return table;
}

std::shared_ptr<const CoverMap> map_of(const std::vector<std::string>& files) {
    std::vector<CoverSource> sources;
    for (const std::string& file : files) {
        auto source = open_cover_source(file);
        EXPECT_TRUE(source.ok()) << source.error().line();
        sources.push_back(std::move(source).value());
    }
    const CoverTable table = any_table();
    auto map = CoverMap::of(std::move(sources), {}, &table);
    EXPECT_TRUE(map.ok()) << map.error().line();
    return std::move(map).value();
}

struct CoverWarped {
    int columns{}, rows{};
    std::array<double, 6> m{};
    std::vector<unsigned char> codes;
};
// The file, brought to degrees by gdalwarp: nearest, without its approximations.
CoverWarped warped(const std::string& file, double step_deg) {
    start_gdal();
    const std::string step = std::to_string(step_deg), out = (test::scratch_folder() / "w.tif").string();
    CPLStringList words;
    for (const char* word :
         {"-t_srs", "EPSG:4326", "-r", "near", "-et", "0", "-tr", step.c_str(), step.c_str()})
        words.AddString(word);
    GDALWarpAppOptions* const options = GDALWarpAppOptionsNew(words.List(), nullptr);
    GDALDatasetH source = GDALOpen(file.c_str(), GA_ReadOnly);
    const Dataset result(GDALWarp(out.c_str(), nullptr, 1, &source, options, nullptr));
    GDALWarpAppOptionsFree(options);
    CoverWarped warped;
    warped.columns = GDALGetRasterXSize(result.get());
    warped.rows = GDALGetRasterYSize(result.get());
    GDALGetGeoTransform(result.get(), warped.m.data());
    warped.codes.resize(static_cast<std::size_t>(warped.columns) * static_cast<std::size_t>(warped.rows));
    EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(result.get(), 1), GF_Read, 0, 0, warped.columns, warped.rows,
                           warped.codes.data(), warped.columns, warped.rows, GDT_Byte, 0, 0),
              CE_None);
    GDALClose(source);
    return warped;
}

struct CoverCompared {
    std::size_t places{}, near_borders{}, differing{}, differing_beyond_borders{};
};
// `half_deg`: at least half a cell.
CoverCompared compared(const CoverMap& map, const CoverWarped& truth, double half_deg) {
    CoverCompared all;
    for (int row = 0; row < truth.rows; row += 9) {
        std::vector<double> lat, lon;
        for (int column = 0; column < truth.columns; ++column) {
            for (const auto& [up, right] :
                 {std::pair{0.0, 0.0}, {1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}, {-1.0, -1.0}}) {
                lat.push_back(truth.m[3] + truth.m[5] * (row + 0.5) + up * half_deg);
                lon.push_back(truth.m[0] + truth.m[1] * (column + 0.5) + right * half_deg);
            }
        }
        std::vector<int> codes(lat.size());
        EXPECT_TRUE(map.codes_at(lat, lon, codes).ok());
        for (std::size_t i = 0; i < lat.size() / 5; ++i) {
            const int code = codes[5 * i] == no_cover_code ? 0 : codes[5 * i];
            const bool near = std::any_of(&codes[5 * i], &codes[5 * i] + 5,
                                          [&](int other) { return other != codes[5 * i]; });
            const bool differs = code != truth.codes[static_cast<std::size_t>(row * truth.columns) + i];
            ++all.places;
            all.near_borders += near ? 1 : 0;
            all.differing += differs ? 1 : 0;
            all.differing_beyond_borders += differs && !near ? 1 : 0;
        }
    }
    return all;
}

void expect_gdals_nearest(const char* name, double step_deg, double half_deg) {
    const auto file = test::real_data(name);
    if (!file) GTEST_SKIP() << "needs " << name;
    const auto map = map_of({file->string()});
    const CoverCompared all = compared(*map, warped(file->string(), step_deg), half_deg);
    EXPECT_GT(all.places - all.near_borders, 8000U);
    EXPECT_EQ(all.differing_beyond_borders, 0U) << "of " << all.places;
    EXPECT_LE(all.differing, all.places / 1000) << "of all";
}

// Cells of 1/12000 degree, read at places 1.37 of them apart.
TEST(CoverMap, IsGdalsNearestOfTenMetres) {
    expect_gdals_nearest("cover/li_cover_osm_worldcover_codes.tif", 1.37 / 12000, 0.5 / 12000);
}
TEST(CoverMap, IsGdalsNearestOfThreeHundredMetres) {
    expect_gdals_nearest("cover/podlasie_cci_landcover_300m.tif", 0.73 / 360, 0.5 / 360);
}
// Albers' projection, cells of 30 m: half of their diagonal is 21 m.
TEST(CoverMap, IsGdalsNearestInAProjection) {
    expect_gdals_nearest("cover/augusta_nlcd_30m.tif", 0.0002, 0.0002);
}

// 8 x 8 cells of 0.01 degree, all of one code but for a first column of nothing.
std::string write_cover(const std::filesystem::path& file, int code, GDALDataType type = GDT_Byte) {
    test::WrittenImage image{8, 8, {8.0, 0.01, 0.0, 47.0, 0.0, -0.01}};
    image.bands = 1;
    image.type = type;
    return test::write_image(file, image, [&](int, int, int column) { return column == 0 ? 0 : code; });
}

TEST(CoverMap, LaterFilesLieOverEarlierOnesAndKnowNothingOfNothing) {
    const auto folder = test::scratch_folder();
    const auto map = map_of({write_cover(folder / "a.tif", 7), write_cover(folder / "b.tif", 9, GDT_UInt16)});
    EXPECT_EQ(*map->code_at(46.955, 8.035), 9);
    EXPECT_EQ(*map->code_at(46.955, 8.005), no_cover_code) << "0 is nothing";
    EXPECT_EQ(*map->code_at(46.955, 8.105), no_cover_code) << "beyond the files";
    EXPECT_EQ(map->name_of(9), "class 9");
    EXPECT_EQ(map->name_of(251), "code 251");
    EXPECT_EQ(map->name_of(no_cover_code), "");
}

// One table is for all files; the line put the second one's codes on the first.
TEST(CoverMap, FilesOfTwoTablesAreNamedWithBoth) {
    const auto table = [](const std::string& name, std::vector<int> codes) {
        CoverTable made{name, name, {0}, {}};
        for (const int code : codes)
            made.classes.push_back(
                {.codes = {code}, .name = "class", .colour = {0, 0, 0}, .materials = {Material::meadow}});
        return made;
    };
    const auto source = [](const std::string& file, std::set<int> codes) {
        CoverSource made;
        made.file = file, made.codes = std::move(codes);
        return made;
    };
    const std::vector<CoverTable> tables{table("tens", {10, 20, 30}), table("ones", {1, 2, 3})};
    const auto why = [&](std::vector<CoverSource> sources) {
        const auto map = CoverMap::of(std::move(sources), tables, nullptr);
        return map.ok() ? "" : map.error().line();
    };
    EXPECT_EQ(why({source("/a/x.tif", {10, 20}), source("/b/y.tif", {1, 2})}),
              "/b/y.tif: its codes are those of ones, and those of x.tif are of tens: files that are given "
              "together need one table");
    EXPECT_EQ(
        why({source("x.tif", {10, 20}), source("y.tif", {7})}).find("x.tif, y.tif: its codes (7, 10, 20)"),
        0U);
}

TEST(CoverMap, RefusesWhatHoldsNoClasses) {
    const auto folder = test::scratch_folder();
    test::WrittenImage image{8, 8, {8.0, 0.01, 0.0, 47.0, 0.0, -0.01}};
    image.photometric = "RGB";
    const auto even = [](int, int, int) { return 7.0; };
    const auto refusal = [&](const std::string& file) { return open_cover_source(file).error().what; };
    EXPECT_EQ(refusal(test::write_image(folder / "rgb.tif", image, even)),
              "holds colours, not the codes of classes: --drape lays it over the ground");
    image.photometric = "";
    image.bands = 1;
    image.type = GDT_Float32;
    EXPECT_EQ(refusal(test::write_image(folder / "half.tif", image, [](int, int, int) { return 0.5; })),
              "holds 0.500000, which is no code of a class");
    image.crs = "";
    EXPECT_NE(refusal(test::write_image(folder / "nowhere.tif", image, even)), "");
    const CoverTable table{"few", "few", {0}, {{.codes = {1}, .name = "one", .materials = {Material::rock}}}};
    auto source = open_cover_source(write_cover(folder / "seven.tif", 7));
    ASSERT_TRUE(source.ok());
    const auto map = CoverMap::of({*source}, {}, &table);
    ASSERT_FALSE(map.ok());
    EXPECT_EQ(map.error().what, "holds none of the codes of few, but 7");
}

// Which ground texels name, and how many fifteenths.
using CoverCounts = std::array<double, unknown_ground + 1>;
CoverCounts counts_of(std::uint32_t texel) {
    CoverCounts counts{};
    for (; texel != 0U; texel >>= 8U) counts[texel & 15U] += texel >> 4U & 15U;
    return counts;
}

// Over terrain of ten posts a degree: cells of 0.004 degree, 25 a post's square.
class CoverOverTerrain : public testing::Test {
  protected:
    CoverOverTerrain() {
        test::WrittenImage image{1000, 1000, {8.0, 0.004, 0.0, 47.0, 0.0, -0.004}};
        image.bands = 1;
        map =
            map_of({test::write_image(test::scratch_folder() / "c.tif", image, [](int, int row, int column) {
                return 20 + 20 * (((row / 7) * 5 + (column / 9) * 3) % 6);
            })});
        grid = test::made_field(47.0, 8.0, 10.0, 41, 41, [](double, double) { return 100.0F; }).grid;
        std::vector<std::string> outside;
        auto over = cover_over(grid, map, outside);
        EXPECT_TRUE(over.ok() && outside.empty());
        tiles = std::move(over).value();
    }
    std::vector<std::uint32_t> load(const ImageTile& tile) const {
        std::vector<std::uint32_t> texels(gpu::drape_words);
        EXPECT_TRUE(*tiles->load(tile, texels));
        return texels;
    }
    std::shared_ptr<const CoverMap> map;
    PostGrid grid;
    std::unique_ptr<CoverTiles> tiles;
};

TEST_F(CoverOverTerrain, FinestTexelsAreThePixelsThatTheyLieIn) {
    const int level = tiles->finest_level();
    EXPECT_EQ(level, -5) << "a cell is 0.04 posts, a texel 1/64 of one";
    const std::vector<std::uint32_t> texels = load({level, 3, 5});
    for (int i = 0; i < 256 * 256; i += 37) {
        const int row = i / 256, column = i % 256;
        const PostPlace place = grid.place_at(post_of_texel(level, 3, row), post_of_texel(level, 5, column));
        const std::uint32_t texel =
            texels[static_cast<std::size_t>((row + 1) * static_cast<int>(gpu::drape_stride) + column + 1)];
        const int code = *map->code_at(place.lat_deg, place.lon_deg);
        EXPECT_EQ(texel, 0xF0U | static_cast<std::uint32_t>(code / 20)) << row << " " << column;
    }
}

// Of a level of 512 texels a side of the whole grid, and of the coarsest tile.
TEST_F(CoverOverTerrain, CoarseTexelsKeepTheMeansOfWhatTheyCover) {
    CoverCounts truth{};
    for (int row = 0; row < 1000; ++row)
        for (int column = 0; column < 1000; ++column)
            truth[static_cast<std::size_t>(1 + ((row / 7) * 5 + (column / 9) * 3) % 6)] += 1e-6;
    const int level = tiles->coarsest_level();
    const std::vector<std::uint32_t> texels = load({level, 0, 0});
    // 40 quads of the grid, two texels each, without the outermost.
    CoverCounts sum{};
    for (int row = 1; row < 79; ++row) {
        for (int column = 1; column < 79; ++column) {
            const CoverCounts one = counts_of(texels[static_cast<std::size_t>(
                (row + 1) * static_cast<int>(gpu::drape_stride) + column + 1)]);
            double units = 0.0;
            for (std::size_t k = 0; k < sum.size(); ++k) {
                sum[k] += one[k] / (15.0 * 78 * 78);
                units += one[k];
            }
            EXPECT_EQ(units, 15.0);
        }
    }
    for (std::size_t k = 0; k < sum.size(); ++k) EXPECT_NEAR(sum[k], truth[k], 1.0 / 60.0) << k;
}

}  // namespace
}  // namespace oro

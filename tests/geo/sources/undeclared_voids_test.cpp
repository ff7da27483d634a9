#include "geo/sources/undeclared_voids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

// Hills of 250 to 650 m in steps of 100 m on the ground.
double hills_m(int row, int column) {
    return 450.0 + 100.0 * std::sin(0.2 * row) + 100.0 * std::cos(0.15 * column);
}

Raster hundred_metres(int rows, int columns) {
    Raster raster;
    raster.rows = rows;
    raster.columns = columns;
    raster.crs = "EPSG:32632";
    raster.cell_corners = {500000.0, 100.0, 0.0, 5000000.0, 0.0, -100.0};
    return raster;
}

// 6 x 6 posts of `value` in a raster of hills that declares no no-data value.
bool is_in_hole(int row, int column) {
    return row >= 10 && row < 16 && column >= 12 && column < 18;
}

TEST(UndeclaredVoids, EverySpellingIsVoidAndTold) {
    const fs::path folder = scratch_folder();
    struct Spelling {
        GDALDataType type;
        double value;
        const char* value_text;
    };
    int number = 0;
    for (const Spelling& one : {Spelling{GDT_Float32, -9999.0, "-9999"},
                                {GDT_Int16, -9999.0, "-9999"},
                                {GDT_Float32, -9999.99, "-9999.99"},
                                {GDT_Float32, 9999.0, "9999"},
                                {GDT_Int32, -99999.0, "-99999"},
                                {GDT_Int32, -999999.0, "-999999"},
                                {GDT_Int16, -999.0, "-999"},
                                {GDT_Int16, -32768.0, "-32768"},
                                {GDT_Int16, -32767.0, "-32767"},
                                {GDT_Int16, 32767.0, "32767"},
                                {GDT_UInt16, 65535.0, "65535"},
                                {GDT_Int16, -32678.0, "-32678"},
                                {GDT_Float32, 1e20, "1e+20"},
                                {GDT_Float32, -1e10, "-1e+10"},
                                {GDT_Int32, -2147483648.0, "-2147483648"},
                                {GDT_Float32, -3.4028234663852886e38, "-3.40282347e+38"},
                                {GDT_Int16, -9998.0, "-9998"}}) {
        Raster raster = hundred_metres(40, 40);
        raster.type = one.type;
        const auto file =
            write_raster(folder / (std::to_string(number++) + ".tif"), raster,
                         [&](int r, int c) { return is_in_hole(r, c) ? one.value : hills_m(r, c); });
        std::string reason;
        const auto region = opened(request_for({file}), &reason);
        ASSERT_TRUE(region) << one.value_text << ": " << reason;
        EXPECT_EQ(region->voids, 36U) << one.value_text;
        EXPECT_GE(height_range(region->field).lowest_m, 200.0F) << one.value_text;
        EXPECT_LE(height_range(region->field).highest_m, 700.0F) << one.value_text;
        EXPECT_EQ(notes_with(region->notes, std::string(": 36 posts hold ") + one.value_text +
                                                ", which no tag declares as no data; they are taken as void"),
                  1U)
            << one.value_text << ": " << (region->notes.empty() ? "no note" : region->notes[0]);
    }
}

// -9999 ft is a height of -3047.7 m by its unit: what is stored counts, not what it would be in metres.
TEST(UndeclaredVoids, InFeetAndByScale) {
    const fs::path folder = scratch_folder();
    for (const bool by_scale : {false, true}) {
        Raster raster = hundred_metres(40, 40);
        raster.type = GDT_Int16;
        if (by_scale) raster.scale = 0.1;
        raster.unit = by_scale ? "" : "ft";
        const auto region = opened(
            request_for({write_raster(folder / (by_scale ? "dm.tif" : "ft.tif"), raster, [&](int r, int c) {
                return is_in_hole(r, c) ? -9999.0 : 3.0 * hills_m(r, c);
            })}));
        ASSERT_TRUE(region);
        EXPECT_EQ(region->voids, 36U) << by_scale;
        EXPECT_EQ(notes_with(region->notes, "36 posts hold -9999,"), 1U) << by_scale;
    }
}

TEST(UndeclaredVoids, OfHgtTilesAndTextGridsWithoutTheirLine) {
    const fs::path folder = scratch_folder();
    const auto tile = opened(request_for({write_hgt(folder / "N46E008.hgt", 1201, [](int r, int c) {
        return is_in_hole(r, c) ? -9999.0 : hills_m(r % 60, c % 60);
    })}));
    ASSERT_TRUE(tile);
    EXPECT_EQ(tile->voids, 36U);
    EXPECT_EQ(notes_with(tile->notes, "N46E008.hgt: 36 posts hold -9999, which no tag declares"), 1U);

    std::ofstream text(folder / "grid.asc");
    text << "ncols 30\nnrows 30\nxllcorner 500000\nyllcorner 5000000\ncellsize 100\n";
    for (int r = 0; r < 30; ++r) {
        for (int c = 0; c < 30; ++c) text << (is_in_hole(r, c) ? -9999.0 : hills_m(r, c)) << ' ';
        text << '\n';
    }
    text.close();
    RegionRequest request = request_for({(folder / "grid.asc").string()});
    request.source_crs = "EPSG:32632";
    std::string reason;
    const auto grid = opened(request, &reason);
    ASSERT_TRUE(grid) << reason;
    EXPECT_EQ(grid->voids, 36U);
    EXPECT_EQ(notes_with(grid->notes, "grid.asc: 36 posts hold -9999, which no tag declares"), 1U);
}

// What a window of a file is does not depend on how much of it holds heights: here none does.
TEST(UndeclaredVoids, APartOfAFileIsAsTheWholeIs) {
    const fs::path file = scratch_folder() / "half.tif";
    Raster raster;
    raster.rows = raster.columns = 60;
    raster.cell_corners = posts_from(8.0, 46.5, 100.0);
    write_raster(file, raster, [](int r, int c) { return c < 30 ? -9999.0 : hills_m(r, c); });
    RegionRequest request = request_for({file.string()});
    request.box = BoundingBox{8.05, 46.1, 8.25, 46.3};
    EXPECT_FALSE(test::open_grid(request).ok());
    request.box = BoundingBox{8.2, 46.1, 8.4, 46.3};
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_EQ(region->voids, 21U * 10U);  // columns at 8.20 to 8.29
}

TEST(UndeclaredVoids, TheSameOfSeveralFilesIsOneNote) {
    const fs::path folder = scratch_folder();
    for (int tile = 0; tile < 3; ++tile) {
        Raster raster = hundred_metres(30, 30);
        raster.cell_corners[0] += 3000.0 * tile;
        write_raster(folder / ("tile" + std::to_string(tile) + ".tif"), raster,
                     [](int r, int c) { return is_in_hole(r, c) ? -9999.0 : hills_m(r, c); });
    }
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(notes_with(region->notes, "tile0.tif and 2 more files: 108 posts hold -9999,"), 1U);
    EXPECT_EQ(notes_with(region->notes, "-9999"), 1U);
}

// A source of a whole file that is this block.
std::pair<Source, PostBlock> block_of(int posts_a_side, const HeightOfPost& height) {
    Source source;
    source.report.rows = source.report.columns = posts_a_side;
    source.report.spacing_m = 1852.0;
    PostBlock block;
    block.window = {0, 0, posts_a_side, posts_a_side};
    for (int r = 0; r < posts_a_side; ++r)
        for (int c = 0; c < posts_a_side; ++c) block.height_m.push_back(static_cast<float>(height(r, c)));
    return {std::move(source), std::move(block)};
}

Result<PostBlock> never_read(const Source&, const PostWindow&) {
    ADD_FAILURE() << "the block is the whole file";
    return Error{ErrorKind::failed, "", ""};
}

// Depths of the sea are heights, those that read like no data, too: trenches down to -10,900 m, a deepest
// post of exactly -9999 or -999, plains at -99 beside hills. Rough and smooth floors, from 20 m to 3 km from
// post to post.
TEST(UndeclaredVoids, DepthsOfTheSeaStay) {
    const unsigned seed = std::random_device{}();
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> chance(0.0, 1.0);
    constexpr int posts_a_side = 48;
    for (int round = 0; round < 300; ++round) {
        const double deepest_m = round % 3 == 0   ? -9999.0
                                 : round % 3 == 1 ? -10900.0 * chance(random)
                                                  : -999.0;
        const double rough_m = 3000.0 * chance(random) * chance(random);
        const double wave = 0.05 + 0.3 * chance(random), phase = 6.0 * chance(random);
        std::vector<double> depths;
        for (int r = 0; r < posts_a_side; ++r)
            for (int c = 0; c < posts_a_side; ++c)
                depths.push_back(2000.0 * std::sin(wave * r + phase) * std::cos(wave * c) +
                                 rough_m * chance(random));
        // Whole metres, as ETOPO has them, moved so that the deepest post is what it is to be.
        const double lowest = *std::min_element(depths.begin(), depths.end());
        auto [source, block] = block_of(posts_a_side, [&](int r, int c) {
            return std::round(depths[static_cast<std::size_t>(r * posts_a_side + c)] - lowest) +
                   std::round(deepest_m);
        });
        const std::vector<float> before = block.height_m;
        ASSERT_TRUE(take_out_undeclared(source, block, never_read).ok());
        ASSERT_EQ(block.height_m, before)
            << "round " << round << " deepest " << deepest_m << " rough " << rough_m;
    }
}

// Terrain with cliffs of its own, at values that read like no data: a plateau at 999 m, a pit at -99 m.
TEST(UndeclaredVoids, PlateausAndPitsStay) {
    for (const double level_m : {999.0, -99.0, -999.0}) {
        auto [source, block] = block_of(40, [&](int r, int c) {
            return r > 10 && r < 20 && c > 10 && c < 20 ? level_m : (c / 8 % 2 == 0 ? 400.0 : 1400.0) + r;
        });
        const std::vector<float> before = block.height_m;
        ASSERT_TRUE(take_out_undeclared(source, block, never_read).ok());
        EXPECT_EQ(block.height_m, before) << level_m;
    }
}

// A hole of 36 posts: any digits, where nothing else comes near it; 0, too, where all else lies far above.
TEST(UndeclaredVoids, CodesOfAnyDigitsAreVoid) {
    for (const double code :
         {-10000.0, -10000.5, -5000.0, -500.0, -100.0, -88.0, -327.68, -1.0, 8888.0, 0.0}) {
        auto [source, block] =
            block_of(40, [&](int r, int c) { return is_in_hole(r, c) ? code : hills_m(r, c); });
        source.report.spacing_m = 100.0;
        ASSERT_TRUE(take_out_undeclared(source, block, never_read).ok());
        EXPECT_EQ(block.voids, 36U) << code;
    }
}

// Rims of a resampled hole: 36 posts of -9999, and 28 around them half way between it and the hills.
TEST(UndeclaredVoids, BlurredRimsAreVoid) {
    auto [source, block] = block_of(40, [&](int r, int c) {
        const bool is_rim = r >= 9 && r < 17 && c >= 11 && c < 19;
        return is_in_hole(r, c) ? -9999.0 : is_rim ? 0.5 * (hills_m(r, c) - 9999.0) : hills_m(r, c);
    });
    source.report.spacing_m = 100.0;
    ASSERT_TRUE(take_out_undeclared(source, block, never_read).ok());
    EXPECT_EQ(block.voids, 64U);
    std::uint64_t blurred = 0;
    for (const StoredCount& count : block.values.undeclared)
        if (count.value == blurred_value) blurred += count.posts;
    EXPECT_EQ(blurred, 28U);
}

// Heights that count in millimetres, and nothing says so.
TEST(UndeclaredVoids, HeightsInMillimetresAreToldWithTheOption) {
    Raster raster = hundred_metres(30, 30);
    raster.type = GDT_Int32;
    RegionRequest request = request_for({write_raster(scratch_folder() / "mm.tif", raster, [](int r, int c) {
        return std::round(1000.0 * hills_m(r, c));
    })});
    const auto refused = test::open_grid(request);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::no_data);
    for (const char* words : {"mm.tif", "no terrain has", "--height-unit m, ft, us-ft, cm, dm or mm"})
        EXPECT_NE(refused.error().line().find(words), std::string::npos) << refused.error().line();
    request.height_unit = "mm";
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_NEAR(static_cast<double>(region->field.H_at_post_m(3, 4)), hills_m(3, 4), 1e-3);
    EXPECT_TRUE(region->notes.empty()) << region->notes[0];
}

// Of low ground millimetres are heights that terrain has, but not its slopes.
TEST(UndeclaredVoids, SlopesThatNoTerrainHasAreTold) {
    Raster raster = hundred_metres(30, 30);
    raster.type = GDT_Int32;
    const auto file = write_raster(scratch_folder() / "low.tif", raster,
                                   [](int r, int c) { return 1000.0 * (r % 2 + 2 * (c % 3)); });
    const auto region = opened(request_for({file}));
    ASSERT_TRUE(region);
    EXPECT_EQ(notes_with(region->notes, "steeper than 80 degrees"), 1U);
    EXPECT_EQ(notes_with(region->notes, "--height-unit"), 1U);
}

}  // namespace
}  // namespace oro

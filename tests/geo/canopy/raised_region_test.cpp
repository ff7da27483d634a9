// The canopy as a surface, held against a file of H + canopy that GDAL opens as elevation data; a line of
// sight over a forest, by hand; and what is wrong with files.
#include "geo/canopy/raised_region.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sight/observer.h"
#include "core/sight/viewshed.h"
#include "geo/together/region_ground.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// 81 x 101 posts, 10 m apart, in UTM zone 32.
constexpr int rows = 81, columns = 101;
test::Raster ten_metres() {
    test::Raster raster;
    raster.rows = rows;
    raster.columns = columns;
    raster.cell_corners = {500000.0, 10.0, 0.0, 5150000.0, 0.0, -10.0};
    raster.crs = "EPSG:32632";
    return raster;
}
double hill_m(int row, int column) {
    return 800.0 + 0.37 * row + 30.0 * std::sin(0.11 * column) * std::cos(0.07 * row);
}
// Trees in squares of 6 posts, some with fractions of metres.
double trees_m(int row, int column) {
    return (row / 6 + column / 6) % 3 == 0 ? 12.3 + 0.7 * ((row * 5 + column * 3) % 11) : 0.0;
}

Region region_of(const std::string& file) {
    RegionRequest request;
    request.paths = {file};
    auto region = open_region(request, {});
    EXPECT_TRUE(region.ok()) << region.error().line();
    return std::move(*region);
}

Result<std::shared_ptr<const CanopyMap>> canopy_of(const std::string& file) {
    ORO_TRY(CanopySource source, open_canopy_source(file));
    std::vector<CanopySource> sources;
    sources.push_back(std::move(source));
    return CanopyMap::of_files(std::move(sources));
}

// Its error in words; "" where there is none.
std::string fault_of(const std::string& dem, const std::string& canopy_file) {
    const auto canopy = canopy_of(canopy_file);
    if (!canopy.ok()) return canopy.error().line();
    Region region = region_of(dem);
    const Result<void> raised = raise_by_canopy(region, **canopy, std::nullopt);
    return raised.ok() ? "" : raised.error().line();
}

class RaisedRegion : public testing::Test {
  protected:
    const fs::path folder = test::scratch_folder();
    const std::string ground = test::write_raster(folder / "ground.tif", ten_metres(), hill_m);
    const std::string trees = test::write_raster(folder / "trees.tif", ten_metres(), trees_m);
    // H + canopy, each as its file has it: in float.
    const std::string both = test::write_raster(folder / "both.tif", ten_metres(), [](int row, int column) {
        return static_cast<double>(static_cast<float>(hill_m(row, column)) +
                                   static_cast<float>(trees_m(row, column)));
    });

    [[nodiscard]] Region raised(const std::optional<double>& held = {}) const {
        Region region = region_of(ground);
        const auto canopy = canopy_of(trees);
        EXPECT_TRUE(canopy.ok()) << canopy.error().line();
        const Result<void> done = raise_by_canopy(region, **canopy, held);
        EXPECT_TRUE(done.ok()) << done.error().line();
        return region;
    }
};

TEST_F(RaisedRegion, HasThePostsOfAFileOfHeightAndCanopy) {
    const Region made = raised(), data = region_of(both);
    ASSERT_EQ(made.grids.size(), 1U);
    EXPECT_EQ(made.grids[0].field.H_m, data.grids[0].field.H_m);
    EXPECT_EQ(made.grids[0].canopy->held_share, 0.0);
    EXPECT_EQ(made.grids[0].canopy->unknown, 0U);
    EXPECT_NEAR(made.grids[0].canopy->highest_m, 19.3, 1e-5);
    // Its fingerprint stays the ground's.
    EXPECT_EQ(made.grids[0].posts_hash, region_of(ground).grids[0].posts_hash);
}

TEST_F(RaisedRegion, HidesAsThatFileDoes) {
    const Region made = raised(), data = region_of(both);
    const auto grids = RegionGround::of(made, 1.0), of_data = RegionGround::of(data, 1.0);
    ASSERT_TRUE(grids.ok() && of_data.ok());
    const TrueGround &hiding = (*grids)->ground(), &truth = (*of_data)->ground();
    const Geodetic eye = [&] {
        const PostPlace place = data.grids[0].field.grid.place_at(40.0, 50.0);
        return Geodetic{place.lat_deg, place.lon_deg, truth.h_m(place.lat_deg, place.lon_deg).value() + 6.0};
    }();
    const ViewshedRequest request{eye, standard_air, 1.0, 400.0, 2};
    EXPECT_EQ(viewshed(hiding, 0, request).clearance_deficit_m,
              viewshed(truth, 0, request).clearance_deficit_m);
    const Observer observer(hiding, eye, standard_air), true_observer(truth, eye, standard_air);
    int hidden = 0;
    for (int i = 0; i < 60; ++i) {
        const PostPlace place = data.grids[0].field.grid.place_at(1.3 + 1.29 * i, 97.7 - 1.6 * i);
        const Geodetic target{place.lat_deg, place.lon_deg,
                              truth.h_m(place.lat_deg, place.lon_deg).value() + 1.5};
        const auto one = observer.obstacle(target), other = true_observer.obstacle(target);
        ASSERT_EQ(one.has_value(), other.has_value());
        EXPECT_EQ(observer.clearance_deficit_m(target), true_observer.clearance_deficit_m(target));
        if (!one) continue;
        ++hidden;
        EXPECT_EQ(one->distance_m, other->distance_m);
        EXPECT_EQ(one->point.h_m, other->point.h_m);
    }
    EXPECT_GT(hidden, 10);
}

TEST_F(RaisedRegion, AddsWhatTheDataDoNotHold) {
    const Region half = raised(0.5), ground_alone = region_of(ground);
    for (const auto& [row, column] : {std::pair{0, 0}, {7, 10}, {40, 50}, {80, 100}}) {
        const float added_m = half.grids[0].field.H_at_post_m(row, column) -
                              ground_alone.grids[0].field.H_at_post_m(row, column);
        EXPECT_NEAR(added_m, 0.5 * trees_m(row, column), 1e-4) << row << ", " << column;
    }
    const PostPlace under = half.grids[0].field.grid.place_at(0.0, 0.0);
    EXPECT_NEAR(canopy_over_ground_m(half.grids[0], under.lat_deg, under.lon_deg).value_or(0.0),
                0.5 * trees_m(0, 0), 1e-4);
    const PostPlace open = half.grids[0].field.grid.place_at(2.5, 8.5);
    EXPECT_FALSE(canopy_over_ground_m(half.grids[0], open.lat_deg, open.lon_deg).has_value());
    const Region again = ground_of_raised(half);
    EXPECT_EQ(again.grids[0].field.H_m, ground_alone.grids[0].field.H_m);
    EXPECT_FALSE(again.grids[0].canopy.has_value());
}

// A plain, 500 m away a row of spruces of 20 m, 1,000 m away the target, 32 m over the ground, seen by
// straight light from 2 m: half way the line is 17 m over the chord of the ground, which is
// 500 * 500 / (2 * 6.38e6) = 0.0196 m lower than the plain between them. So it passes 3.0196 m below the
// tops, and the target must be twice that higher: 6.039 m.
TEST_F(RaisedRegion, BehindTheForestATargetIsHiddenBySixMetresOfSpruce) {
    test::Raster plain = ten_metres();
    plain.columns = 121;
    const std::string dem = test::write_raster(folder / "plain.tif", plain, [](int, int) { return 500.0; });
    const std::string spruce = test::write_raster(folder / "spruce.tif", plain,
                                                  [](int, int column) { return column == 60 ? 20.0 : 0.0; });
    Region region = region_of(dem);
    const auto canopy = canopy_of(spruce);
    ASSERT_TRUE(canopy.ok());
    ASSERT_TRUE(raise_by_canopy(region, **canopy, std::nullopt).ok());
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const auto over = [&](double column, double above_m) {
        const PostPlace place = region.grids[0].field.grid.place_at(40.0, column);
        return Geodetic{place.lat_deg, place.lon_deg,
                        (*grids)->ground().h_m(place.lat_deg, place.lon_deg).value() + above_m};
    };
    const Observer observer((*grids)->ground(), over(10.0, 2.0), Air{});
    EXPECT_FALSE(observer.sees(over(110.0, 32.0)));
    EXPECT_NEAR(observer.clearance_deficit_m(over(110.0, 32.0)).value(), 6.039, 0.02);
    EXPECT_TRUE(observer.sees(over(110.0, 38.1)));
}

// A canopy whose pixels have a fifth of the posts' spacing: each post has the mean of the 25 around it, to
// rounding in float (16 m: 1 um); without data those that are there; at the edge of the file those inside.
TEST_F(RaisedRegion, TakesTheMeanOfFinerPixels) {
    test::Raster raster = ten_metres();
    raster.rows *= 5;
    raster.columns *= 5;
    raster.cell_corners[1] = 2.0;
    raster.cell_corners[5] = -2.0;
    raster.no_data = -9999.0;
    const auto tree_m = [](int row, int column) {
        const int height = (row * 7919 + column * 104729) % 251;
        return height > 240 ? -9999.0 : height > 100 ? 0.1 * (height - 100) : 0.0;
    };
    const std::string file = test::write_raster(folder / "fine.tif", raster, tree_m);
    Region region = region_of(ground);
    const auto canopy = canopy_of(file);
    ASSERT_TRUE(canopy.ok());
    ASSERT_TRUE(raise_by_canopy(region, **canopy, std::nullopt).ok());
    const auto mean_m = [&](int post_row, int post_column) {
        double sum_m = 0.0;
        int known = 0;
        for (int row = post_row * 5; row < post_row * 5 + 5; ++row)
            for (int column = post_column * 5; column < post_column * 5 + 5; ++column)
                if (const double height_m = tree_m(row, column); height_m >= 0.0) {
                    sum_m += height_m;
                    ++known;
                }
        return sum_m / known;
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const float added_m =
                region.grids[0].canopy->added_m[static_cast<std::size_t>(row * columns + column)];
            ASSERT_NEAR(added_m, mean_m(row, column), 2e-6) << row << ", " << column;
        }
}

TEST_F(RaisedRegion, TakesHeightsOfClasses) {
    test::Raster raster = ten_metres();
    raster.type = GDT_Byte;
    const std::string file = test::write_raster(folder / "classes.tif", raster, [](int row, int column) {
        return row < 40 ? 10.0 : column < 50 ? 30.0 : 0.0;
    });
    CoverTable table{"own", "Own classes", {0}, {}};
    table.classes.push_back(
        {.codes = {10}, .name = "forest", .materials = {Material::needle_forest}, .canopy_m = 17.0});
    table.classes.push_back({.codes = {30}, .name = "meadow", .materials = {Material::meadow}});
    auto source = open_cover_source(file);
    ASSERT_TRUE(source.ok()) << source.error().line();
    std::vector<CoverSource> sources;
    sources.push_back(std::move(*source));
    const auto cover = CoverMap::of(std::move(sources), {}, &table);
    ASSERT_TRUE(cover.ok()) << cover.error().line();
    const auto canopy = CanopyMap::of_classes(*cover);
    EXPECT_TRUE(canopy->is_invented());
    Region region = region_of(ground);
    ASSERT_TRUE(raise_by_canopy(region, *canopy, std::nullopt).ok());
    const GridCanopy& made = *region.grids[0].canopy;
    EXPECT_EQ(made.added_m[0], 17.0F);
    EXPECT_EQ(made.added_m[60 * columns + 10], 0.0F);
    EXPECT_EQ(made.posts, 40U * columns);
    EXPECT_EQ(made.unknown, 41U * 51U);
}

TEST_F(RaisedRegion, RefusesWhatIsNoCanopy) {
    const auto written = [&](const char* name, test::Raster raster, double value) {
        return test::write_raster(folder / name, raster,
                                  [&](int row, int column) { return row == 5 && column == 7 ? value : 3.0; });
    };
    const auto says = [&](const std::string& file, const char* words) {
        const std::string fault = fault_of(ground, file);
        EXPECT_NE(fault.find(words), std::string::npos) << fault;
        EXPECT_NE(fault.find(fs::path(file).filename().string()), std::string::npos) << fault;
    };
    says(written("huge.tif", ten_metres(), 2400.0),
         "holds 2400 m in column 7, row 5: no canopy is higher than 100 m");
    says(written("low.tif", ten_metres(), -9999.0), "holds -9999 m in column 7, row 5: a canopy is 0 m high");
    test::Raster feet = ten_metres();
    feet.unit = "ft";
    says(written("feet.tif", feet, 3.0), "its heights are in ft, not in metres");
    test::Raster away = ten_metres();
    away.cell_corners[0] = 560000.0;
    says(written("away.tif", away, 3.0), "holds no canopy over the elevation data");
    test::Raster nowhere = ten_metres();
    nowhere.crs = "";
    says(written("nowhere.tif", nowhere, 3.0), "");
    EXPECT_NE(fault_of(ground, (folder / "nowhere.tif").string()), "");
    test::Raster complex = ten_metres();
    complex.type = GDT_CFloat32;
    says(written("complex.tif", complex, 3.0), "holds complex numbers");
    EXPECT_EQ(fault_of(ground, written("noise.tif", ten_metres(), -0.4)), "");
}

// No data is a place of which nothing is known: nothing is added, and it is counted.
TEST_F(RaisedRegion, LeavesPostsAloneOverWhichNothingIsKnown) {
    test::Raster raster = ten_metres();
    raster.no_data = -9999.0;
    const std::string file = test::write_raster(folder / "gaps.tif", raster, [](int row, int) {
        return row == 3 ? -9999.0 : row == 4 ? std::nan("") : 8.0;
    });
    Region region = region_of(ground);
    const auto canopy = canopy_of(file);
    ASSERT_TRUE(canopy.ok());
    ASSERT_TRUE(raise_by_canopy(region, **canopy, std::nullopt).ok());
    EXPECT_EQ(region.grids[0].canopy->unknown, 2U * columns);
    EXPECT_EQ(region.grids[0].canopy->added_m[3 * columns], 0.0F);
    EXPECT_EQ(region.grids[0].canopy->added_m[5 * columns], 8.0F);
}

TEST(HeldCanopy, IsKnownOfSrtmAlone) {
    const auto held = [](const char* path, SourceFormat format) {
        RegionGrid grid;
        grid.sources.emplace_back();
        grid.sources.back().path = path;
        grid.sources.back().format = format;
        return held_by_sources(grid);
    };
    EXPECT_EQ(held("tiles/N46E008.hgt", SourceFormat::srtm3_hgt).share, 0.5);
    EXPECT_EQ(held("N46E008.SRTMGL1.hgt.zip/N46E008.hgt", SourceFormat::srtm1_hgt).by, "SRTM");
    EXPECT_EQ(held("srtm_38_03.tif", SourceFormat::raster).share, 0.5);
    EXPECT_EQ(held("swissalti3d_2019_2642-1166_2_2056_5728.tif", SourceFormat::raster).share, 0.0);
    EXPECT_EQ(held("dem.tif", SourceFormat::raster).by, "");
}

}  // namespace
}  // namespace oro

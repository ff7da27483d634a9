#include "geo/sources/source_words.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

TEST(Region, NeighboursShareTheirPostsOnceAndDisagreementsAreCounted) {
    const fs::path folder = scratch_folder();
    // The eastern tile's western column disagrees by its row number, modulo 7.
    write_hgt(folder / "N10E020.hgt", 1201, [](int, int) { return 100; });
    write_hgt(folder / "N10E021.hgt", 1201, [](int r, int c) { return c == 0 ? 100 + r % 7 : 200; });
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->field.grid.columns(), 2401);
    EXPECT_EQ(region->seams.shared_posts, 1201U);
    EXPECT_EQ(region->seams.disagreeing_posts, 1029U);  // rows 0..1200 less the 172 multiples of 7
    EXPECT_EQ(region->seams.largest_difference_m, 6.0);
    // The one that wins has no seam of its own to report; the other has all of it.
    ASSERT_EQ(region->sources.size(), 2U);
    std::uint64_t shared = 0, disagreeing = 0;
    for (const SourceReport& source : region->sources) {
        EXPECT_TRUE(source.seams.shared_posts == 0 || source.seams.shared_posts == 1201U) << source.path;
        shared += source.seams.shared_posts;
        disagreeing += source.seams.disagreeing_posts;
    }
    EXPECT_EQ(shared, 1201U);
    EXPECT_EQ(disagreeing, 1029U);
    // Among equals the first name wins: N10E020.
    for (int r = 0; r < 1201; r += 100) EXPECT_EQ(region->field.H_at_post_m(r, 1200), 100.0F);
    EXPECT_EQ(region->field.H_at_post_m(600, 1201), 200.0F);
}

TEST(Region, AVoidPostTakesItsNeighboursHeight) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "N10E020.hgt", 1201, [](int, int c) { return c == 1200 ? -32768 : 100; });
    write_hgt(folder / "N10E021.hgt", 1201, [](int, int) { return 200; });
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->voids, 0U);
    EXPECT_EQ(region->seams.shared_posts, 0U);
    EXPECT_EQ(region->field.H_at_post_m(5, 1200), 200.0F);
}

TEST(Region, FinerSpacingWinsAndCoarserFillsWithItsTriangles) {
    const fs::path folder = scratch_folder();
    const auto coarse = [](int r, int c) { return 10 * ((r * 7 + c * 13) % 90); };
    write_hgt(folder / "N10E020.hgt", 1201, coarse);
    write_hgt(folder / "N10E021.hgt", 3601, [](int, int) { return 2000; });
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    const HeightField& field = region->field;
    EXPECT_EQ(field.grid.lat.posts_per_deg, 3600.0);
    EXPECT_EQ(field.grid.columns(), 7201);
    // The shared meridian is the finer tile's; it is no seam of equals.
    EXPECT_EQ(field.H_at_post_m(100, 3600), 2000.0F);
    EXPECT_EQ(region->seams.shared_posts, 0U);
    // Coarse posts exactly; between them the plane of the triangle, split from north-west to south-east.
    for (int r = 0; r < 1200; r += 97) {
        for (int c = 0; c < 1199; c += 89) {
            ASSERT_EQ(field.H_at_post_m(3 * r, 3 * c), static_cast<float>(coarse(r, c)));
            const double nw = coarse(r, c), ne = coarse(r, c + 1), sw = coarse(r + 1, c),
                         se = coarse(r + 1, c + 1);
            EXPECT_NEAR(static_cast<double>(field.H_at_post_m(3 * r + 1, 3 * c + 1)), nw + (se - nw) / 3.0,
                        1e-3);
            EXPECT_NEAR(static_cast<double>(field.H_at_post_m(3 * r + 1, 3 * c + 2)), (nw + ne + se) / 3.0,
                        1e-3);
            EXPECT_NEAR(static_cast<double>(field.H_at_post_m(3 * r + 2, 3 * c + 1)), (nw + sw + se) / 3.0,
                        1e-3);
        }
    }
    for (const SourceReport& source : region->sources) {
        if (source.rows == 1201) {
            EXPECT_NE(placement_words(source).find("3 x 3"), std::string::npos) << placement_words(source);
        }
    }
}

TEST(Region, PostsThatACoarserSourceLendsToAVoidAreSaid) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "N10E020.hgt", 3601, [](int r, int c) { return r == 7 && c < 5 ? -32768 : 300; });
    Raster raster;
    raster.rows = raster.columns = 3;
    raster.cell_corners = posts_from(19.0, 12.0, 1.0);
    write_raster(folder / "coarse.tif", raster, [](int, int) { return 310.0; });
    RegionRequest request = request_for({folder.string()});
    request.box = BoundingBox{20, 10, 21, 11};
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_EQ(region->voids, 0U);
    EXPECT_EQ(region->field.H_at_post_m(7, 2), 310.0F);
    ASSERT_EQ(region->notes.size(), 1U);
    EXPECT_NE(region->notes[0].find("5 void posts"), std::string::npos) << region->notes[0];
    EXPECT_NE(region->notes[0].find("coarse.tif"), std::string::npos) << region->notes[0];
}

TEST(Region, MissingCellsAreNamed) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "N10E020.hgt", 1201, [](int, int) { return 100; });
    write_hgt(folder / "N11E021.hgt", 1201, [](int, int) { return 100; });
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->missing_cells, (std::vector<std::string>{"N10E021", "N11E020"}));
    EXPECT_EQ(region->voids,
              2U * 1200U * 1200U);  // a missing tile but for the edges that its neighbours have
    EXPECT_TRUE(is_void(region->field.H_at_m(10.5, 21.5)));
}

TEST(Region, NoDataInTheBox) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "N10E020.hgt", 1201, [](int, int) { return 100; });
    RegionRequest request = request_for({folder.string()});
    request.box = BoundingBox{30, 10, 31, 11};
    auto region = test::open_grid(request);
    ASSERT_FALSE(region.ok());
    EXPECT_EQ(region.error().kind, ErrorKind::no_data);
    EXPECT_NE(region.error().line().find("30,10,31,11"), std::string::npos) << region.error().line();
    // Touching along a line is no data either.
    request.box = BoundingBox{21, 10, 22, 11};
    EXPECT_FALSE(test::open_grid(request).ok());
    // All void.
    write_hgt(folder / "N10E030.hgt", 1201, [](int, int) { return -32768; });
    request.box = BoundingBox{30, 10, 31, 11};
    region = test::open_grid(request);
    ASSERT_FALSE(region.ok());
    EXPECT_EQ(region.error().kind, ErrorKind::no_data);
}

TEST(Region, PostsHaveTheSameBitsInEveryRegion) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "N46E007.hgt", 1201, [](int r, int c) { return r + c; });
    write_hgt(folder / "N46E008.hgt", 1201, [](int r, int c) { return 1200 + r + c; });
    const auto whole = opened(request_for({folder.string()}));
    RegionRequest request = request_for({folder.string()});
    request.box = BoundingBox{7.90001, 46.2, 8.31, 46.4};
    const auto part = opened(request);
    ASSERT_TRUE(whole && part);
    const PostGrid& a = whole->field.grid;
    const PostGrid& b = part->field.grid;
    // Snapped outwards, by less than a post.
    EXPECT_LE(b.west_deg(), 7.90001);
    EXPECT_GT(b.west_deg(), 7.90001 - 1.0 / 1200);
    EXPECT_GE(b.east_deg(), 8.31);
    const auto rows = static_cast<int>(a.lat.first - b.lat.first);
    const auto columns = static_cast<int>(b.lon.first - a.lon.first);
    for (int r = 0; r < b.rows(); r += 13) {
        for (int c = 0; c < b.columns(); c += 17) {
            ASSERT_EQ(b.lat.at_deg(r), a.lat.at_deg(r + rows));
            ASSERT_EQ(b.lon.at_deg(c), a.lon.at_deg(c + columns));
            ASSERT_EQ(part->field.H_at_post_m(r, c), whole->field.H_at_post_m(r + rows, c + columns));
        }
    }
}

TEST(Region, TilesOnBothSidesOfTheAntimeridianAreOneNarrowRegion) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "S17E179.hgt", 1201, [](int, int c) { return c; });
    write_hgt(folder / "S17W180.hgt", 1201, [](int, int c) { return 1200 + c; });
    for (const bool boxed : {false, true}) {
        RegionRequest request = request_for({folder.string()});
        if (boxed) request.box = BoundingBox{179, -17, -179, -16};
        std::string reason;
        const auto region = opened(request, &reason);
        ASSERT_TRUE(region) << reason;
        EXPECT_EQ(region->field.grid.columns(), 2401);
        EXPECT_EQ(region->field.grid.west_deg(), 179.0);
        EXPECT_EQ(region->field.grid.east_deg(), 181.0);
        EXPECT_EQ(region->seams.shared_posts, 1201U);
        EXPECT_EQ(region->seams.disagreeing_posts, 0U);
        EXPECT_EQ(region->voids, 0U);
        EXPECT_TRUE(region->missing_cells.empty());
        for (const int c : {0, 1200, 1201, 2400})
            EXPECT_EQ(region->field.H_at_post_m(7, c), static_cast<float>(c));
        EXPECT_EQ(region->field.H_at_m(-16.5, -179.5), 1800.0F);
    }
}

// A world of 2-degree cells, by cell centres or by posts on the edges (first and last column one meridian).
std::string write_world(const fs::path& file, bool centres) {
    Raster raster;
    raster.rows = centres ? 90 : 91;
    raster.columns = centres ? 180 : 181;
    raster.cell_corners =
        centres ? std::array<double, 6>{-180, 2, 0, 90, 0, -2} : std::array<double, 6>{-181, 2, 0, 91, 0, -2};
    return write_raster(file, raster, [=](int r, int c) {
        if (!centres && (r == 0 || r == 90))
            return 5.0 + (c % 180 == 0 ? 3.0 : 0.0);  // a pole that its row disagrees about
        return static_cast<double>(r) * 10.0 + (c % 180);
    });
}

TEST(Region, RoundTheEarthTheFirstAndLastColumnAreOneMeridian) {
    const fs::path folder = scratch_folder();
    for (const bool centres : {false, true}) {
        const auto region =
            opened(request_for({write_world(folder / (centres ? "cells.tif" : "posts.tif"), centres)}));
        ASSERT_TRUE(region);
        const PostGrid& grid = region->field.grid;
        EXPECT_EQ(grid.columns(), 181) << centres;
        EXPECT_EQ(grid.east_deg() - grid.west_deg(), 360.0);
        EXPECT_GE(grid.west_deg(), -180.0);
        EXPECT_EQ(region->voids, 0U);
        EXPECT_EQ(region->seams.shared_posts, 0U);
        for (int r = 0; r < grid.rows(); ++r)
            ASSERT_EQ(region->field.H_at_post_m(r, 0), region->field.H_at_post_m(r, 180)) << r;
        if (!centres) {
            EXPECT_EQ(grid.north_deg(), 90.0);
            EXPECT_EQ(grid.south_deg(), -90.0);
            // A pole is one point and has one height, the mean of its row: 5 + 3 * 2 / 181 (column 0 is there
            // twice).
            for (int c = 0; c < 181; ++c)
                EXPECT_NEAR(static_cast<double>(region->field.H_at_post_m(0, c)), 5.0 + 6.0 / 181.0, 1e-5);
        }
    }
}

TEST(Region, PartOfAWorldOverTheAntimeridian) {
    const fs::path folder = scratch_folder();
    for (const bool centres : {false, true}) {
        RegionRequest request =
            request_for({write_world(folder / (centres ? "cells.tif" : "posts.tif"), centres)});
        request.box = BoundingBox{170, -10, -170, 10};
        const auto region = opened(request);
        ASSERT_TRUE(region);
        EXPECT_EQ(region->voids, 0U) << centres;
        EXPECT_LE(region->field.grid.west_deg(), 170.0);
        EXPECT_GE(region->field.grid.east_deg(), 190.0);
    }
}

TEST(Region, RealAlpsAgreeOnEverySharedPost) {
    const auto folder = real_data("alps");
    if (!folder) GTEST_SKIP() << "needs alps";
    const auto region = opened(request_for({folder->string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->sources.size(), 12U);
    EXPECT_GT(region->seams.shared_posts, 15U * 1200U);
    EXPECT_EQ(region->seams.disagreeing_posts, 0U);
    EXPECT_EQ(region->missing_cells, (std::vector<std::string>{"N45E008", "N45E009", "N45E010"}));
    EXPECT_EQ(height_range(region->field).highest_m, 4783.0F);
}

TEST(Region, RealHimalayaDisagreesAndSaysByHowMuch) {
    const auto folder = real_data("himalaya");
    if (!folder) GTEST_SKIP() << "needs himalaya";
    const auto region = opened(request_for({folder->string()}));
    ASSERT_TRUE(region);
    std::printf("himalaya: %llu shared posts, %llu disagree, by up to %.0f m\n",
                static_cast<unsigned long long>(region->seams.shared_posts),
                static_cast<unsigned long long>(region->seams.disagreeing_posts),
                region->seams.largest_difference_m);
    // Counted over the tiles' raw bytes by a separate program.
    EXPECT_EQ(region->seams.shared_posts, 20399U);
    EXPECT_EQ(region->seams.disagreeing_posts, 5262U);
    EXPECT_EQ(region->seams.largest_difference_m, 381.0);
}

TEST(Region, RealFijiOverTheAntimeridian) {
    const auto file = real_data("geotiff/fiji_antimeridian_etopo1_170_190.tif");
    if (!file) GTEST_SKIP() << "needs geotiff";
    RegionRequest request = request_for({file->string()});
    request.box = *parse_bounding_box("175,-20,-175,-15");
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_EQ(region->voids, 0U);
    EXPECT_NEAR(region->field.grid.west_deg(), 175.0, 0.25);
    EXPECT_NEAR(region->field.grid.east_deg(), 185.0, 0.25);
    EXPECT_EQ(region->sources[0].box.east_deg, -170.125);
}

TEST(Region, RealPolesHaveHeightsAllRound) {
    const auto file = real_data("geotiff/antarctica_etopo1_EPSG3031_20km.tif");
    if (!file) GTEST_SKIP() << "needs geotiff";
    RegionRequest request = resampled_from({file->string()});
    request.box = *parse_bounding_box("-180,-90,180,-85");
    const auto region = opened(request);
    ASSERT_TRUE(region);
    const PostGrid& grid = region->field.grid;
    EXPECT_EQ(grid.south_deg(), -90.0);
    EXPECT_EQ(grid.east_deg() - grid.west_deg(), 360.0);
    EXPECT_EQ(region->voids, 0U);
    const int pole = grid.rows() - 1;
    for (int c = 0; c < grid.columns(); ++c)
        EXPECT_EQ(region->field.H_at_post_m(pole, c), region->field.H_at_post_m(pole, 0));
    // The plateau at the South Pole: ice surface at 2,835 m (USGS), here from 20 km cells of ETOPO1.
    EXPECT_NEAR(static_cast<double>(region->field.H_at_post_m(pole, 0)), 2835.0, 100.0);
    const auto north = real_data("geotiff/vavilov_EPSG3413_f32.tif");
    request = request_for({north->string()});
    request.box = *parse_bounding_box("94,79,97,79.8");
    const auto vavilov = opened(request);
    ASSERT_TRUE(vavilov);
    EXPECT_NEAR(static_cast<double>(height_range(vavilov->field).highest_m), 711.3, 1.0);
}

TEST(Region, RealWorldAndTooLargeRegions) {
    const auto folder = real_data("extremes");
    if (!folder) GTEST_SKIP() << "needs extremes";
    const auto world = opened(request_for({(*folder / "ETOPO1_1deg_global.tif").string()}));
    ASSERT_TRUE(world);
    EXPECT_EQ(world->field.grid.rows(), 181);
    EXPECT_EQ(world->field.grid.columns(), 361);
    EXPECT_EQ(world->voids, 0U);
    // With 1-arc-second tiles beside it the world is too large: refused before anything is read, with the way
    // out.
    const auto all = test::open_grid(request_for({folder->string()}));
    ASSERT_FALSE(all.ok());
    EXPECT_NE(all.error().line().find("--bbox"), std::string::npos) << all.error().line();
    EXPECT_NE(all.error().line().find("posts"), std::string::npos);
}

// A file that says it has 951 million posts and holds a few thousand is told at once: memory for them would
// be 5 GB, and clearing it takes a while.
TEST(Region, AClaimBeyondTheFileIsToldBeforeMemoryIsTaken) {
    const std::filesystem::path folder = scratch_folder();
    std::vector<unsigned char> bytes(256 + 2 * 60 * 60, 0);
    const auto put = [&](std::size_t at, const auto& value) {
        std::memcpy(&bytes[at], &value, sizeof value);
    };
    std::memcpy(bytes.data(), "binterr1.3", 10);
    put(10, std::int32_t{60});
    put(14, std::int32_t{15859772});  // rows; the file has 60
    put(18, std::int16_t{2});         // bytes a post
    put(28, -84.33), put(36, -84.28), put(44, 36.60), put(52, 36.65);
    put(60, std::int16_t{1});  // the coordinate system is in the .prj
    put(62, 1.0F);
    write_bytes((folder / "r.bt").string(), bytes);
    std::ofstream(folder / "r.prj") << "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
                                       "84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
                                       "UNIT[\"degree\",0.0174532925199433]]";
    RegionRequest request;
    request.paths = {(folder / "r.bt").string()};
    const Result<RegionGrid> region = test::open_grid(request);
    ASSERT_FALSE(region.ok());
    EXPECT_NE(region.error().line().find("near row 15859771"), std::string::npos) << region.error().line();
}

}  // namespace
}  // namespace oro

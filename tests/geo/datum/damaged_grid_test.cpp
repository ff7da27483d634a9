// A geoid grid that is there and damaged is an error, never N = 0.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "geo/datum/shift_grid.h"
#include "geo/datum/vertical_datum.h"
#include "tests/geo/datum/proj_folder.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

std::string read_bytes(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_text(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

constexpr std::size_t gtx_header = 40;

std::string big_endian(const void* value, std::size_t size) {
    std::string bytes(static_cast<const char*>(value), size);
    std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

// A .gtx as NOAA defines it: rows from the south.
std::string gtx_bytes(double south_deg, double west_deg, double step_deg, int rows, int columns,
                      float value) {
    std::string bytes;
    for (const double number : {south_deg, west_deg, step_deg, step_deg})
        bytes += big_endian(&number, sizeof number);
    for (const int number : {rows, columns}) bytes += big_endian(&number, sizeof number);
    for (int i = 0; i < rows * columns; ++i) bytes += big_endian(&value, sizeof value);
    return bytes;
}

// A folder of PROJ's with its database and a copy of EGM96 to be damaged, and a tile at 46 N 8 E.
class DamagedGeoid : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = scratch_folder();
        const auto original = proj_file("egm96_15.gtx");
        if (!original) GTEST_SKIP() << "needs egm96_15.gtx";
        fs::create_symlink(*proj_file("proj.db"), folder_ / "proj.db");
        bytes_ = read_bytes(*original);
        grid_ = folder_ / "egm96_15.gtx";
        request_ = request_for({write_hgt(folder_ / "N46E008.hgt", 1201, [](int, int) { return 1000; })});
    }

    void expect_refused(const char* what) {
        const ProjFolder only(folder_.string());
        for (const bool strict : {false, true}) {
            request_.strict_datum = strict;
            const auto region = test::open_grid(request_);
            ASSERT_FALSE(region.ok())
                << what << ": N = " << region->field.undulation.at_m(46.5, 8.0) << ", " << region->geoid;
            EXPECT_EQ(region.error().kind, ErrorKind::failed);
            EXPECT_NE(region.error().line().find(grid_.string()), std::string::npos) << region.error().line();
            EXPECT_NE(region.error().line().find("damaged"), std::string::npos) << region.error().line();
        }
        std::printf("%s: %s\n", what, test::open_grid(request_).error().line().c_str());
        const std::string damage = grid_state("EPSG:4326+5773").damage;
        EXPECT_NE(damage.find(grid_.string()), std::string::npos) << what << ": " << damage;
    }

    // Where a node of the grid is in its file.
    static std::size_t at(double lat_deg, double lon_deg) {
        return gtx_header +
               4 * static_cast<std::size_t>((lat_deg + 90.0) * 4.0 * 1440.0 + (lon_deg + 180.0) * 4.0);
    }

    fs::path folder_, grid_;
    std::string bytes_;
    RegionRequest request_;
};

TEST_F(DamagedGeoid, CutEmptyAndHeaderOnlyGridsAreErrors) {
    for (const std::size_t bytes : {std::size_t{1000000}, std::size_t{0}, std::size_t{7}, gtx_header,
                                    bytes_.size() / 2, bytes_.size() - 1}) {
        write_text(grid_, bytes_.substr(0, bytes));
        expect_refused(std::to_string(bytes).c_str());
    }
}

TEST_F(DamagedGeoid, CutGridsAreErrorsBehindLinksAndInTheUsersOwnFolder) {
    fs::create_directory(folder_ / "elsewhere");
    write_text(folder_ / "elsewhere" / "grid", bytes_.substr(0, 1000000));
    fs::create_symlink(folder_ / "elsewhere" / "grid", grid_);
    expect_refused("a link");
    fs::remove(grid_);
    // The user's own folder comes before all others.
    write_text(grid_, bytes_);
    fs::create_directory(folder_ / "own");
    grid_ = folder_ / "own" / "egm96_15.gtx";
    write_text(grid_, bytes_.substr(0, 1000000));
    setenv("PROJ_USER_WRITABLE_DIRECTORY", (folder_ / "own").c_str(), 1);
    expect_refused("the user's own folder");
    grid_ = folder_ / "own" / "us_nga_egm96_15.tif";
    write_text(grid_, "<html>404 not found</html>");
    fs::remove(folder_ / "own" / "egm96_15.gtx");
    expect_refused("an error page");
    unsetenv("PROJ_USER_WRITABLE_DIRECTORY");
}

TEST_F(DamagedGeoid, ZerosNoValuesAndForeignNumbersAreErrors) {
    const auto with = [&](std::size_t first, std::size_t count, const std::string& value) {
        std::string bytes = bytes_;
        for (std::size_t i = 0; i < count; ++i) bytes.replace(first + 4 * i, 4, value);
        write_text(grid_, bytes);
    };
    const auto number = [](float value) { return big_endian(&value, sizeof value); };
    with(at(46.25, 8.25), 1, number(std::numeric_limits<float>::quiet_NaN()));
    expect_refused("not a number");
    with(at(46.25, 8.25), 1, number(1e30F));
    expect_refused("1e30");
    with(at(46.25, 8.25), 1, number(-88.8888F));
    expect_refused("no value");
    with(at(46.25, 8.25), 1, number(20.0F));
    expect_refused("a pit of 30 m");
    with(at(46.0, -180.0), 2 * 1440, number(0.0F));  // what a power cut leaves of a file
    expect_refused("zeros");
    write_text(grid_, std::string(bytes_.size(), '\0'));
    expect_refused("nothing but zeros");
}

TEST_F(DamagedGeoid, ProjsDatabaseThatIsThereAndCannotBeReadIsAnError) {
    write_text(grid_, bytes_);
    fs::remove(folder_ / "proj.db");
    for (const std::string& content : {std::string(), std::string("not a database")}) {
        write_text(folder_ / "proj.db", content);
        const ProjFolder only(folder_.string());
        const auto region = test::open_grid(request_);
        ASSERT_FALSE(region.ok()) << content;
        EXPECT_NE(region.error().line().find("proj.db"), std::string::npos) << region.error().line();
    }
}

TEST_F(DamagedGeoid, AWholeCopyIsTakenAndTellsTheSameNEverywhere) {
    write_text(grid_, bytes_);
    const ProjFolder only(folder_.string());
    const auto region = opened(request_);
    ASSERT_TRUE(region);
    EXPECT_NEAR(region->field.undulation.at_m(46.5, 8.0), 50.68, 0.02);
    const auto geoid = GeoidOfRegion::open(true);
    ASSERT_TRUE(geoid.ok());
    const auto world = geoid->undulation({-180, -90, 180, 90});
    ASSERT_TRUE(world.ok()) << world.error().line();
    EXPECT_EQ(world->N_m.size(), 721U * 1441U);
    EXPECT_EQ(grid_state("EPSG:4326+5773").path, grid_.string());
    EXPECT_EQ(grid_state("EPSG:4326+5773").damage, "");
}

// What PROJ gave is wrong though the file is whole: a read that failed within PROJ, and PROJ took what it had
// for the value.
TEST_F(DamagedGeoid, NThatGdalDoesNotReadInTheSameGridIsAnError) {
    write_text(grid_, bytes_);
    const ProjFolder only(folder_.string());
    const auto geoid = GeoidOfRegion::open(true);
    ASSERT_TRUE(geoid.ok());
    auto field = geoid->undulation({8, 46, 9, 47});
    ASSERT_TRUE(field.ok());
    auto grid = ShiftGrid::open(grid_.string());
    ASSERT_TRUE(grid.ok()) << grid.error().line();
    EXPECT_TRUE(check_undulation(*field, *grid).ok());
    field->N_m[7] += 0.0005F;
    EXPECT_TRUE(check_undulation(*field, *grid).ok());
    field->N_m[7] += 0.002F;
    const auto off = check_undulation(*field, *grid);
    ASSERT_FALSE(off.ok());
    EXPECT_NE(off.error().line().find("GDAL reads"), std::string::npos) << off.error().line();
}

TEST_F(DamagedGeoid, GridsOfOtherDatumsAreHeldToTheSame) {
    write_text(grid_, bytes_);
    const fs::path other = folder_ / "egm08_25.gtx";
    Raster raster;
    raster.rows = raster.columns = 11;
    raster.cell_corners = posts_from(8.45, 46.55, 100.0);
    raster.crs = "EPSG:4326+3855";
    request_ = request_for({write_raster(folder_ / "flat.tif", raster, [](int, int) { return 1000.0; })});
    const ProjFolder only(folder_.string());
    const std::string whole = gtx_bytes(40.0, 0.0, 0.25, 61, 101, 60.0F);
    write_text(other, whole);
    std::string reason;
    const auto region = opened(request_, &reason);
    ASSERT_TRUE(region) << reason;
    EXPECT_EQ(region->notes, std::vector<std::string>());
    EXPECT_NEAR(static_cast<double>(region->field.H_at_m(46.5, 8.5)),
                1060.0 - region->field.undulation.at_m(46.5, 8.5), 1e-3);
    for (const std::size_t bytes : {std::size_t{0}, gtx_header, std::size_t{5000}, whole.size() - 1}) {
        write_text(other, whole.substr(0, bytes));
        for (const bool strict : {false, true}) {
            request_.strict_datum = strict;
            const auto refused = test::open_grid(request_);
            ASSERT_FALSE(refused.ok()) << bytes << ": H " << refused->field.H_at_m(46.5, 8.5);
            EXPECT_NE(refused.error().line().find(other.string()), std::string::npos)
                << refused.error().line();
        }
    }
    // Terrain that the grid does not reach: as before, EGM96 stands in and a note says so.
    request_.strict_datum = false;
    write_text(other, gtx_bytes(40.0, 0.0, 0.25, 61, 34, 60.0F));  // ends at 8.25 E
    const auto beyond = opened(request_, &reason);
    ASSERT_TRUE(beyond) << reason;
    EXPECT_EQ(beyond->field.H_at_m(46.5, 8.5), 1000.0F);
    ASSERT_EQ(beyond->notes.size(), 1U);
    EXPECT_NE(beyond->notes[0].find("outside the grid"), std::string::npos) << beyond->notes[0];
}

TEST(ShiftGridTest, GoesRoundAndEndsWhereItEnds) {
    const fs::path folder = scratch_folder();
    write_text(folder / "part.gtx", gtx_bytes(40.0, 0.0, 0.5, 11, 21, 60.0F));
    auto part = ShiftGrid::open((folder / "part.gtx").string());
    ASSERT_TRUE(part.ok()) << part.error().line();
    EXPECT_EQ(*part->at_m(40.0, 0.0), 60.0);
    EXPECT_EQ(*part->at_m(45.0, 10.0), 60.0);
    EXPECT_EQ(*part->at_m(42.3, 363.7), 60.0);
    EXPECT_FALSE(part->at_m(45.1, 5.0)->has_value());
    EXPECT_FALSE(part->at_m(42.0, -0.1)->has_value());
    EXPECT_FALSE(part->at_m(42.0, 0.2, 1.0)->has_value());
    write_text(folder / "round.gtx", gtx_bytes(-90.0, -180.0, 10.0, 19, 36, 60.0F));
    auto round = ShiftGrid::open((folder / "round.gtx").string());
    ASSERT_TRUE(round.ok());
    for (const double lon_deg : {-180.0, 175.0, 179.999999999, 180.0, 185.0, 540.0, 0.0})
        EXPECT_EQ(*round->at_m(0.0, lon_deg), 60.0) << lon_deg;
}

}  // namespace
}  // namespace oro

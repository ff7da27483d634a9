// A TIN that scripts/make-tin makes of a grid, and GDAL writes, read again.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/apps/csv_rows.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::Words;

constexpr double post_step_deg = 1.0 / 1200.0, error_m = 10.0;

// A column of a profile's table at posts of a line along a meridian, by row of posts, counted from the
// equator.
std::map<long, double> at_posts(const std::vector<std::vector<double>>& rows, std::size_t column) {
    std::map<long, double> found;
    for (const std::vector<double>& cells : rows) {
        const double row = cells.at(1) / post_step_deg;
        if (std::abs(row - std::round(row)) < 1.0e-4 && !std::isnan(cells.at(column)))
            found[std::lround(row)] = cells[column];
    }
    return found;
}

class MadeTin : public ::testing::Test {
  protected:
    void SetUp() override {
        if (oro::test::run_program({"/usr/bin/python3", "-c", "from osgeo import ogr; import numpy"})
                .exit_code != 0)
            GTEST_SKIP() << "needs GDAL's Python";
        const Outcome made = oro::test::run_program(
            {"/usr/bin/python3", (oro::test::bundled_data().parent_path() / "scripts/make-tin").string(),
             bundled(), tin_, "--box", "36.56,-84.22,36.62,-84.14", "--error", "10"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        said_ = made.out;
    }
    // names: of the table's columns.
    [[nodiscard]] std::vector<std::vector<double>> profile(const Words& more,
                                                           const std::string& names) const {
        const Outcome run =
            oro::test::run_orograph(joined({"profile", bundled(), "--along", "36.565,-84.18; 36.615,-84.18",
                                            "--out", out_, "--overwrite", "-q"},
                                           more));
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return oro::test::rows_of(oro::test::bytes_of(out_), names);
    }
    const fs::path folder_ = oro::test::scratch_folder();
    const std::string tin_ = (folder_ / "tin.gpkg").string(), out_ = (folder_ / "p.csv").string();
    std::string said_;
};

TEST_F(MadeTin, IsReadAsItWasWritten) {
    const auto mesh =
        oro::test::object_said_by({"info", bundled(), "--mesh-file", tin_, "--json"})["meshes"][0];
    std::string said = said_;
    std::erase(said, ',');
    EXPECT_TRUE(oro::test::says(said, mesh["triangles"].dump() + " triangles of 7081 posts"))
        << said_ << mesh;
    EXPECT_EQ(mesh["crowded_edges"], 0);
    EXPECT_EQ(mesh["turned_edges"], 0);
    EXPECT_EQ(mesh["degenerate"], 0);
}

// No post is farther from the TIN, above or below, than the error that it was made for. A triangle of two
// places is flat, and a line of latitude is not: a centimetre more.
TEST_F(MadeTin, LiesAtEachPostWithinItsError) {
    const std::map<long, double> ground = at_posts(profile({}, "distance_m,lat_deg,lon_deg,H_m,h_m"), 3);
    const std::map<long, double> surveyed =
        at_posts(profile({"--mesh-file", tin_, "--cut-under"},
                         "distance_m,lat_deg,lon_deg,H_m,h_m,top_H_m,top_h_m,on"),
                 5);
    EXPECT_EQ(ground.size(), 61U) << "posts from 36.565 to 36.615";
    double worst_m = 0.0;
    for (const auto& [row, H_m] : ground) {
        const auto there = surveyed.find(row);
        if (there == surveyed.end()) continue;
        worst_m = std::max(worst_m, std::abs(there->second - H_m));
        EXPECT_LE(std::abs(there->second - H_m), error_m + 0.01) << row;
    }
    EXPECT_GT(worst_m, 1.0) << "it is the TIN that is asked, and not the grid";
    EXPECT_GT(surveyed.size(), 50U);
}

}  // namespace

// A TIN that scripts/make-tin makes of a grid, and GDAL writes, read again.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::Words;

constexpr double post_step_deg = 1.0 / 1200.0, error_m = 10.0;

// The column `name` of a profile's .csv at posts of a line along a meridian, by row of posts, counted from the equator.
std::map<long, double> at_posts(const std::string& csv, const std::string& name) {
    std::istringstream lines(csv);
    std::string line, cell;
    std::getline(lines, line);
    std::istringstream head(line);
    std::size_t wanted = 0, column = 0;
    while (std::getline(head, cell, ',') && cell != name) ++wanted;
    EXPECT_EQ(cell, name);
    std::map<long, double> found;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        double lat_deg = 0.0;
        cell.clear();
        for (column = 0; column <= wanted && std::getline(cells, cell, ','); ++column)
            if (column == 1) lat_deg = std::stod(cell);
        if (column <= wanted) cell.clear();
        const double row = lat_deg / post_step_deg;
        if (std::abs(row - std::round(row)) < 1.0e-4 && !cell.empty()) found[std::lround(row)] = std::stod(cell);
    }
    return found;
}

class MadeTin : public ::testing::Test {
  protected:
    void SetUp() override {
        if (oro::test::run_program({"/usr/bin/python3", "-c", "from osgeo import ogr; import numpy"}).exit_code != 0)
            GTEST_SKIP() << "needs GDAL's Python";
        const Outcome made = oro::test::run_program({"/usr/bin/python3", (oro::test::bundled_data().parent_path() / "scripts/make-tin").string(),
                                                     bundled(), tin_, "--box", "36.56,-84.22,36.62,-84.14", "--error", "10"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        said_ = made.out;
    }
    [[nodiscard]] std::string profile(const Words& more) const {
        const Outcome run = oro::test::run_orograph(
            joined({"profile", bundled(), "--along", "36.565,-84.18; 36.615,-84.18", "--out", out_, "--overwrite", "-q"}, more));
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return oro::test::bytes_of(out_);
    }
    const fs::path folder_ = oro::test::scratch_folder();
    const std::string tin_ = (folder_ / "tin.gpkg").string(), out_ = (folder_ / "p.csv").string();
    std::string said_;
};

TEST_F(MadeTin, IsReadAsItWasWritten) {
    const auto mesh = oro::test::object_said_by({"info", bundled(), "--mesh-file", tin_, "--json"})["meshes"][0];
    const std::string triangles = std::to_string(mesh["triangles"].get<int>());
    EXPECT_TRUE(oro::test::says(said_, triangles.substr(0, 1) + "," + triangles.substr(1) + " triangles of 7,081 posts"))
        << said_ << triangles;
    EXPECT_EQ(mesh["crowded_edges"], 0);
    EXPECT_EQ(mesh["turned_edges"], 0);
    EXPECT_EQ(mesh["degenerate"], 0);
}

// No post is farther from the TIN, above or below, than the error that it was made for. A triangle of two places is flat, and a line
// of latitude is not: a centimetre more.
TEST_F(MadeTin, LiesAtEachPostWithinItsError) {
    const std::map<long, double> ground = at_posts(profile({}), "H_m");
    const std::map<long, double> surveyed = at_posts(profile({"--mesh-file", tin_, "--cut-under"}), "top_H_m");
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

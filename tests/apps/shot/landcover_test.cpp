// --landcover as users meet it: which class a pixel shows, what tells of it, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;

// Terrain, and over it cells of 0.01 degree in WorldCover's codes.
class ShotLandcover : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const std::string land = (oro::test::bundled_data() / "jacksboro.tif").string();

    [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
    [[nodiscard]] Words shot(const Words& more, const std::string& out) const {
        Words words{"shot",    land,     "--at",      "36.5,-84.25",
                    "--above", "900",    "--heading", "320",
                    "--pitch", "-20",    "--size",    "160x120",
                    "--sun",   "300,30", "--time",    "2026-01-02T03:04:05Z",
                    "--out",   path(out)};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    // Rows from the north, in an ASCII grid, which GDAL's program makes a GeoTIFF of.
    [[nodiscard]] std::string write_cover(const std::string& name, const std::vector<int>& codes) const {
        std::ofstream grid(path(name + ".asc"));
        grid << "ncols 60\nnrows 60\nxllcorner -84.6\nyllcorner 36.2\ncellsize 0.01\n";
        for (int row = 0; row < 60; ++row) {
            for (int column = 0; column < 60; ++column)
                grid << codes[static_cast<std::size_t>(row * 7 + column * 3) % codes.size()] << ' ';
            grid << '\n';
        }
        grid.close();
        const Outcome made = run_program({"gdal_translate", "-q", "-ot", "Byte", "-a_srs", "EPSG:4326",
                                          path(name + ".asc"), path(name + ".tif")});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return path(name + ".tif");
    }
};

// All values of a raster of one band, row by row, as GDAL reads them.
std::vector<double> values_in(const std::string& file) {
    const std::string raw = file + ".raw";
    const Outcome made = run_program({"gdal_translate", "-q", "-of", "ENVI", "-ot", "Float64", file, raw});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const std::string bytes = bytes_of(raw);
    std::vector<double> values(bytes.size() / sizeof(double));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
    return values;
}

// What gdallocationinfo reads of a raster at places; NaN where it reads nothing.
std::vector<double> read_by_gdal(const std::string& file, const std::vector<double>& lon,
                                 const std::vector<double>& lat, const std::string& list) {
    std::ofstream places(list);
    places.precision(17);
    for (std::size_t i = 0; i < lon.size(); ++i) places << lon[i] << ' ' << lat[i] << '\n';
    places.close();
    const Outcome read =
        run_program({"sh", "-c", "gdallocationinfo -valonly -wgs84 '" + file + "' <'" + list + "'"});
    std::istringstream lines(read.out);
    std::vector<double> values;
    for (std::string line; std::getline(lines, line);) values.push_back(line.empty() ? NAN : std::stod(line));
    return values;
}

// The classes of a picture's pixels are those that GDAL reads at their places: all of them.
void expect_gdals_classes(const fs::path& folder, const std::string& cover) {
    const auto layer = [&](const char* name) {
        return values_in((folder / ("p." + std::string(name) + ".tif")).string());
    };
    const std::vector<double> lon = layer("longitude"), lat = layer("latitude"), codes = layer("cover");
    std::vector<double> ground_lon, ground_lat, ground_codes;
    for (std::size_t i = 0; i < lon.size(); ++i) {
        if (std::isnan(lon[i])) {
            EXPECT_TRUE(std::isnan(codes[i]));
            continue;
        }
        ground_lon.push_back(lon[i]);
        ground_lat.push_back(lat[i]);
        ground_codes.push_back(codes[i]);
    }
    ASSERT_GT(ground_lon.size(), 5000U);
    const std::vector<double> truth =
        read_by_gdal(cover, ground_lon, ground_lat, (folder / "places.txt").string());
    ASSERT_EQ(truth.size(), ground_codes.size());
    std::size_t other = 0, known = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const bool is_known = truth[i] > 0.0;
        known += is_known ? 1 : 0;
        other += (is_known ? ground_codes[i] != truth[i] : !std::isnan(ground_codes[i])) ? 1 : 0;
    }
    EXPECT_GT(known, 3000U);
    EXPECT_EQ(other, 0U) << "of " << truth.size();
}

TEST_F(ShotLandcover, LayersHoldTheClassThatGdalReadsThere) {
    const std::string cover = write_cover("c", {10, 30, 0, 40, 60, 80});
    const auto said =
        object_said_by(shot({"--landcover", cover + ",worldcover", "--layers", "--json", "-q"}, "p.png"));
    EXPECT_EQ(said["layers"]["cover"], path("p.cover.tif"));
    EXPECT_EQ(said["landcover"]["table"], "worldcover");
    EXPECT_EQ(said["view"]["landcover"], (json{{"files", {cover}}, {"table", "worldcover"}}));
    expect_gdals_classes(folder, cover);
    const auto info = oro::test::one_object(run_program({"gdalinfo", "-json", path("p.cover.tif")}).out);
    EXPECT_EQ(info["metadata"][""]["CLASS_10"], "tree cover");
}

TEST_F(ShotLandcover, OfARealOneLayersHoldTheClassThatGdalReadsThere) {
    const auto cover = oro::test::real_data("cover/li_cover_osm_worldcover_codes.tif");
    const auto terrain = oro::test::real_data("alps");
    if (!cover || !terrain) GTEST_SKIP() << "needs alps and cover/li_cover_osm_worldcover_codes.tif";
    const auto said = object_said_by(
        {"shot", terrain->string(), "--tile",   "N47E009",     "--at",          "47.10,9.48", "--above",
         "900",  "--heading",       "20",       "--pitch",     "-12",           "--size",     "240x160",
         "-q",   "--json",          "--layers", "--landcover", cover->string(), "--out",      path("p.png")});
    EXPECT_EQ(said["landcover"]["table"], "worldcover") << "by its codes";
    expect_gdals_classes(folder, cover->string());
}

TEST_F(ShotLandcover, ColoursThePictureWhichItsViewDrawsAgain) {
    const std::string cover = write_cover("c", {10, 30, 20, 40, 50, 60, 80});
    const Outcome drawn = run_orograph(shot({"--style", "natural", "--landcover", cover}, "a.png"));
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_NE(drawn.err.find("c.tif: its codes are taken for those of ESA WorldCover (worldcover)"),
              std::string::npos)
        << drawn.err;
    ASSERT_EQ(run_orograph(shot({"--style", "natural", "-q"}, "bare.png")).exit_code, 0);
    const json with = json::parse(view_in(path("a.png"))), without = json::parse(view_in(path("bare.png")));
    EXPECT_EQ(with["landcover"], (json{{"files", {"c.tif"}}, {"table", "worldcover"}}));
    EXPECT_EQ(with["fingerprints"]["landcover"].size(), 2U) << "the file and the table";
    EXPECT_FALSE(without.contains("landcover"));
    EXPECT_NE(with["fingerprints"]["pixels"], without["fingerprints"]["pixels"]);
    ASSERT_EQ(run_orograph({"shot", "--view", path("a.png"), "--out", path("b.png"), "-q"}).exit_code, 0);
    EXPECT_EQ(bytes_of(path("a.png")), bytes_of(path("b.png")));
    // Styles that are not coloured by cover show nothing of it.
    ASSERT_EQ(run_orograph(shot({"-q", "--style", "relief"}, "r.png")).exit_code, 0);
    ASSERT_EQ(run_orograph(shot({"-q", "--style", "relief", "--landcover", cover}, "s.png")).exit_code, 0);
    EXPECT_EQ(json::parse(view_in(path("r.png")))["fingerprints"]["pixels"],
              json::parse(view_in(path("s.png")))["fingerprints"]["pixels"]);
}

TEST_F(ShotLandcover, SightNamesTheClasses) {
    const std::string cover = write_cover("c", {30});
    const Outcome seen = run_orograph({"sight", land, "--from", "36.5,-84.25", "--to", "36.51,-84.26",
                                       "--landcover", cover + ",worldcover"});
    ASSERT_EQ(seen.exit_code, 0) << seen.err;
    EXPECT_NE(seen.out.find("above the ground, grassland\n"), std::string::npos) << seen.out;
}

TEST_F(ShotLandcover, IsRefusedInOneLine) {
    const std::string few = write_cover("few", {10, 30}), none = write_cover("none", {251, 253});
    expect_refusal(run_orograph(shot({"-q", "--landcover", few}, "a.png")), failed,
                   {"few.tif", "its codes (10, 30)", "cci, corine and worldcover"});
    expect_refusal(run_orograph(shot({"-q", "--landcover", none}, "a.png")), failed,
                   {"none.tif", "are those of no table"});
    expect_refusal(run_orograph(shot({"-q", "--landcover", none + ",nlcd"}, "a.png")), failed,
                   {"none.tif", "holds none of the codes of nlcd, but 251, 253"});
    expect_refusal(run_orograph(shot({"-q", "--landcover", few + ",moss"}, "a.png")), usage,
                   {"--landcover", "there is no table moss", "worldcover"});
    expect_refusal(run_orograph(shot({"-q", "--landcover", path("gone.tif")}, "a.png")), failed,
                   {"gone.tif", "no such raster of land cover"});
    EXPECT_FALSE(fs::exists(path("a.png")));
}

}  // namespace

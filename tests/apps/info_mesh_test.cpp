// orograph info of files of meshes, with where they lie.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using oro::test::expect_refusal;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::usage;
using oro::test::Words;

class InfoOfMeshes : public ::testing::Test {
  protected:
    InfoOfMeshes() {
        oro::test::write_bytes(
            ply_,
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
            "property double z\nelement face 1\nproperty list uchar int vertex_indices\n"
            "end_header\n2600000 1200000 500\n2600100 1200000 500\n2600000 1200100 600\n"
            "3 0 1 2\n");
    }
    const fs::path folder_ = oro::test::scratch_folder();
    const std::string ply_ = (folder_ / "a.ply").string();
};

// The origin of LV95, (2600000, 1200000), by swisstopo's approximate formulas: 16.9023892 and 2.6779094 times
// 100/36 degrees, within 0.12 seconds of arc.
TEST_F(InfoOfMeshes, TellsWhereTheyLieByTheCrsThatIsAsked) {
    const auto said = oro::test::object_said_by({"info", ply_, "--mesh-crs", "EPSG:2056", "--json"});
    const auto placed = said["meshes"][0]["placed"];
    EXPECT_EQ(placed["crs"], "EPSG:2056 CH1903+ / LV95");
    EXPECT_NEAR(placed["south_deg"].get<double>(), 46.951081, 3.4e-5);
    EXPECT_NEAR(placed["west_deg"].get<double>(), 7.438637, 3.4e-5);
    EXPECT_EQ(placed["lowest_m"], 500.0);
    EXPECT_EQ(placed["highest_m"], 600.0);
    EXPECT_TRUE(said["meshes"][0]["crs"].is_null()) << "the file states none";
    const Outcome text = run_orograph({"info", ply_, "--mesh-crs", "EPSG:2056"});
    EXPECT_TRUE(says(text.out,
                     "  lies in:       EPSG:2056 CH1903+ / LV95\n    latitude     46.951083 to 46.951982\n"
                     "    longitude    7.438632 to 7.439946\n"
                     "    H            500.000 to 600.000 m above sea level (EGM96)\n"))
        << text.out;
}

// Feet of 0.3048 m in WGS84's degrees: heights alone count in them.
TEST_F(InfoOfMeshes, TakesTheUnitToo) {
    oro::test::write_bytes(ply_,
                           "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                           "property double z\nelement face 1\nproperty list uchar int vertex_indices\n"
                           "end_header\n7.5 46.5 1000\n7.501 46.5 1000\n7.5 46.501 2000\n3 0 1 2\n");
    const auto said =
        oro::test::object_said_by({"info", ply_, "--mesh-crs", "EPSG:4326", "--mesh-unit", "ft", "--json"});
    EXPECT_NEAR(said["meshes"][0]["placed"]["lowest_m"].get<double>(), 304.8, 1.0e-9);
    EXPECT_NEAR(said["meshes"][0]["placed"]["highest_m"].get<double>(), 609.6, 1.0e-9);
}

// A triangle of 1 m in degrees was counted as one without an area, as a lattice of 54 m has it.
TEST_F(InfoOfMeshes, CountsInMetresOfTheDegreesThatAreAsked) {
    oro::test::write_bytes(ply_,
                           "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                           "property double z\nelement face 1\nproperty list uchar int vertex_indices\n"
                           "end_header\n7.5 46.5 500\n7.50001 46.5 500\n7.5 46.50001 500\n3 0 1 2\n");
    const auto said = oro::test::object_said_by({"info", ply_, "--mesh-crs", "EPSG:4326", "--json"});
    EXPECT_EQ(said["meshes"][0]["degenerate"], 0);
    EXPECT_EQ(said["meshes"][0]["vertices"], 3);
    EXPECT_EQ(said["meshes"][0]["rim_edges"], 3);
}

TEST_F(InfoOfMeshes, WithoutTheOptionNothingIsPlacedAndOthersAreRefused) {
    const auto said = oro::test::object_said_by({"info", ply_, "--json"});
    EXPECT_FALSE(said["meshes"][0].contains("placed"));
    EXPECT_FALSE(says(run_orograph({"info", ply_}).out, "lies in"));
    expect_refusal(run_orograph({"info", ply_, "--bbox", "7,46,8,47"}), usage, {"--bbox", "mesh alone"});
    expect_refusal(run_orograph({"info", ply_, "--mesh-crs", "EPSG:99999999"}), usage, {"EPSG:99999999"});
    expect_refusal(run_orograph({"info", ply_, "--mesh-unit", "ft"}), oro::test::failed, {"--mesh-crs"});
}

}  // namespace

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

// A part of an OBJ whose name is blank, a CRS that is none, and --lod of what has no levels.
TEST_F(InfoOfMeshes, SaysWhatIsNamelessOrUnknown) {
    const std::string obj = (folder_ / "part.obj").string(), town = (folder_ / "b.city.json").string();
    oro::test::write_bytes(obj, "v 0 0 0\nv 9 0 0\nv 0 9 0\ng  \nf 1 2 3\ng a\nf 1 3 2\n");
    oro::test::write_bytes(
        town,
        R"({"type":"CityJSON","version":"1.0","metadata":{"referenceSystem":"urn:ogc:def:crs:EPSG::999999"},)"
        R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface",)"
        R"("lod":"1","boundaries":[[[0,1,2]]]}]}},"vertices":[[0,0,0],[9,0,0],[0,9,0]]})");
    const Outcome text = run_orograph({"info", town});
    EXPECT_TRUE(says(text.out, "  CRS:           EPSG:999999, which PROJ does not know\n")) << text.out;
    const auto said = oro::test::object_said_by({"info", town, "--json"});
    EXPECT_EQ(said["meshes"][0]["notes"][0], "its CRS is EPSG:999999, which PROJ does not know");
    expect_refusal(run_orograph({"info", obj, "--lod", "2"}), usage, {"--lod 2: is of CityJSON"});
    expect_refusal(run_orograph({"info", town, "--lod", "9"}), usage, {"level of detail 9", "it has 1"});
}

// The text had notes of them; JSON had an empty list.
TEST_F(InfoOfMeshes, OfATerrainSaysWhatIsKnownOfThoseOnIt) {
    const std::string obj = (folder_ / "a.obj").string(), areas = (folder_ / "a.geojson").string();
    oro::test::write_bytes(obj,
                           "v -84.176 36.604 700\nv -84.175 36.604 700\nv -84.176 36.605 710\nf 1 2 3\n");
    oro::test::write_bytes(areas,
                           R"({"type":"Feature","properties":{"height":70},"geometry":{"type":"Polygon",)"
                           R"("coordinates":[[[-84.1765,36.604],[-84.1755,36.604],[-84.1755,36.606],)"
                           R"([-84.1765,36.604]]]}})");
    const auto said =
        oro::test::object_said_by({"info", oro::test::bundled(), "--mesh-file", obj, "--mesh-file", areas,
                                   "--building-height", "height", "--mesh-crs", "EPSG:4326", "--json"});
    ASSERT_EQ(said["meshes"].size(), 2U);
    EXPECT_EQ(said["meshes"][0]["format"], "OBJ");
    EXPECT_EQ(said["meshes"][0]["rim_edges"], 3);
    EXPECT_EQ(said["meshes"][0]["placed"]["highest_m"], 710.0);
    EXPECT_EQ(said["meshes"][1]["format"], "footprints");
    EXPECT_EQ(said["meshes"][1]["triangles"], 7) << "a roof and two for each of three walls";
    EXPECT_NEAR(said["meshes"][1]["placed"]["south_deg"].get<double>(), 36.604, 1.0e-9);
    const std::string notes = said["region"]["notes"].dump();
    EXPECT_TRUE(says(notes, "a.obj: a mesh of 1 triangle")) << notes;
    EXPECT_TRUE(says(notes, "a.geojson: a mesh of 7 triangles")) << notes;
}

}  // namespace

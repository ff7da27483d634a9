// Triangle meshes on the ground, as users see them: pictures, sight lines, picking, views and refusals.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;

// A house 89 m by 222 m whose roof is at 420 m above sea level; the ground around it is at about 350 m.
std::string house(double roof_m) {
    std::string text;
    for (const double height_m : {300.0, roof_m})
        for (const char* corner :
             {"-84.1765 36.604", "-84.1755 36.604", "-84.1755 36.606", "-84.1765 36.606"})
            text += std::string("v ") + corner + " " + std::to_string(height_m) + "\n";
    return text + "o house\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

class MeshOnTerrain : public ::testing::Test {
  protected:
    void SetUp() override { oro::test::write_bytes(mesh_, house(420.0)); }
    // From 620 m west of the house, 40 m over the ground.
    [[nodiscard]] json shot(const Words& more) const {
        const Outcome drawn = run_orograph(
            joined({"shot", bundled(), "--at", "36.605,-84.1834", "--above", "40", "--heading", "90",
                    "--pitch", "-2", "--size", "160x120", "--out", picture_, "--overwrite", "-q", "--json"},
                   more));
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return drawn.exit_code == 0 ? json::parse(drawn.out) : json::object();
    }
    [[nodiscard]] json fingerprint() const {
        return json::parse(view_in(picture_))["fingerprints"]["pixels"];
    }

    const fs::path folder_ = oro::test::scratch_folder();
    const std::string mesh_ = (folder_ / "house.obj").string(), picture_ = (folder_ / "house.png").string();
    const Words on_it_{"--mesh-file", mesh_, "--mesh-crs", "EPSG:4326"};
};

// Both ways of drawing draw it, the middle is on it, and the picture draws itself again.
TEST_F(MeshOnTerrain, IsDrawnPickedAndDrawnAgain) {
    const json bare = shot({"--pipeline", "compute"});
    EXPECT_EQ(bare["middle"]["source"].get<std::string>().find("house.obj"), std::string::npos);
    const json without = fingerprint();
    EXPECT_FALSE(json::parse(view_in(picture_)).contains("meshes"));
    const json said = shot(joined(on_it_, {"--pipeline", "compute"}));
    EXPECT_TRUE(says(said["middle"].dump(), "house.obj")) << said["middle"].dump();
    const json by_compute = fingerprint();
    EXPECT_NE(by_compute, without);
    EXPECT_EQ(shot(joined(on_it_, {"--pipeline", "mesh"}))["pixels"], said["pixels"]);
    EXPECT_EQ(fingerprint(), by_compute);
    const json view = json::parse(view_in(picture_));
    EXPECT_EQ(view["meshes"]["crs"], "EPSG:4326");
    const std::string again = (folder_ / "again.png").string();
    const Outcome redrawn = run_orograph({"shot", "--view", picture_, "--out", again, "--overwrite", "-q"});
    ASSERT_EQ(redrawn.exit_code, 0) << redrawn.err;
    EXPECT_EQ(json::parse(view_in(again))["fingerprints"]["pixels"], by_compute);
    // A mesh that changed is noticed.
    oro::test::write_bytes(mesh_, house(421.0));
    const Outcome changed = run_orograph({"shot", "--view", picture_, "--out", again, "--overwrite", "-q"});
    EXPECT_NE(changed.exit_code, 0);
    EXPECT_TRUE(says(changed.err, "house.obj")) << changed.err;
}

// What is drawn is what the oracle sees.
TEST_F(MeshOnTerrain, IsWhereTheOracleHasIt) {
    const json said = shot(joined(on_it_, {"--verify"}));
    ASSERT_TRUE(said.contains("verification")) << said.dump();
    EXPECT_LT(said["verification"]["max_px"].get<double>(), 1.5) << said["verification"].dump();
}

// The house blocks a line that is free without it: at its west wall, 415 m of the way of 894.7 m.
TEST_F(MeshOnTerrain, BlocksSight) {
    const Words line{
        "sight",    bundled(), "--from", "36.605,-84.181", "--to", "36.605,-84.171", "--above", "40",
        "--target", "40",      "-q",     "--json"};
    const Outcome bare = run_orograph(line);
    ASSERT_EQ(bare.exit_code, 0) << bare.err;
    EXPECT_EQ(json::parse(bare.out)["visible"], true) << bare.out;
    const Outcome blocked = run_orograph(joined(line, on_it_));
    ASSERT_EQ(blocked.exit_code, 0) << blocked.err;
    const json said = json::parse(blocked.out);
    EXPECT_EQ(said["visible"], false) << blocked.out;
    EXPECT_NEAR(said["obstacle"]["lon_deg"].get<double>(), -84.1765, 1.0e-7) << blocked.out;
}

TEST_F(MeshOnTerrain, InfoTellsHowHighItLies) {
    const Outcome reported = run_orograph(joined({"info", bundled(), "-q"}, on_it_));
    ASSERT_EQ(reported.exit_code, 0) << reported.err;
    EXPECT_TRUE(says(reported.out + reported.err, "over the terrain in the median")) << reported.out << reported.err;
}

TEST_F(MeshOnTerrain, RefusesInOneLine) {
    const Words shot{"shot", bundled(), "--at",  "36.605,-84.1834", "--above",
                     "40",   "-q",      "--out", picture_,          "--overwrite"};
    expect_refusal(run_orograph(joined(shot, {"--mesh-crs", "EPSG:2056"})), usage,
                   {"--mesh-crs", "without --mesh-file"});
    expect_refusal(run_orograph(joined(shot, {"--mesh-file", mesh_})), 1,
                   {"house.obj", "states no coordinate reference system"});
    expect_refusal(run_orograph(joined(shot, {"--mesh-file", mesh_, "--mesh-crs", "EPSG:2056"})), 1,
                   {"house.obj", "none of its triangles has a place", "outside the area of use"});
    expect_refusal(
        run_orograph(joined(shot, {"--mesh-file", (folder_ / "no.obj").string(), "--mesh-crs", "EPSG:4326"})),
        1, {"no.obj"});
    expect_refusal(
        run_orograph(joined({"bake", bundled(), "--out", (folder_ / "x.oro").string(), "-q"}, on_it_)), usage,
        {"--mesh-file", "holds no meshes"});
}

}  // namespace

// Triangle meshes on the ground, as users see them: pictures, sight lines, picking, views and refusals.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::Pixels;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;

// A house 89 m by 222 m whose roof is at 420 m above sea level; the ground around it is at about 350 m.
std::string obj_of_house(double roof_m) {
    std::string text;
    for (const double height_m : {300.0, roof_m})
        for (const char* corner :
             {"-84.1765 36.604", "-84.1755 36.604", "-84.1755 36.606", "-84.1765 36.606"})
            text += std::string("v ") + corner + " " + std::to_string(height_m) + "\n";
    return text + "o house\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

std::size_t pixels_apart(const Pixels& one, const Pixels& other) {
    std::size_t count = 0;
    for (std::size_t i = 0; i + 2 < one.rgb.size() && i + 2 < other.rgb.size(); i += 3)
        count += one.rgb[i] != other.rgb[i] || one.rgb[i + 1] != other.rgb[i + 1] ||
                         one.rgb[i + 2] != other.rgb[i + 2]
                     ? 1U
                     : 0U;
    return count;
}

class MeshOnTerrain : public ::testing::Test {
  protected:
    void SetUp() override { oro::test::write_bytes(mesh_, obj_of_house(420.0)); }
    // From 620 m west of the house, 40 m over the ground.
    json shot(const Words& more) const {
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

// Both ways of drawing draw it, and the picture draws itself again.
TEST_F(MeshOnTerrain, IsDrawnAndDrawnAgain) {
    shot({"--pipeline", "compute"});
    const json without = fingerprint();
    const Pixels bare = pixels_of(picture_);
    EXPECT_FALSE(json::parse(view_in(picture_)).contains("meshes"));
    shot(joined(on_it_, {"--pipeline", "mesh"}));
    const Pixels by_mesh = pixels_of(picture_);
    const json said = shot(joined(on_it_, {"--pipeline", "compute"}));
    EXPECT_TRUE(says(said["destination"]["source"].dump(), "house.obj")) << said["destination"].dump();
    const json by_compute = fingerprint();
    const Pixels drawn = pixels_of(picture_);
    // 45 degrees are 120 rows: the house, 222 m wide and 617 m away, is 52 columns wide and 16 to 18 rows
    // high.
    EXPECT_NEAR(static_cast<double>(pixels_apart(drawn, bare)), 52.0 * 17.0, 52.0) << "px";
    // Where two triangles are as near as each other, either may be drawn.
    EXPECT_LE(pixels_apart(drawn, by_mesh), 10U);
    const json view = json::parse(view_in(picture_));
    EXPECT_EQ(view["meshes"]["crs"], "EPSG:4326");
    const std::string again = (folder_ / "again.png").string();
    const Outcome redrawn = run_orograph({"shot", "--view", picture_, "--out", again, "--overwrite", "-q"});
    ASSERT_EQ(redrawn.exit_code, 0) << redrawn.err;
    EXPECT_EQ(json::parse(view_in(again))["fingerprints"]["pixels"], by_compute);
    // Where data and mesh lie elsewhere now they are named again, the mesh as a PATH or as itself.
    const std::string moved = (folder_ / "moved.obj").string();
    fs::rename(mesh_, moved);
    for (const Words& named :
         {Words{bundled(), moved}, Words{moved}, Words{bundled(), "--mesh-file", moved}}) {
        const Outcome elsewhere = run_orograph(
            joined(joined({"shot"}, named), {"--view", picture_, "--out", again, "--overwrite", "-q"}));
        ASSERT_EQ(elsewhere.exit_code, 0) << elsewhere.err;
        EXPECT_EQ(json::parse(view_in(again))["fingerprints"]["pixels"], by_compute);
    }
    fs::rename(moved, mesh_);
    // A mesh that changed is noticed.
    oro::test::write_bytes(mesh_, obj_of_house(421.0));
    const Outcome changed = run_orograph({"shot", "--view", picture_, "--out", again, "--overwrite", "-q"});
    EXPECT_NE(changed.exit_code, 0);
    EXPECT_TRUE(says(changed.err, "house.obj")) << changed.err;
    oro::test::write_bytes(mesh_, obj_of_house(420.0));
    shot({"--pipeline", "compute"});
    EXPECT_EQ(fingerprint(), without);
}

// What is drawn is what the oracle sees: within tau and a twentieth of a pixel.
TEST_F(MeshOnTerrain, IsWhereTheOracleHasIt) {
    const json said = shot(joined(on_it_, {"--verify"}));
    ASSERT_TRUE(said.contains("error")) << said.dump();
    EXPECT_LT(said["error"]["seen_px"]["max"].get<double>(), 1.05) << said["error"].dump();
    EXPECT_LT(said["error"]["skyline_px"]["max"].get<double>(), 1.05) << said["error"].dump();
    EXPECT_GT(said["error"]["pixels_between_grids"].get<int>(), 500) << said["error"].dump();
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
    EXPECT_EQ(said["obstacle"]["mesh"], mesh_);
    // The roof's west edge, 41.2 m over the eye at 402.6 m of 894.7 m: 91.6 m over the eye at the target,
    // which is 13.6 m over it.
    EXPECT_NEAR(said["target_missed_by_m"].get<double>(), 78.0, 0.1) << "m";
    EXPECT_NEAR(said["obstacle"]["lon_deg"].get<double>(), -84.1765, 1.0e-7) << blocked.out;
}

TEST_F(MeshOnTerrain, InfoTellsHowHighItLies) {
    const Outcome reported = run_orograph(joined({"info", bundled(), "-q"}, on_it_));
    ASSERT_EQ(reported.exit_code, 0) << reported.err;
    EXPECT_TRUE(says(reported.out + reported.err, "over the terrain in the median"))
        << reported.out << reported.err;
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
}

}  // namespace

// Meshes drawn at the detail that a view needs: what is told of it, and that the picture keeps its promise.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

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
using oro::test::Words;

// A hilly ball, 160 m wide, over ground at about 350 m: 3,120 triangles, closed.
std::string obj_of_ball() {
    constexpr int n = 40, around = 40;
    std::string text;
    char line[100];
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k < around; ++k) {
            const double a = std::numbers::pi * i / n, b = 2.0 * std::numbers::pi * k / around;
            const double r = 80.0 + (i > 0 && i < n ? 3.0 * std::sin(7.0 * a) * std::cos(6.0 * b) : 0.0);
            std::snprintf(line, sizeof line, "v %.9f %.9f %.4f\n",
                          -84.176 + r * std::sin(a) * std::sin(b) / 89500.0,
                          36.605 + r * std::sin(a) * std::cos(b) / 111000.0, 430.0 + r * std::cos(a));
            text += line;
        }
    text += "o ball\n";
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < around; ++k) {
            const int c = (k + 1) % around, a = 1 + i * around;
            if (i > 0)
                text += "f " + std::to_string(a + k) + " " + std::to_string(a + around + k) + " " +
                        std::to_string(a + c) + "\n";
            if (i + 1 < n)
                text += "f " + std::to_string(a + c) + " " + std::to_string(a + around + k) + " " +
                        std::to_string(a + around + c) + "\n";
        }
    return text;
}

class MeshClusters : public ::testing::Test {
  protected:
    void SetUp() override { oro::test::write_bytes(mesh_, obj_of_ball()); }
    [[nodiscard]] Outcome shot(const Words& more) const {
        return run_orograph(joined({"shot",      bundled(), "--mesh-file",     mesh_,         "--mesh-crs",
                                    "EPSG:4326", "--at",    "36.605,-84.1834", "--above",     "60",
                                    "--heading", "90",      "--pitch",         "0",           "--size",
                                    "200x150",   "--out",   picture_,          "--overwrite", "-q",
                                    "--json"},
                                   more));
    }
    [[nodiscard]] json said_by(const Words& more) const {
        const Outcome drawn = shot(more);
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return drawn.exit_code == 0 ? json::parse(drawn.out) : json::object();
    }

    const fs::path folder_ = oro::test::scratch_folder();
    const std::string mesh_ = (folder_ / "ball.obj").string(), picture_ = (folder_ / "ball.png").string();
};

// tau and what an edge is found to; the truth has all triangles.
TEST_F(MeshClusters, ArePicturesWithinTauOfTheWholeMesh) {
    const json whole = said_by({});
    EXPECT_FALSE(whole.contains("meshes"));
    const json said = said_by({"--mesh", "clusters", "--verify"});
    const json& meshes = said["meshes"];
    EXPECT_EQ(meshes["of_triangles"], 3120);
    EXPECT_LT(meshes["triangles"], 1600);
    EXPECT_GT(meshes["triangles"], 50);
    EXPECT_GT(meshes["error_m"], 0.0);
    EXPECT_LE(meshes["error_px"], 1.0);
    EXPECT_EQ(said["triangles"]["at_full_resolution"], whole["triangles"]["at_full_resolution"]);
    EXPECT_EQ(said["view"]["mesh"], "clusters");
    for (const char* const part : {"surface_px", "skyline_px"})
        EXPECT_LE(said["error"][part]["max"], 1.0 + 0.05 + 1.0 / 64.0) << part;
    EXPECT_TRUE(says(said["destination"]["source"].dump(), "ball.obj"));
}

TEST_F(MeshClusters, OfLevelZeroAreAllTriangles) {
    const json said = said_by({"--mesh-level", "0"});
    EXPECT_EQ(said["meshes"]["triangles"], 3120);
    EXPECT_EQ(said["meshes"]["error_m"], 0.0);
    const json coarse = said_by({"--mesh-level", "80"});
    EXPECT_LE(coarse["meshes"]["triangles"], 128);
}

TEST_F(MeshClusters, AreDrawnAgainFromAPicture) {
    const json first = said_by({"--mesh", "clusters", "--tau", "2"});
    const Outcome compared = run_orograph({"compare", picture_, "--json", "-q"});
    ASSERT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_EQ(json::parse(compared.out)["pixels"]["differ"], 0) << compared.out;
}

// The ball fills the middle of the picture; below it there is ground.
TEST_F(MeshClusters, AreShownByTheirLevels) {
    const auto drawn = [&](const char* level) {
        static_cast<void>(said_by({"--mesh-level", level, "--show", "levels", "--no-legend"}));
        return pixels_of(picture_).rgb;
    };
    const auto at = [](const std::vector<std::uint8_t>& rgb, int x, int y) {
        const std::size_t first = 3 * static_cast<std::size_t>(y * 200 + x);
        return std::array<int, 3>{rgb[first], rgb[first + 1], rgb[first + 2]};
    };
    const auto blue = at(drawn("0"), 100, 60), green = at(drawn("2"), 100, 60);
    EXPECT_GT(blue[2], blue[1] + 20);
    EXPECT_GT(blue[1], blue[0] + 20);
    EXPECT_GT(green[1], green[0] + 20);
    EXPECT_GT(green[0], green[2] + 20);
    const auto ground = at(drawn("2"), 100, 148);
    EXPECT_LT(std::abs(ground[0] - ground[1]), 16) << "the style's one colour";
    EXPECT_LT(std::abs(ground[1] - ground[2]), 24);
}

TEST_F(MeshClusters, AreShownInColoursOfTheirOwn) {
    const json said = said_by({"--show", "clusters"});
    EXPECT_LT(said["meshes"]["triangles"], 1600) << "of clusters alone: they are what is drawn";
    const Pixels clusters = pixels_of(picture_);
    const Outcome compared = run_orograph({"compare", picture_, "--json", "-q"});
    ASSERT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_EQ(json::parse(compared.out)["pixels"]["differ"], 0) << compared.out;
    static_cast<void>(said_by({"--show", "groups", "--mesh", "clusters"}));
    const Pixels groups = pixels_of(picture_);
    EXPECT_EQ(clusters.rgb.size(), groups.rgb.size()) << "a legend of the same height";
    EXPECT_NE(clusters.rgb, groups.rgb);
    expect_refusal(shot({"--show", "clusters", "--mesh", "grid"}), usage,
                   {"--show clusters", "a mesh lies on the region"});
}

TEST_F(MeshClusters, AreRefusedWhereTheyCannotBe) {
    expect_refusal(shot({"--mesh", "clusters", "--earth", "sphere"}), usage,
                   {"--mesh clusters", "ellipsoid"});
}

}  // namespace

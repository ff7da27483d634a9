// A region baked with its meshes: drawn as with their files, printed by info, and refused where it is
// damaged.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/base/container.h"
#include "tests/apps/program.h"
#include "tests/support/mended_container.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::ChunkType;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::Words;
using oro::test::write_bytes;

// A hilly ball, 120 m wide, over ground at about 350 m: 1,104 triangles, closed.
std::string obj_of_small_ball() {
    constexpr int n = 24, around = 24;
    std::string text;
    char line[100];
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k < around; ++k) {
            const double a = std::numbers::pi * i / n, b = 2.0 * std::numbers::pi * k / around;
            const double r = 60.0 + (i > 0 && i < n ? 2.0 * std::sin(5.0 * a) * std::cos(4.0 * b) : 0.0);
            std::snprintf(line, sizeof line, "v %.9f %.9f %.4f\n",
                          -84.176 + r * std::sin(a) * std::sin(b) / 89500.0,
                          36.605 + r * std::sin(a) * std::cos(b) / 111000.0, 430.0 + r * std::cos(a));
            text += line;
        }
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

class MeshBake : public ::testing::Test {
  protected:
    void SetUp() override {
        write_bytes(mesh_, obj_of_small_ball());
        const Outcome done = run_orograph({"bake", bundled(), "--mesh-file", mesh_, "--mesh-crs", "EPSG:4326",
                                           "--out", baked_, "--json", "-q"});
        ASSERT_EQ(done.exit_code, 0) << done.err;
        said_ = json::parse(done.out);
    }
    [[nodiscard]] Outcome shot(const Words& data, const std::string& out, const Words& more) const {
        return run_orograph(
            joined(joined({"shot"}, data),
                   joined({"--at", "36.605,-84.1834", "--above", "60", "--heading", "90", "--pitch", "0",
                           "--size", "160x120", "--out", out, "--overwrite", "-q", "--json"},
                          more)));
    }
    const fs::path folder_ = oro::test::scratch_folder();
    const std::string mesh_ = (folder_ / "ball.obj").string(), baked_ = (folder_ / "ball.oro").string(),
                      one_ = (folder_ / "one.png").string(), other_ = (folder_ / "other.png").string();
    const Words files_{bundled(), "--mesh-file", mesh_, "--mesh-crs", "EPSG:4326"};
    json said_;
};

TEST_F(MeshBake, IsDrawnAsTheFilesAre) {
    EXPECT_EQ(said_["meshes"][0]["name"], "ball.obj");
    EXPECT_EQ(said_["meshes"][0]["triangles"], 1104);
    EXPECT_LT(said_["meshes"][0]["bytes"], 9 * 1104);
    for (const Words& how : {Words{}, Words{"--mesh", "clusters"}, Words{"--mesh-level", "2"}}) {
        const Outcome of_files = shot(files_, one_, how), of_bake = shot({baked_}, other_, how);
        ASSERT_EQ(of_files.exit_code, 0) << of_files.err;
        ASSERT_EQ(of_bake.exit_code, 0) << of_bake.err;
        const json a = json::parse(of_files.out), b = json::parse(of_bake.out);
        EXPECT_EQ(a["triangles"]["at_full_resolution"], b["triangles"]["at_full_resolution"]);
        EXPECT_EQ(a["destination"]["source"], mesh_);
        EXPECT_EQ(b["destination"]["source"], "ball.obj");
        if (!how.empty()) {
            EXPECT_EQ(a["meshes"]["triangles"], b["meshes"]["triangles"]);
            EXPECT_EQ(a["meshes"]["error_m"], b["meshes"]["error_m"]);
        }
    }
    // Its layers have the mesh, too, and what stands on its top is looked for there.
    const Outcome layered = shot({baked_}, other_, {"--layers"});
    ASSERT_EQ(layered.exit_code, 0) << layered.err;
    EXPECT_EQ(json::parse(layered.out)["layers"].count("feature"), 1U);
    EXPECT_TRUE(fs::exists(folder_ / "other.feature.tif"));
    const Outcome tops = run_orograph({"viewshed", baked_, "--at", "36.605,-84.1834", "--radius", "1",
                                       "--target-on", "top", "--out", (folder_ / "top.tif").string(), "-q"});
    EXPECT_EQ(tops.exit_code, 0) << tops.err;
    // What was drawn of the files is what the baked region draws, but for colours of heights to 0.2 mm.
    const Outcome compared = run_orograph({"compare", other_, "--json", "-q"});
    ASSERT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_EQ(json::parse(compared.out)["pixels"]["differ"], 0);
}

TEST_F(MeshBake, IsToldByInfoAndMeasuredAgain) {
    const Outcome printed = run_orograph({"info", baked_, "--check", "--json"});
    ASSERT_EQ(printed.exit_code, 0) << printed.err;
    const json mesh = json::parse(printed.out)["meshes"][0];
    EXPECT_EQ(mesh["triangles"], 1104);
    EXPECT_EQ(mesh["levels"][0]["triangles"], 1104);
    EXPECT_EQ(mesh["levels"][0]["largest_error_m"], 0.0);
    EXPECT_GT(mesh["levels"].size(), 3U);
    const Outcome rows = run_orograph({"info", baked_});
    EXPECT_NE(rows.out.find("mesh:        ball.obj, OBJ, 1,104 triangles"), std::string::npos) << rows.out;
}

TEST_F(MeshBake, DamagedIsRefusedInOneLine) {
    const oro::Chunk chunk = oro::test::chunk_of(baked_, ChunkType::mesh_triangles);
    std::string bytes = bytes_of(baked_);
    bytes[static_cast<std::size_t>(chunk.offset) + chunk.bytes / 2] ^= 8;
    write_bytes(baked_, bytes);
    expect_refusal(shot({baked_}, one_, {}), failed, {"ball.oro", "checksum"});
    // The same with checksums made right.
    write_bytes(baked_, oro::test::mended(bytes));
    const Outcome mended = run_orograph({"info", baked_, "--check"});
    EXPECT_EQ(mended.exit_code, failed) << mended.out;
}

TEST_F(MeshBake, HasTheSameBytesAgain) {
    const std::string again = (folder_ / "again.oro").string();
    const Outcome done = run_orograph(joined({"bake"}, joined(files_, {"--out", again, "-q"})));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(bytes_of(again), bytes_of(baked_));
    EXPECT_FALSE(fs::exists(again + ".mesh-1"));
    expect_refusal(run_orograph(joined({"bake"}, joined(files_, {"--out", again, "--cut-under"}))), usage,
                   {"--cut-under"});
}

// What cannot take meshes says that it leaves them out.
TEST_F(MeshBake, IsLeftOutOfOtherFormatsThan3DTilesWithANote) {
    const Outcome out = run_orograph({"export", baked_, "--to", "cog", "--out", folder_ / "h.tif"});
    ASSERT_EQ(out.exit_code, 0) << out.err;
    EXPECT_NE(out.err.find("1 mesh of this baked region is left out"), std::string::npos) << out.err;
    EXPECT_NE(out.err.find("--to 3dtiles"), std::string::npos) << out.err;
    const Outcome bare = run_orograph({"export", bundled(), "--to", "cog", "--out", folder_ / "b.tif"});
    EXPECT_EQ(bare.err.find("left out"), std::string::npos) << bare.err;
}

// A frame of a film, a panorama: drawn by clusters, too.
TEST_F(MeshBake, IsFilmedByClusters) {
    const std::string path = (folder_ / "path.json").string(), frames = (folder_ / "frames").string();
    write_bytes(path, R"({"orograph_path": 1, "keys": [
      {"time_s": 0, "eye": {"lat_deg": 36.605, "lon_deg": -84.1834, "h_m": 400}, "heading_deg": 90, "pitch_deg": 0},
      {"time_s": 1, "eye": {"lat_deg": 36.605, "lon_deg": -84.25, "h_m": 500}, "heading_deg": 90, "pitch_deg": 0}
    ]})");
    const Outcome filmed = run_orograph(
        {"film", path, baked_, "--mesh", "clusters", "--out", frames, "--fps", "2", "--size", "96x64", "-q"});
    ASSERT_EQ(filmed.exit_code, 0) << filmed.err;
    for (const std::string& name : oro::test::names_in(frames)) {
        const Outcome compared = run_orograph({"compare", frames + "/" + name, "--json", "-q"});
        ASSERT_EQ(compared.exit_code, 0) << compared.err;
        EXPECT_EQ(json::parse(compared.out)["pixels"]["differ"], 0) << name;
    }
}

TEST_F(MeshBake, HasPanoramasByClusters) {
    const Outcome drawn =
        run_orograph({"panorama", baked_, "--mesh", "clusters", "--at", "36.605,-84.1834", "--above", "60",
                      "--sector", "60,120", "--width", "500", "--out", one_, "--json", "-q"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(json::parse(drawn.out)["view"]["mesh"], "clusters");
}

// A rough hill beside the ball: 44,402 triangles, whose graph takes seconds.
std::string obj_of_rough_hill() {
    constexpr int n = 150;
    std::string text;
    char line[100];
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double x = i / (n - 1.0), y = k / (n - 1.0);
            std::snprintf(
                line, sizeof line, "v %.9f %.9f %.4f\n", -84.18 + 0.004 * x, 36.61 + 0.003 * y,
                500.0 + 20.0 * std::sin(9.0 * x) * std::cos(7.0 * y) + 0.7 * std::sin(91.0 * i * k));
            text += line;
        }
    for (int i = 0; i + 1 < n; ++i)
        for (int k = 0; k + 1 < n; ++k) {
            const int a = 1 + i * n + k;
            text += "f " + std::to_string(a) + " " + std::to_string(a + n) + " " + std::to_string(a + n + 1) +
                    "\nf " + std::to_string(a) + " " + std::to_string(a + n + 1) + " " +
                    std::to_string(a + 1) + "\n";
        }
    return text;
}

// Killed while the second mesh's graph is built: the same command takes the first one's from there, and
// writes what it would have written at once.
TEST(MeshBakeBrokenOff, TakesMeshesThatAreDone) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string ball = folder.string() + "-ball.obj", hill = folder.string() + "-hill.obj",
                      out = (folder / "region.oro").string();
    write_bytes(ball, obj_of_small_ball());
    write_bytes(hill, obj_of_rough_hill());
    const Words bake{"bake",       bundled(),   "--mesh-file", ball, "--mesh-file", hill,
                     "--mesh-crs", "EPSG:4326", "--out",       out,  "--json",      "-q"};
    const auto begun = std::chrono::steady_clock::now();
    const Outcome whole = run_orograph(bake);
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    const double duration_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    const json said = json::parse(whole.out)["meshes"];
    EXPECT_FALSE(said[0]["of_a_bake_broken_off"]);
    EXPECT_EQ(said[1]["triangles"], 44402);
    const std::string expected = bytes_of(out);
    bool is_between = false;
    for (const double share : {0.5, 0.6, 0.4, 0.7, 0.3, 0.8, 0.2}) {
        for (const std::string& name : oro::test::names_in(folder)) fs::remove(folder / name);
        oro::test::Circumstances broken_off;
        broken_off.signal = SIGKILL, broken_off.signal_after_s = share * duration_s;
        const Outcome killed = run_orograph(bake, broken_off);
        is_between =
            killed.exit_code == 128 + SIGKILL && fs::exists(out + ".mesh-1") && !fs::exists(out + ".mesh-2");
        if (is_between) break;
    }
    ASSERT_TRUE(is_between);
    EXPECT_FALSE(fs::exists(out));
    const Outcome second = run_orograph(bake);
    ASSERT_EQ(second.exit_code, 0) << second.err;
    const json again = json::parse(second.out)["meshes"];
    EXPECT_TRUE(again[0]["of_a_bake_broken_off"]);
    EXPECT_FALSE(again[1]["of_a_bake_broken_off"]);
    EXPECT_TRUE(bytes_of(out) == expected);
    EXPECT_EQ(oro::test::names_in(folder), Words{"region.oro"});
    fs::remove(ball), fs::remove(hill);
}

}  // namespace

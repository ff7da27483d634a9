// A region baked with its clusters: told, drawn, broken off, and refused where it cannot be or is damaged.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "tests/apps/baked/baking.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::Bake;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::names_in;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::view_in;
using oro::test::Words;
using oro::test::write_bytes;

class ClustersBake : public Bake {
  protected:
    const fs::path out_ = folder / "tile.oro";
    const std::string part_ = folder.string() + "-part.tif";
    static Words eye() {
        return {"--at",    "36.53,-84.35", "--above", "900",     "--heading", "70",
                "--pitch", "-15",          "--size",  "160x120", "-q",        "--overwrite"};
    }
    void SetUp() override {
        ASSERT_EQ(run_program({"gdal_translate", "-q", "-projwin", "-84.37", "36.62", "-84.2", "36.47",
                               bundled(), part_})
                      .exit_code,
                  0);
    }
    void TearDown() override { fs::remove(part_); }
    // Of a part of the bundled region, 204 x 180 posts: four pages.
    Outcome bake(const Words& more = {"-q"}, const oro::test::Circumstances& circumstances = {}) const {
        return run_orograph(joined({"bake", part_, "--mesh", "clusters", "--out", out_}, more),
                            circumstances);
    }
    static std::string pixels_of(const fs::path& picture) {
        return json::parse(view_in(picture))["fingerprints"]["pixels"].get<std::string>();
    }
    fs::path shot(const fs::path& region, const std::string& name, const Words& more) const {
        const fs::path picture = folder / name;
        const Outcome outcome = run_orograph(joined(joined({"shot", region, "--out", picture}, eye()), more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return picture;
    }
};

TEST_F(ClustersBake, IsToldAndDrawn) {
    const json reported =
        object_said_by({"bake", bundled(), "--mesh", "clusters", "--out", out_, "-q", "--json"});
    EXPECT_GT(reported["clusters"]["levels"], 10);
    EXPECT_EQ(names_in(folder), Words{"tile.oro"});
    const json info = object_said_by({"info", out_, "--check", "--json"});
    EXPECT_EQ(info["file"]["clusters"]["triangles"], reported["clusters"]["triangles"]);
    EXPECT_NE(run_orograph({"info", out_}).out.find("clusters"), std::string::npos);
    for (const char* pipeline : {"mesh", "compute"}) {
        const Words by{"--pipeline", pipeline};
        const fs::path clusters = shot(out_, "clusters.png", by), again = shot(out_, "again.png", by);
        EXPECT_EQ(pixels_of(clusters), pixels_of(again));
        EXPECT_EQ(json::parse(view_in(clusters))["mesh"], "clusters");
        // By blocks the picture is that of the files, and says nothing of a mesh.
        const fs::path blocks = shot(out_, "blocks.png", joined(by, {"--mesh", "grid"}));
        const fs::path files = shot(bundled(), "files.png", by);
        EXPECT_EQ(pixels_of(blocks), pixels_of(files));
        EXPECT_FALSE(json::parse(view_in(blocks)).contains("mesh"));
        EXPECT_EQ(run_orograph({"compare", clusters, "-q"}).exit_code, 0);
    }
}

TEST_F(ClustersBake, GoesOnWhereItWasBrokenOff) {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(bake().exit_code, 0);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const std::string whole = bytes_of(out_);
    std::mt19937_64 random(341);
    for (int i = 0; i < 6; ++i) {
        fs::remove(out_);
        oro::test::Circumstances killed;
        killed.signal = 9;
        killed.signal_after_s = took.count() * (0.1 + 0.12 * static_cast<double>(random() % 8));
        bake({"-q"}, killed);
        if (fs::exists(out_)) {
            EXPECT_EQ(bytes_of(out_), whole) << "it is whole or not there";
        }
        ASSERT_EQ(bake({"-q", "--overwrite"}).exit_code, 0);
        EXPECT_EQ(bytes_of(out_), whole) << "seed 341, turn " << i;
        EXPECT_EQ(names_in(folder), Words{"tile.oro"});
    }
}

TEST_F(ClustersBake, WhatHasNoneIsRefused) {
    const fs::path plain = baked();
    expect_refusal(run_orograph(joined(joined({"shot", plain, "--out", folder / "x.png"}, eye()),
                                       {"--mesh", "clusters"})),
                   2, {"--mesh clusters", "the region has no clusters"});
    ASSERT_EQ(bake().exit_code, 0);
    expect_refusal(run_orograph(joined(joined({"shot", out_, "--out", folder / "x.png"}, eye()),
                                       {"--mesh", "clusters", "--exaggeration", "2"})),
                   2, {"--mesh clusters", "exaggeration"});
    const std::string warped = folder / "warped.tif";
    ASSERT_EQ(run_program({"gdalwarp", "-q", "-t_srs", "EPSG:32616", bundled(), warped}).exit_code, 0);
    expect_refusal(run_orograph({"bake", warped, "--mesh", "clusters", "--out", folder / "net.oro", "-q"}), 2,
                   {"--mesh clusters", "CRS of their own"});
    write_bytes(folder / "other.oro.clusters", "mine");
    expect_refusal(
        run_orograph({"bake", bundled(), "--mesh", "clusters", "--out", folder / "other.oro", "-q"}), 1,
        {"other.oro.clusters", "is there already"});
}

// A flipped bit is told by info --check, and nothing wrong is drawn: a picture is that of the whole file, or
// none.
TEST_F(ClustersBake, DamageIsOneLine) {
    constexpr unsigned seed = 342;
    ASSERT_EQ(bake().exit_code, 0);
    const std::string whole = bytes_of(out_);
    const std::string right = pixels_of(shot(out_, "right.png", {"--pipeline", "compute"}));
    const fs::path damaged = folder / "damaged.oro", picture = folder / "damaged.png";
    std::mt19937_64 random(seed);
    int drawn = 0;
    for (int i = 0; i < 16; ++i) {
        std::string bytes = whole;
        const std::size_t at = i < 4 ? static_cast<std::size_t>(i) * 9 : random() % whole.size();
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        write_bytes(damaged, bytes);
        const Outcome checked = run_orograph({"info", damaged, "--check", "-q"});
        EXPECT_NE(checked.exit_code, 0) << "seed " << seed << ", byte " << at;
        EXPECT_EQ(checked.err_lines().size(), 1U) << checked.err;
        fs::remove(picture);
        const Outcome shown = run_orograph(
            joined(joined({"shot", damaged, "--out", picture}, eye()), {"--pipeline", "compute"}));
        if (shown.exit_code == 0) {
            ++drawn;
            EXPECT_EQ(pixels_of(picture), right) << "seed " << seed << ", byte " << at;
        } else {
            EXPECT_EQ(shown.err_lines().size(), 1U) << shown.err;
            EXPECT_FALSE(fs::exists(picture));
        }
    }
    std::printf("seed %u: of 16 damaged files %d were drawn, as the whole one\n", seed, drawn);
}

// One of them makes the file; the others say why they do not, and leave nothing.
TEST_F(ClustersBake, EightAtOnceLeaveOneFile) {
    const std::string session = R"sh(
        out=$1; shift
        for i in 1 2 3 4 5 6 7 8; do "$@" & done
        wait
        ls "$(dirname "$out")")sh";
    for (const Words& more : {Words{}, Words{"--overwrite"}}) {
        SCOPED_TRACE(more.size());
        Words words{"bash",   "-c",       session, "bash", out_, OROGRAPH_PROGRAM, "bake", part_,
                    "--mesh", "clusters", "--out", out_,   "-q"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run_program(words);
        EXPECT_EQ(outcome.out, "tile.oro\n") << outcome.err;
        for (const std::string& line : outcome.err_lines())
            EXPECT_TRUE(oro::test::says(line, "written by another program") ||
                        oro::test::says(line, "taken away") || oro::test::says(line, "is there already") ||
                        oro::test::says(line, "appeared while"))
                << line;
        EXPECT_EQ(run_orograph({"info", out_, "--check"}).exit_code, 0);
        fs::remove(out_);
    }
}

}  // namespace

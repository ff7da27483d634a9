// Several grids of posts baked into one file: drawn as from their files, broken off and gone on with, and
// refused where something is wrong with it.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
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
using oro::test::Circumstances;
using oro::test::joined;
using oro::test::names_in;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;
using oro::test::write_bytes;

// A tile, and a part of it in UTM with closer posts, 100 m higher.
class GridsBake : public Bake {
  protected:
    void SetUp() override { make_input("10"); }
    void make_input(const std::string& spacing_m) {
        fs::create_directories(data_);
        const std::string warped = data_ / "warped.tif", fine = data_ / "fine.tif";
        ASSERT_EQ(run_program({"gdalwarp", "-q", "-overwrite", "-t_srs", "EPSG:32616", "-te", "742000",
                               "4046000", "747000", "4051000", "-tr", spacing_m, spacing_m, "-r", "cubic",
                               "-ot", "Float32", bundled(), warped})
                      .exit_code,
                  0);
        ASSERT_EQ(run_program({"gdal_translate", "-q", "-scale", "0", "1000", "100", "1100", warped, fine})
                      .exit_code,
                  0);
        input_ = {bundled(), fine};
    }
    void TearDown() override { fs::remove_all(data_); }
    Outcome bake(const Circumstances& circumstances = {}, const Words& more = {"-q"}) const {
        return run_orograph(joined(joined({"bake", "--out", out_}, input_), more), circumstances);
    }
    static std::string pixels_of(const fs::path& picture) {
        return json::parse(oro::test::view_in(picture))["fingerprints"]["pixels"].get<std::string>();
    }

    const fs::path data_ = folder.string() + "-data";
    const fs::path out_ = folder / "both.oro";
    Words input_;
};

TEST_F(GridsBake, IsDrawnAsTheFilesAre) {
    const json reported = object_said_by(joined(joined({"bake", "--out", out_}, input_), {"-q", "--json"}));
    EXPECT_EQ(reported["grids"], 2);
    EXPECT_EQ(names_in(folder), Words{"both.oro"});
    const Words eye{"--at",    "36.53,-84.35", "--above", "900",     "--heading", "70",
                    "--pitch", "-15",          "--size",  "160x120", "-q",        "--overwrite"};
    for (const char* pipeline : {"mesh", "compute"}) {
        const fs::path of_files = folder / "files.png", of_file = folder / "file.png";
        ASSERT_EQ(run_orograph(joined(joined(joined({"shot"}, input_), eye),
                                      {"--pipeline", pipeline, "--out", of_files}))
                      .exit_code,
                  0);
        ASSERT_EQ(
            run_orograph(joined(joined({"shot", out_}, eye), {"--pipeline", pipeline, "--out", of_file}))
                .exit_code,
            0);
        EXPECT_EQ(pixels_of(of_files), pixels_of(of_file)) << pipeline;
        // From its own view again, which names the baked file.
        const fs::path again = folder / "again.png";
        ASSERT_EQ(run_orograph({"shot", "--view", of_file, "-q", "--overwrite", "--out", again}).exit_code,
                  0);
        EXPECT_EQ(pixels_of(again), pixels_of(of_file));
    }
}

TEST_F(GridsBake, IsToldGridByGrid) {
    ASSERT_EQ(bake().exit_code, 0);
    const json files = object_said_by(joined(joined({"info"}, input_), {"--json"}));
    const json file = object_said_by({"info", out_, "--check", "--json"});
    EXPECT_EQ(file["checked"], true);
    ASSERT_EQ(file["apart"].size(), 1U);
    EXPECT_EQ(file["region"]["posts"], files["region"]["posts"]);
    EXPECT_EQ(file["apart"][0]["region"]["posts"], files["apart"][0]["region"]["posts"]);
    // Whichever has more posts is told first.
    EXPECT_NE(file["region"]["own_posts"], file["apart"][0]["region"]["own_posts"]);
    EXPECT_NE(run_orograph({"info", out_}).out.find("2 grids of posts"), std::string::npos);
    // In a box that one of them alone meets, that one.
    const json part = object_said_by({"info", out_, "--bbox", "-84.2,36.45,-84.15,36.5", "--json"});
    EXPECT_FALSE(part.contains("apart"));
}

TEST_F(GridsBake, IsTheSameTwiceAndAfterKills) {
    constexpr int kills = 12;
    make_input("5");  // takes long enough to be killed on its way
    const unsigned seed = std::random_device{}();
    std::mt19937 random(seed);
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(bake().exit_code, 0);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const std::string whole = bytes_of(out_);
    ASSERT_EQ(bake({}, {"-q", "--overwrite"}).exit_code, 0);
    EXPECT_TRUE(bytes_of(out_) == whole);
    int killed = 0, went_on = 0;
    for (int i = 0; i < kills; ++i) {
        fs::remove(out_);
        Circumstances broken_off;
        broken_off.signal = SIGKILL;
        broken_off.signal_after_s = took.count() * std::uniform_real_distribution<double>(0.4, 1.0)(random);
        const Outcome first = bake(broken_off);
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", killed after " << broken_off.signal_after_s);
        if (first.exit_code != 0) {
            ++killed;
            EXPECT_EQ(first.exit_code, 128 + SIGKILL);
            EXPECT_TRUE(!fs::exists(out_) || bytes_of(out_) == whole);
            const Outcome second = bake({}, {"-q", "--json", "--overwrite"});
            ASSERT_EQ(second.exit_code, 0) << second.err;
            went_on += json::parse(second.out)["pages"]["of_a_bake_broken_off"] > 0 ? 1 : 0;
        }
        EXPECT_TRUE(bytes_of(out_) == whole);
        EXPECT_EQ(names_in(folder), Words{"both.oro"});
    }
    std::printf("seed %u: %d of %d killed, %d had pages to go on from\n", seed, killed, kills, went_on);
    EXPECT_GE(killed, kills / 2);
    EXPECT_GE(went_on, 1);
}

// What has the name of a grid's file on its way, and is none.
TEST_F(GridsBake, SparesFilesOfOthers) {
    write_bytes(folder / "both.oro.grid-1", "somebody's");
    const Outcome outcome = bake();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("both.oro.grid-1: is there already, and no bake has left it behind"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(bytes_of(folder / "both.oro.grid-1"), "somebody's");
}

TEST_F(GridsBake, IsRefusedWhereOneGridIsAskedFor) {
    ASSERT_EQ(bake().exit_code, 0);
    // A picture of one grid is drawn again from one.
    const fs::path picture = folder / "one.png";
    ASSERT_EQ(run_orograph({"shot", bundled(), "--size", "64x48", "--out", picture}).exit_code, 0);
    const Outcome outcome =
        run_orograph({"shot", "--view", picture, out_, "--data-changed", "--out", folder / "again.png"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("holds 2 grids of posts, and this takes one"), std::string::npos)
        << outcome.err;
}

// As of a file of one grid (bake_test.cpp; all else about damage: tests/core/baked/baked_file_test.cpp).
TEST_F(GridsBake, DamageIsFound) {
    ASSERT_EQ(bake().exit_code, 0);
    const std::string whole = bytes_of(out_);
    const fs::path bad = folder / "bad.oro";
    for (const std::size_t at : {std::size_t{20}, std::size_t{300}, whole.size() / 2, whole.size() - 1}) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ 4);
        write_bytes(bad, bytes);
        oro::test::expect_refusal(run_orograph({"info", bad, "--check"}), 1, {bad, "byte"});
    }
    for (const std::string& bytes : {whole.substr(0, whole.size() / 2), whole + "x"}) {
        write_bytes(bad, bytes);
        oro::test::expect_refusal(run_orograph({"info", bad}), 1, {bad, "byte"});
    }
}

}  // namespace

// Fingerprints: a picture is tied to the data, the geoid grid and the program that it was drawn with, and to
// its own pixels. Whatever of them is another is told by its own line, and nothing is certified then.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/png_edit.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::view_in;
using oro::test::Words;
using oro::test::write_bytes;

// A tile of 1201 x 1201 posts: hills of up to 900 m, or flat.
std::string tile(bool flat, int more_m = 0) {
    std::string bytes;
    bytes.reserve(std::size_t{2} * 1201 * 1201);
    for (int r = 0; r < 1201; ++r) {
        for (int c = 0; c < 1201; ++c) {
            const int height = flat ? 500 : 200 + (r * 7 % 400) + (c * 5 % 300) + (r * c % 200) + more_m;
            bytes += static_cast<char>(height >> 8);
            bytes += static_cast<char>(height & 255);
        }
    }
    return bytes;
}

class FingerprintsOfViews : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path land = folder / "N46E008.hgt", picture = folder / "p.png", other = folder / "q.png";

    FingerprintsOfViews() { write_bytes(land, tile(false)); }
    Outcome shoot(const Words& more) const {
        Words words{"shot",   land.string(), "--at",  "46.5,8.5",       "--above",
                    "800",    "--heading",   "30",    "--pitch",        "-10",
                    "--size", "160x90",      "--out", picture.string(), "-q"};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    }
    void draw() const {
        const Outcome drawn = shoot({});
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    }
    [[nodiscard]] json fingerprints_in(const fs::path& png) const {
        return json::parse(view_in(png)).at("fingerprints");
    }
};

bool tells(const Outcome& outcome, const std::string& what) {
    return outcome.err.find(what) != std::string::npos;
}

// What commands do that show something new, and what those do that stand for the picture being the same.
void expect_reported(const fs::path& picture, const std::string& line, const Circumstances& now = {}) {
    const Outcome plan = run_orograph({"plan", "--view", picture}, now);
    EXPECT_EQ(plan.exit_code, 0) << plan.err;
    EXPECT_TRUE(tells(plan, line)) << plan.err;
}
void expect_refused(const fs::path& picture, const std::string& line, const Circumstances& now = {}) {
    const fs::path other = picture.parent_path() / "other.png";
    expect_refusal(run_orograph({"compare", picture}, now), 1, {line, "(--data-changed goes on)"});
    expect_refusal(run_orograph({"shot", "--view", picture}, now), 1, {line});
    expect_refusal(run_orograph({"shot", "--view", picture, "--out", other, "-q"}, now), 1, {line});
    EXPECT_FALSE(fs::exists(other));
    expect_reported(picture, line, now);
}

// Found: a source replaced by a flat one; compare said 0.002 px, shot --view wrote another picture.
TEST_F(FingerprintsOfViews, SwappedDataAreTold) {
    draw();
    write_bytes(land, tile(true));
    expect_refused(picture, "N46E008.hgt: its heights are others than those that " + picture.string());
    // A single post, by a metre.
    std::string one = tile(false);
    one[std::size_t{2} * (1201 * 600 + 700) + 1] ^= 1;
    write_bytes(land, one);
    expect_refused(picture, "N46E008.hgt: its heights are others");
}

TEST_F(FingerprintsOfViews, DataChangedGoesOnAndSaysSo) {
    draw();
    EXPECT_FALSE(fingerprints_in(picture).contains("data_changed"));
    write_bytes(land, tile(true));
    const Outcome drawn = run_orograph({"shot", "--view", picture, "--out", other, "--data-changed"});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_TRUE(tells(drawn, "note: N46E008.hgt: its heights are others")) << drawn.err;
    EXPECT_EQ(fingerprints_in(other).at("data_changed"), true);
    EXPECT_NE(fingerprints_in(other).at("posts"), fingerprints_in(picture).at("posts"));
    const Outcome of_new = run_orograph({"compare", other});
    EXPECT_EQ(of_new.exit_code, 0) << of_new.err;
    EXPECT_EQ(run_orograph({"shot", "--view", other, "-q"}).exit_code, 0) << "the same bytes again";
    const Outcome of_old = run_orograph({"compare", picture, "--data-changed", "--json"});
    EXPECT_EQ(of_old.exit_code, 0) << of_old.err;
    EXPECT_TRUE(tells(of_old, "note: N46E008.hgt: its heights are others")) << of_old.err;
    EXPECT_TRUE(tells(of_old, "note: " + picture.string() + ": its pixels are not what its view draws"))
        << of_old.err;
    EXPECT_EQ(json::parse(of_old.out).at("data_changed"), true);
}

TEST_F(FingerprintsOfViews, SourcesThatCameOrWentAreNamed) {
    draw();
    const fs::path east = folder / "N46E009.hgt";
    write_bytes(east, tile(false, 20));
    expect_refusal(run_orograph({"compare", picture, land, east, "-q"}), 1,
                   {"N46E009.hgt: is among the data, and", "was drawn without it"});
    const fs::path both = folder / "both.png";
    ASSERT_EQ(run_orograph({"shot", land, east, "--at", "46.5,8.5", "--size", "160x90", "--out", both, "-q"})
                  .exit_code,
              0);
    expect_refusal(run_orograph({"compare", both, land, "-q"}), 1,
                   {"N46E009.hgt: is not among the data, and", "was drawn from it, too"});
    // Two that changed: a line each.
    write_bytes(land, tile(true));
    write_bytes(east, tile(true));
    const Outcome outcome = run_orograph({"compare", both, "-q"});
    EXPECT_EQ(outcome.exit_code, 1);
    ASSERT_EQ(outcome.err_lines().size(), 2U) << outcome.err;
    EXPECT_EQ(outcome.err_lines()[0].rfind("orograph: N46E008.hgt: its heights are others", 0), 0U);
    EXPECT_EQ(outcome.err_lines()[1].rfind("orograph: N46E009.hgt: its heights are others", 0), 0U);
}

TEST_F(FingerprintsOfViews, TheSameDataUnderAnotherNameOrBakedAreTheSame) {
    draw();
    const fs::path renamed = folder / "N46E008.SRTMGL3.hgt", baked = folder / "r.oro";
    fs::copy_file(land, renamed);
    ASSERT_EQ(run_orograph({"bake", land, "--out", baked, "-q"}).exit_code, 0);
    for (const fs::path& data : {renamed, baked}) {
        const Outcome outcome = run_orograph({"compare", picture, data, "--json", "-q"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        EXPECT_EQ(json::parse(outcome.out).at("data_checked"), true);
    }
    // A baked region tells of its sources.
    write_bytes(land, tile(true));
    ASSERT_EQ(run_orograph({"bake", land, "--out", baked, "--overwrite", "-q"}).exit_code, 0);
    expect_refusal(run_orograph({"compare", picture, baked}), 1, {"N46E008.hgt: its heights are others"});
}

TEST_F(FingerprintsOfViews, AnotherGeoidGridIsTold) {
    const fs::path proj = "/usr/share/proj";
    if (!fs::exists(proj / "egm96_15.gtx")) GTEST_SKIP() << "needs " << proj / "egm96_15.gtx";
    draw();
    const fs::path grids = folder / "proj";
    fs::create_directory(grids);
    fs::create_symlink(proj / "proj.db", grids / "proj.db");
    // Big-endian floats behind 40 bytes: where the exponent is even, the next larger one doubles N.
    std::string grid = bytes_of(proj / "egm96_15.gtx");
    for (std::size_t at = 40; at + 3 < grid.size(); at += 4) grid[at + 2] ^= 1;
    write_bytes(grids / "egm96_15.gtx", grid);
    Circumstances now;
    now.environment = {"PROJ_DATA=" + grids.string()};
    expect_refused(picture, "geoid: the geoid grid is another than " + picture.string() + " was drawn with",
                   now);
    const Outcome went_on = run_orograph({"compare", picture, "--data-changed", "-q"}, now);
    EXPECT_EQ(went_on.exit_code, 0) << went_on.err;
}

TEST_F(FingerprintsOfViews, AnotherVersionIsANoteUnlessPixelsDiffer) {
    draw();
    const std::string program = fingerprints_in(picture).at("program");
    EXPECT_EQ(program.rfind("0.1.0 ", 0), 0U);
    write_bytes(other, oro::test::with_tags(bytes_of(picture), program, "0.0.9 0123456789ab"));
    const std::string line = "note: " + other.string() +
                             ": was drawn by version 0.0.9 0123456789ab of the program, and this is " +
                             program;
    const Outcome compared = run_orograph({"compare", other});
    EXPECT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_TRUE(tells(compared, line)) << compared.err;
    const Outcome again = run_orograph({"shot", "--view", other});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(tells(again, line)) << again.err;
    EXPECT_TRUE(tells(again, "draws the same pixels")) << again.err;
    expect_reported(other, line);
}

// Pixels that nobody changed, and that this version does not draw: here the tags say another light.
TEST_F(FingerprintsOfViews, AnotherVersionThatDrewOtherwiseIsNotCertified) {
    ASSERT_EQ(shoot({"--sun", "90,20"}).exit_code, 0);
    const std::string lit = oro::test::part_of(view_in(picture), "\"sun\":{", "}");
    const std::string program = fingerprints_in(picture).at("program");
    const std::string bytes = oro::test::with_tags(bytes_of(picture), lit, "\"sun\":null");
    write_bytes(other, oro::test::with_tags(bytes, program, "0.0.9 0123456789ab"));
    expect_refusal(run_orograph({"compare", other, "-q"}), 1,
                   {"q.png: its pixels are not what its view draws",
                    "nobody changed them since they were drawn, so version 0.0.9 0123456789ab of the program "
                    "drew otherwise"});
}

TEST_F(FingerprintsOfViews, EachOfTheFourHasALineOfItsOwn) {
    draw();
    auto pixels = oro::test::pixels_of(picture);
    for (std::size_t y = 30; y < 50; ++y) {
        for (std::size_t x = 100; x < 120; ++x) pixels.rgb[3 * (160 * y + x)] ^= 0x80;
    }
    write_bytes(other, oro::test::with_pixels(bytes_of(picture), pixels));
    expect_refusal(
        run_orograph({"compare", other, "-q"}), 1,
        {"q.png: its pixels are not what its view draws: 400 of 14,400 pixels (columns 100 to 119, "
         "rows 30 to 49) differ; they were changed after it was drawn"});
    const std::string line = "note: " + other.string() + ": its pixels were changed after it was drawn";
    expect_reported(other, line);
    const Outcome drawn = run_orograph({"shot", "--view", other, "--out", folder / "r.png"});
    EXPECT_EQ(drawn.exit_code, 0) << "drawn as it was: " << drawn.err;
    EXPECT_TRUE(tells(drawn, line)) << drawn.err;
    expect_refusal(run_orograph({"shot", "--view", other, "-q"}), 1,
                   {"is not what its view draws now: 400 of 14,400 pixels"});
}

// Views of before: they open as they did, and what cannot be checked is said.
TEST_F(FingerprintsOfViews, ViewsWithoutAnyOpenAsTheyDid) {
    draw();
    const std::string fingerprints = oro::test::part_of(view_in(picture), ",\"fingerprints\"", "\"}}");
    write_bytes(other, oro::test::with_tags(bytes_of(picture), fingerprints, "}"));
    EXPECT_FALSE(json::parse(view_in(other)).contains("fingerprints"));
    const std::string line =
        "note: " + other.string() +
        ": carries no fingerprints: whether its data are those that it was drawn from cannot be checked";
    const Outcome compared = run_orograph({"compare", other, "--json"});
    EXPECT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_TRUE(tells(compared, line)) << compared.err;
    EXPECT_EQ(json::parse(compared.out).at("data_checked"), false);
    const Outcome again = run_orograph({"shot", "--view", other});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(tells(again, "draws the same pixels")) << again.err;
    expect_reported(other, line);
    // Its pixels still tell that the data are others.
    write_bytes(land, tile(true));
    expect_refusal(run_orograph({"compare", other, "-q"}), 1, {"its pixels are not what its view draws"});
}

TEST_F(FingerprintsOfViews, NamesOfSourcesAreNotToldWithoutPaths) {
    const Outcome drawn = shoot({"--no-paths"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(bytes_of(picture).find("N46E008"), std::string::npos);
    EXPECT_EQ(run_orograph({"compare", picture, land, "-q"}).exit_code, 0);
    write_bytes(land, tile(true));
    expect_refusal(run_orograph({"compare", picture, land, "-q"}), 1,
                   {"p.png: was drawn from other heights than its data have now"});
}

TEST_F(FingerprintsOfViews, AViewThatHoldsNoFingerprintIsRefused) {
    draw();
    const json view = json::parse(view_in(picture));
    for (const char* name : {"grid", "posts", "style", "pixels"}) {
        for (const json& wrong : {json("12"), json("0123456789abcdeg"), json(5), json()}) {
            json changed = view;
            changed["fingerprints"][name] = wrong;
            write_bytes(folder / "v.json", changed.dump());
            expect_refusal(run_orograph({"plan", "--view", folder / "v.json"}), 1, {"v.json", name});
        }
    }
}

}  // namespace

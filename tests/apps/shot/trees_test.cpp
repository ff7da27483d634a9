// --trees: natural without its invented trees.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::Words;

// Low over a wooded slope: trees fill the picture.
class TreesOfShots : public testing::Test {
  protected:
    fs::path folder = oro::test::scratch_folder();
    std::string path(const std::string& name) const { return (folder / name).string(); }
    json shot(const std::string& out, const Words& more) const {
        return object_said_by(
            joined({"shot", bundled(), "--at", "36.52,-84.24", "--above", "12", "--heading", "220", "--size",
                    "96x64", "--time", "2026-01-02T03:04:05Z", "-q", "--json", "--out", path(out)},
                   more));
    }
};

TEST_F(TreesOfShots, OffDrawsWhatAStyleWithoutTreesDraws) {
    const json on = shot("on.png", {"--style", "natural"});
    EXPECT_EQ(on["growth"]["trees"], "invented, by a rule, where the ground cover is forest");
    EXPECT_FALSE(on["view"].contains("trees"));
    const json off = shot("off.png", {"--style", "natural", "--trees", "off"});
    EXPECT_EQ(off["growth"]["trees"], "left out (--trees off)");
    EXPECT_EQ(off["view"]["trees"], false);
    EXPECT_NE(pixels_of(path("on.png")).rgb, pixels_of(path("off.png")).rgb) << "trees were in view";
    json style = json::parse(bytes_of(oro::test::bundled_data() / "styles" / "natural.json"));
    style["growth"]["trees"] = false;
    oro::test::write_bytes(path("bare.json"), style.dump());
    shot("bare.png", {"--style", path("bare.json")});
    EXPECT_EQ(pixels_of(path("off.png")).rgb, pixels_of(path("bare.png")).rgb);
    // A picture is drawn again so, and changed back.
    ASSERT_EQ(run_orograph({"shot", "--view", path("off.png"), "-q", "--out", path("again.png")}).exit_code,
              0);
    EXPECT_EQ(bytes_of(path("again.png")), bytes_of(path("off.png")));
    ASSERT_EQ(
        run_orograph({"shot", "--view", path("off.png"), "--trees", "on", "-q", "--out", path("back.png")})
            .exit_code,
        0);
    EXPECT_EQ(pixels_of(path("back.png")).rgb, pixels_of(path("on.png")).rgb);
}

TEST_F(TreesOfShots, AreRefusedWhereNoneCanBe) {
    const auto refused = [&](const Words& more, const std::string& line) {
        expect_refusal(run_orograph(joined({"shot", bundled(), "-q", "--out", path("none.png")}, more)),
                       usage, {line});
    };
    refused({"--style", "plain", "--trees", "on"},
            "--trees on: the style 'plain' knows no ground that trees could stand on");
    refused({"--style", "natural", "--trees", "off", "--canopy", "trees.tif"},
            "--trees off: not together with --canopy");
    refused({"--trees", "perhaps"}, "--trees perhaps: choose on or off");
}

}  // namespace

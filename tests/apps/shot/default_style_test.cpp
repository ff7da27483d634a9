// What a user gets who says nothing of colours: the style `natural`. What a view tells is kept, whatever the
// default was when it was written.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::view_in;
using oro::test::Words;

class DefaultStyle : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const std::string land = (oro::test::bundled_data() / "jacksboro.tif").string();

    // Without a style unless `more` names one.
    Outcome shoot(const std::string& picture, const Words& more = {}) const {
        Words words{"shot",   "--size", "160x90", "--time",        "2026-01-01T00:00:00Z",
                    "--json", "-q",     "--out",  folder / picture};
        words.insert(words.end(), more.begin(), more.end());
        oro::test::Circumstances as_users;
        as_users.natural = true;
        return run_orograph(words, as_users);
    }
    [[nodiscard]] json view_of(const std::string& picture) const {
        return json::parse(view_in(folder / picture));
    }
};

TEST_F(DefaultStyle, IsNatural) {
    const Outcome nothing_said = shoot("a.png", {land}), said = shoot("b.png", {land, "--style", "natural"});
    ASSERT_EQ(nothing_said.exit_code, 0) << nothing_said.err;
    ASSERT_EQ(said.exit_code, 0) << said.err;
    EXPECT_EQ(view_of("a.png").at("style"), "natural");
    EXPECT_EQ(view_of("a.png"), view_of("b.png"));
    EXPECT_TRUE(oro::test::bytes_of(folder / "a.png") == oro::test::bytes_of(folder / "b.png"));
    EXPECT_EQ(json::parse(nothing_said.out).at("footprint"), "mean");
}

// Each view since the first has named its style: one of before natural was there keeps the colours that it
// had, and one that names none is refused, as ever. The style `haze` was called `default` then.
TEST_F(DefaultStyle, LeavesRecordedViewsAsTheyWere) {
    const Outcome drawn = shoot("a.png", {land, "--style", "default"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(json::parse(drawn.out).at("footprint"), "point");
    json old = view_of("a.png");
    const std::string pixels = old.at("fingerprints").at("pixels");
    EXPECT_EQ(old.at("style"), "haze");
    old["style"] = "default";
    for (const char* newer : {"sea", "rim", "pipeline", "paths_from", "fingerprints"}) old.erase(newer);
    old["sources"] = {land};
    oro::test::write_bytes(folder / "old.json", old.dump());
    const Outcome again = shoot("again.png", {"--view", folder / "old.json"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(view_of("again.png").at("fingerprints").at("pixels"), pixels);
    EXPECT_EQ(view_of("again.png").at("style"), "haze");
    old.erase("style");
    oro::test::write_bytes(folder / "none.json", old.dump());
    oro::test::expect_refusal(shoot("none.png", {"--view", folder / "none.json"}), 1, {"none.json", "style"});
}

// A view names a sea and a rim, of use to its style or not. An option that is of no use is refused.
TEST_F(DefaultStyle, OpensViewsWithASeaAndARimThatItDoesNotDraw) {
    const Outcome drawn = shoot("a.png", {land, "--style", "default"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    json view = view_of("a.png");
    const std::string pixels = view.at("fingerprints").at("pixels");
    view.erase("fingerprints");
    view["sources"] = {land};
    view["sea"] = "low";
    view["rim"] = "none";
    oro::test::write_bytes(folder / "view.json", view.dump());
    const Outcome again = shoot("again.png", {"--view", folder / "view.json"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(view_of("again.png").at("sea"), "low");
    EXPECT_EQ(view_of("again.png").at("rim"), "none");
    EXPECT_EQ(view_of("again.png").at("fingerprints").at("pixels"), pixels);
    oro::test::expect_refusal(shoot("low.png", {"--view", folder / "view.json", "--sea", "low"}), 2,
                              {"--sea low: is for styles with water; haze has none"});
    oro::test::expect_refusal(shoot("rim.png", {"--view", folder / "view.json", "--rim", "none"}), 2,
                              {"--rim none: is for styles with voids; haze has none"});
}

}  // namespace

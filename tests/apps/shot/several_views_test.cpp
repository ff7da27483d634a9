// Several views for one shot: a picture of each, the same as drawn alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::names_in;
using oro::test::run_orograph;
using oro::test::view_in;
using oro::test::Words;
using oro::test::write_bytes;

class SeveralViews : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path out = oro::test::scratch_folder();
    const Words names{"view-01.png", "view-02.png", "view-03.png"};

    // Three pictures: two of one region, the last without its geoid.
    void SetUp() override {
        const std::vector<Words> views{{"--heading", "10"}, {"--heading", "200"}, {"--geoid", "none"}};
        for (std::size_t i = 0; i < views.size(); ++i)
            ASSERT_EQ(run_orograph(joined({"shot", bundled(), "--out", folder / names[i], "--at",
                                           "36.6,-84.2", "--above", "300", "--size", "64x48", "--time",
                                           "2026-11-21T09:00:00Z", "-q"},
                                          views[i]))
                          .exit_code,
                      0);
    }
    void expect_pictures() const {
        EXPECT_EQ(names_in(out), names);
        for (const std::string& name : names)
            EXPECT_TRUE(bytes_of(out / name) == bytes_of(folder / name)) << name;
    }
};

TEST_F(SeveralViews, AreDrawnOneAfterTheOther) {
    const auto shot = run_orograph({"shot", "--view", folder / names[0], "--view", folder / names[1],
                                    "--view", folder / names[2], "--out", out / "view-%02d.png", "-q"});
    ASSERT_EQ(shot.exit_code, 0) << shot.err;
    expect_pictures();
}

// Found: each of them told the same of the data.
TEST_F(SeveralViews, TellNotesOnTheDataOnce) {
    const auto shot = run_orograph(
        {"shot", "--view", folder / names[0], "--view", folder / names[1], "--out", out / "view-%02d.png"});
    ASSERT_EQ(shot.exit_code, 0) << shot.err;
    std::vector<std::string> notes;
    for (const std::string& line : shot.err_lines())
        if (line.starts_with("orograph: note: ")) notes.push_back(line);
    EXPECT_EQ(
        std::ranges::count_if(
            notes, [](const std::string& note) { return note.find("reaches past the data") != note.npos; }),
        1)
        << shot.err;
    std::ranges::sort(notes);
    EXPECT_EQ(std::ranges::adjacent_find(notes), notes.end()) << shot.err;
}

// Paths of views start from the file that they are in: here from the list, which lies beside the pictures.
TEST_F(SeveralViews, MayBeAListInAFile) {
    json list = json::array();
    for (const std::string& name : names) list.push_back(json::parse(view_in(folder / name)));
    write_bytes(folder / "list.json", list.dump());
    const auto shot =
        run_orograph({"shot", "--view", folder / "list.json", "--out", out / "view-%02d.png", "-q"});
    ASSERT_EQ(shot.exit_code, 0) << shot.err;
    expect_pictures();
    list[1].erase("eye");
    write_bytes(folder / "list.json", list.dump());
    expect_refusal(run_orograph({"shot", "--view", folder / "list.json", "--out", out / "x%d.png"}),
                   oro::test::failed, {"list.json, view 2", "eye"});
    write_bytes(folder / "list.json", "[]");
    expect_refusal(run_orograph({"shot", "--view", folder / "list.json", "--out", out / "x%d.png"}),
                   oro::test::failed, {"list.json", "empty list"});
}

// The first picture would have the name of what the second is made from, which is not read by then.
TEST_F(SeveralViews, DoNotReplaceWhatALaterOneIsMadeFrom) {
    const fs::path data = out / "v1.tif";
    fs::copy_file(bundled(), data);
    ASSERT_EQ(run_orograph({"shot", data, "--out", out / "of-data.png", "--size", "64x48", "-q"}).exit_code,
              0);
    const std::string before = bytes_of(data);
    expect_refusal(run_orograph({"shot", "--view", folder / names[0], "--view", out / "of-data.png", "--out",
                                 out / "v%d.tif", "--overwrite"}),
                   oro::test::usage, {"v1.tif", "which the picture is made from"});
    EXPECT_TRUE(bytes_of(data) == before);
    EXPECT_EQ(names_in(out), (Words{"of-data.png", "v1.tif"}));
}

TEST_F(SeveralViews, NeedNumberedNames) {
    const Words two{"shot", "--view", folder / names[0], "--view", folder / names[1]};
    expect_refusal(run_orograph(joined(two, {"--out", out / "p.png"})), oro::test::usage,
                   {"--out", "is one picture, not the pictures of 2 views", "%04d"});
    expect_refusal(run_orograph(joined(two, {"--out", out / "p%s.png"})), oro::test::usage,
                   {"is no name for the pictures of 2 views"});
    expect_refusal(run_orograph(joined(two, {"--out", out / "p%d%d.png"})), oro::test::usage, {"--out"});
    expect_refusal(run_orograph(two), oro::test::usage, {"--out", "is missing", "view-%04d.png"});
    EXPECT_TRUE(names_in(out).empty());
    // Nothing is drawn where the second may not be.
    write_bytes(out / "p2.png", "mine");
    expect_refusal(run_orograph(joined(two, {"--out", out / "p%d.png"})), oro::test::failed,
                   {"p2.png", "is there already"});
    EXPECT_EQ(names_in(out), Words{"p2.png"});
    EXPECT_EQ(bytes_of(out / "p2.png"), "mine");
}

}  // namespace

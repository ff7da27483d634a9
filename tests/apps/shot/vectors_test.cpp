// --names and --overlay as users meet them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;
using oro::test::write_bytes;

std::string point(const std::string& name, double lon_deg, double lat_deg) {
    return R"({"type":"Feature","properties":{"name":")" + name +
           R"("},"geometry":{"type":"Point","coordinates":[)" + std::to_string(lon_deg) + "," +
           std::to_string(lat_deg) + "]}}";
}
std::string collection(const std::string& features) {
    return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}

// The bundled region, three points on it and one beyond, and a line across it.
class Vectors : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const std::string land = (folder / "land.tif").string(), points = (folder / "points.geojson").string(),
                      line = (folder / "line.geojson").string();

    Vectors() {
        fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", land);
        write_bytes(points, collection(point("Cumberland Mountain", -84.27, 36.60) + "," +
                                       point("Żółta Góra", -84.22, 36.62) + "," +
                                       point("جبل", -84.30, 36.55) + "," + point("Elsewhere", 8.0, 46.0)));
        write_bytes(
            line, collection(R"({"type":"Feature","properties":{"stroke":"#00ff00"},"geometry":)"
                             R"({"type":"LineString","coordinates":[[-84.35,36.56],[-84.15,36.57]]}},)"
                             R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon",)"
                             R"("coordinates":[[[-84.3,36.5],[-84.2,36.5],[-84.2,36.62],[-84.3,36.5]]]}})"));
    }
    [[nodiscard]] std::string path(const char* name) const { return (folder / name).string(); }
    static Outcome shoot(const Words& more) {
        Words words{"shot", "--size", "480x320", "--time", "2026-01-01T00:00:00Z"};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    }
};

TEST_F(Vectors, AreInTheViewWhichDrawsThemAgain) {
    const Outcome drawn = shoot({land, "--names", points, "--overlay", line, "--overlay-colour", "#ff0000",
                                 "--json", "--out", path("a.png")});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const json said = json::parse(drawn.out);
    EXPECT_EQ(said["names"]["beyond_data"], 1);
    EXPECT_EQ(said["names"]["without_letters"], 0);
    EXPECT_GT(said["overlay"]["seen_px"], 100.0);
    EXPECT_GE(said["names"]["named"].size(), 2U);
    const json view = json::parse(view_in(path("a.png")));
    EXPECT_EQ(view["names"], (json{{"files", {"points.geojson"}}}));
    EXPECT_EQ(view["overlay"],
              (json{{"files", {"line.geojson"}}, {"colour", "#ff0000"}, {"width_px", 2.0}, {"fill", 0.2}}));
    EXPECT_EQ(view["names_field"], "name");
    EXPECT_EQ(view["fingerprints"]["vectors"].size(), 2U);
    ASSERT_EQ(shoot({"--view", path("a.png"), "-q", "--out", path("b.png")}).exit_code, 0);
    EXPECT_EQ(bytes_of(path("a.png")), bytes_of(path("b.png")));
    EXPECT_EQ(run_orograph({"compare", path("a.png"), "-q"}).exit_code, 0);
}

// None of the names of a file may show: one line says why. Two stand 17 and 19 km north, behind ridges, one
// south of the eye within the data, one on another continent. Where one shows, or nobody asked for names,
// there is no line.
TEST_F(Vectors, OfWhichNoneShowsAreExplained) {
    write_bytes(points, collection(point("A", -84.20, 36.70) + "," + point("B", -84.21, 36.72) + "," +
                                   point("C", -84.20, 36.53) + "," + point("D", 8.0, 46.0)));
    const std::string why =
        "of the names none shows: 2 hidden behind the ground, 1 outside of the view, 1 beyond the data";
    const Words eye{land, "--at", "36.55,-84.2", "--above", "2"};
    const auto says_why = [&](const Words& command, const Words& more) {
        const Outcome drawn = run_orograph(oro::test::joined(oro::test::joined(command, eye), more));
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return oro::test::says(drawn.err, why);
    };
    const Words shot{"shot", "--size", "320x200", "--out", path("n.png"), "--overwrite"};
    EXPECT_TRUE(says_why(shot, {"--heading", "0", "--names", points}));
    EXPECT_TRUE(says_why({"panorama", "--width", "400", "--sector", "330,30", "--out", path("p.png")},
                         {"--names", points}));
    EXPECT_FALSE(says_why(shot, {"--heading", "0", "--overlay", points})) << "names were not asked for";
    write_bytes(points, collection(point("Near", -84.2, 36.5505) + "," + point("D", 8.0, 46.0)));
    const Outcome shown =
        run_orograph(oro::test::joined(oro::test::joined(shot, eye), {"--heading", "0", "--names", points}));
    EXPECT_FALSE(oro::test::says(shown.err, "none shows")) << shown.err;
}

TEST_F(Vectors, LeavePicturesWithoutThemAsTheyWere) {
    ASSERT_EQ(shoot({land, "-q", "--out", path("bare.png")}).exit_code, 0);
    const json view = json::parse(view_in(path("bare.png")));
    for (const char* field : {"names", "overlay", "names_field"}) EXPECT_FALSE(view.contains(field)) << field;
    EXPECT_FALSE(view["fingerprints"].contains("vectors"));
    ASSERT_EQ(shoot({land, "-q", "--names", points, "--out", path("named.png")}).exit_code, 0);
    EXPECT_NE(bytes_of(path("bare.png")), bytes_of(path("named.png")));
}

TEST_F(Vectors, ThatChangedAreTold) {
    ASSERT_EQ(shoot({land, "--names", points, "-q", "--out", path("a.png")}).exit_code, 0);
    write_bytes(points, collection(point("Another", -84.27, 36.60)));
    expect_refusal(shoot({"--view", path("a.png"), "--out", path("b.png")}), failed,
                   {"points.geojson", "another vector file"});
    EXPECT_EQ(shoot({"--view", path("a.png"), "--data-changed", "-q", "--out", path("b.png")}).exit_code, 0);
    EXPECT_EQ(shoot({"--view", path("a.png"), "--names", line, "-q", "--out", path("c.png")}).exit_code, 0);
}

TEST_F(Vectors, ThatCannotBeReadHaveOneLine) {
    expect_refusal(shoot({land, "--names", path("none.gpx"), "--out", path("a.png")}), failed, {"none.gpx"});
    write_bytes(path("empty.gpx"), "");
    expect_refusal(shoot({land, "--overlay", path("empty.gpx"), "--out", path("a.png")}), failed,
                   {"empty.gpx", "is empty"});
    write_bytes(path("broken.geojson"), collection(point("a", 8, 46)).substr(0, 60));
    expect_refusal(shoot({land, "--names", path("broken.geojson"), "--out", path("a.png")}), failed,
                   {"broken.geojson", "is no whole JSON: line 1: "});
    EXPECT_FALSE(fs::exists(path("a.png")));
}

TEST_F(Vectors, OptionsThatMeanNothingAreRefused) {
    expect_refusal(shoot({land, "--names-field", "n", "--out", path("a.png")}), usage,
                   {"--names-field", "--names"});
    expect_refusal(shoot({land, "--overlay-width", "3", "--out", path("a.png")}), usage,
                   {"--overlay-width", "--overlay"});
    expect_refusal(shoot({land, "--overlay", line, "--overlay-width", "99", "--out", path("a.png")}), usage,
                   {"--overlay-width 99", "between 0.5 and 50"});
    expect_refusal(shoot({land, "--overlay", line, "--overlay-colour", "red", "--out", path("a.png")}), usage,
                   {"--overlay-colour red", "#e2252b"});
    expect_refusal(shoot({land, "--names", path("a.png"), "--out", path("a.png")}), failed, {"a.png"});
    expect_refusal(shoot({land, "--names", points, "--overwrite", "--out", path("points.geojson")}), usage,
                   {"--out"});
}

TEST_F(Vectors, AFieldThatNoPointHasIsTold) {
    const Outcome drawn = shoot({land, "--names", points, "--names-field", "titel", "--out", path("a.png")});
    EXPECT_EQ(drawn.exit_code, 0);
    EXPECT_NE(drawn.err.find("has no point with something in the field 'titel'"), std::string::npos)
        << drawn.err;
}

// Notes of what was left out, and paths that a picture is not to tell.
TEST_F(Vectors, NotesAndPathsAreKeptTo) {
    write_bytes(path("odd.geojson"),
                collection(point("good", -84.27, 36.60) + "," + point("bad", -84.2, 95.0)));
    const Outcome drawn =
        shoot({land, "--names", path("odd.geojson"), "--no-paths", "--out", path("secret.png")});
    EXPECT_EQ(drawn.exit_code, 0);
    EXPECT_NE(drawn.err.find("left out 1 point with a latitude beyond 90 degrees"), std::string::npos)
        << drawn.err;
    const json view = json::parse(view_in(path("secret.png")));
    EXPECT_EQ(view["names"]["files"], json::array({"odd.geojson"}));
    EXPECT_FALSE(view["fingerprints"]["vectors"][0].contains("name"));
}

}  // namespace

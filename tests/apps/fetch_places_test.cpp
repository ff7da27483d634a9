// orograph fetch of named places, against a server on the loopback address that answers as an Overpass server
// does. Nothing here leaves the machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"
#include "tests/support/gzip.h"
#include "tests/support/loopback_server.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::http_answer;
using oro::test::joined;
using oro::test::LoopbackRequest;
using oro::test::LoopbackSend;
using oro::test::LoopbackServer;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::Words;
using oro::test::write_bytes;

// The form of an answer: https://wiki.openstreetmap.org/wiki/OSM_JSON. A peak without a number as its height,
// one without a name, a way, and a name in letters that are no ASCII.
constexpr const char* answer_of_peaks = R"({
  "version": 0.6, "generator": "Overpass API 0.7.62",
  "osm3s": {"timestamp_osm_base": "2026-11-20T08:00:00Z", "copyright": "ODbL"},
  "elements": [
    {"type": "node", "id": 12, "lat": 36.6, "lon": -84.25, "tags": {"natural": "peak", "name": "Low Top",
     "ele": "500 m"}},
    {"type": "node", "id": 9007199254740993, "lat": 36.62, "lon": -84.24, "tags": {"natural": "peak",
     "name": "H\u00f6chster", "ele": "1000.5", "prominence": "300", "note": "not kept"}},
    {"type": "node", "id": 14, "lat": 36.3, "lon": -84.3, "tags": {"natural": "volcano", "name": "Feet",
     "ele": "3000 ft"}},
    {"type": "node", "id": 15, "lat": 36.3, "lon": -84.3, "tags": {"natural": "peak", "ele": "1"}},
    {"type": "way", "id": 16, "tags": {"natural": "peak", "name": "A way"}}
  ]})";

std::string json_answer(const std::string& body) {
    return http_answer("200 OK", "Content-Type: application/json\r\n", body);
}

class FetchPlaces : public testing::Test {
  protected:
    [[nodiscard]] Words words(const LoopbackServer& server, const Words& more = {}) const {
        const nlohmann::json source{
            {"title", "A test"},
            {"url", server.address() + "/api/interpreter"},
            {"format", "overpass"},
            {"query", "[out:json];node[natural=peak]({south},{west},{north},{east});out;"},
            {"most_bytes", 100000},
            {"licence", "ODbL-1.0"},
            {"attribution", "(c) OpenStreetMap contributors"}};
        const fs::path file = folder_ / "table.json";
        write_bytes(file, nlohmann::json{{"sources", {{"peaks", source}}}}.dump());
        return joined({"fetch", "--source", "peaks", "--sources", file.string(), "--bbox",
                       "-84.5,36.25,-84,36.5", "--out", out_.string()},
                      more);
    }
    static Circumstances plain() {
        Circumstances circumstances;
        circumstances.environment = {"no_proxy=127.0.0.1", "XDG_CONFIG_HOME=/nonexistent"};
        return circumstances;
    }
    [[nodiscard]] Outcome run(const LoopbackServer& server, const Words& more = {}) const {
        return run_orograph(words(server, more), plain());
    }
    // One line, and nothing is left of an answer.
    void expect_refused_answer(const std::string& answer, const std::string& what) {
        const LoopbackServer server([&](const LoopbackRequest&, const LoopbackSend& send) { send(answer); });
        const Outcome outcome = run(server, {"--retries", "0"});
        expect_refusal(outcome, oro::test::failed, {"/api/interpreter: " + what});
        EXPECT_EQ(outcome.err.find("data="), std::string::npos) << outcome.err;
        EXPECT_EQ(names_in(folder_), Words{"table.json"});
    }

    fs::path folder_{oro::test::scratch_folder()};
    fs::path out_{folder_ / "peaks.geojson"};
};

TEST_F(FetchPlaces, WritesNamesThatPicturesShow) {
    const LoopbackServer server(
        [&](const LoopbackRequest&, const LoopbackSend& send) { send(json_answer(answer_of_peaks)); });
    const Outcome outcome = run(server);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.out, "Places: 3 with names, in ")) << outcome.out;
    EXPECT_TRUE(says(outcome.out, "To be named: (c) OpenStreetMap contributors")) << outcome.out;
    EXPECT_EQ(names_in(folder_), (Words{"peaks.geojson", "table.json"}));
    ASSERT_EQ(server.requests().size(), 1U);
    // [out:json];node[natural=peak](36.25,-84.5,36.5,-84);out; by Python's urllib.parse.quote(safe="").
    EXPECT_EQ(server.requests()[0].path,
              "/api/interpreter?data=%5Bout%3Ajson%5D%3Bnode%5Bnatural%3Dpeak%5D%2836.25%2C-84.5%2C36.5%2C-84"
              "%29%3Bout%3B");
    EXPECT_TRUE(server.requests()[0].headers.at("user-agent").starts_with("Orograph/"));
    const nlohmann::json file = nlohmann::json::parse(bytes_of(out_));
    EXPECT_EQ(file["licence"], "ODbL-1.0");
    EXPECT_EQ(file["attribution"], "(c) OpenStreetMap contributors");
    EXPECT_EQ(file["time"], "2026-11-20T08:00:00Z");
    ASSERT_EQ(file["features"].size(), 3U);
    const nlohmann::json& highest = file["features"][0];
    EXPECT_EQ(highest["id"], "node/9007199254740993");
    EXPECT_EQ(highest["geometry"]["coordinates"], (nlohmann::json{-84.24, 36.62}));
    EXPECT_EQ(highest["properties"],
              (nlohmann::json{
                  {"name", "H\u00f6chster"}, {"ele", 1000.5}, {"natural", "peak"}, {"prominence", "300"}}));
    EXPECT_EQ(file["features"][1]["properties"]["ele"], 500.0);
    EXPECT_FALSE(file["features"][2]["properties"].contains("ele"));
    // Held against GDAL's own reader.
    const Outcome gdal = oro::test::run_program({"ogrinfo", "-ro", "-al", "-geom=NO", out_.string()});
    EXPECT_TRUE(says(gdal.out, "Feature Count: 3")) << gdal.out << gdal.err;
    const Outcome picture =
        run_orograph({"shot", oro::test::bundled(), "--at", "36.55,-84.25", "--above", "2000", "--pitch",
                      "-20", "--heading", "0", "--size", "200x150", "--names", out_.string(), "--out",
                      (folder_ / "named.png").string(), "--json"},
                     plain());
    ASSERT_EQ(picture.exit_code, 0) << picture.err;
    const nlohmann::json named = nlohmann::json::parse(picture.out)["names"]["named"];
    ASSERT_EQ(named.size(), 2U);
    EXPECT_EQ(named[0]["name"], "H\u00f6chster");
    EXPECT_EQ(named[1]["name"], "Low Top");
}

// What is there is the user's.
TEST_F(FetchPlaces, LeavesAFileThatIsThere) {
    const LoopbackServer server(
        [&](const LoopbackRequest&, const LoopbackSend& send) { send(json_answer(answer_of_peaks)); });
    write_bytes(out_, "mine");
    expect_refusal(run(server), oro::test::failed, {"peaks.geojson: ", "--overwrite"});
    EXPECT_EQ(bytes_of(out_), "mine");
    EXPECT_TRUE(server.requests().empty());
    EXPECT_EQ(run(server, {"--overwrite"}).exit_code, 0);
    EXPECT_TRUE(says(bytes_of(out_), "Low Top"));
}

// A busy server is asked again, after what it asks for; one that stays busy is given up in one line.
TEST_F(FetchPlaces, AsksABusyServerAgain) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(request.number == 0 ? http_answer("429 Too Many Requests", "Retry-After: 1\r\n", "<html>")
                                 : json_answer(answer_of_peaks));
    });
    const Outcome outcome = run(server);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(server.requests().size(), 2U);
    EXPECT_EQ(names_in(folder_), (Words{"peaks.geojson", "table.json"}));
    fs::remove(out_);
    expect_refused_answer(http_answer("429 Too Many Requests", "", "<html>"),
                          "the server answers 429: too many requests");
    expect_refused_answer(http_answer("504 Gateway Timeout", "", ""), "the server answers 504");
}

TEST_F(FetchPlaces, RefusesWhatIsNoAnswer) {
    const std::string good = answer_of_peaks;
    expect_refused_answer(json_answer("<!DOCTYPE html><html>too busy</html>"),
                          "the answer is a page of the web or XML, and no JSON");
    expect_refused_answer(json_answer(good.substr(0, good.size() / 2)),
                          "the answer is cut, or is none of an Overpass server: is no JSON");
    expect_refused_answer(json_answer(""), "the answer is empty");
    expect_refused_answer(json_answer("{}"),
                          "the answer is cut, or is none of an Overpass server: 'elements'");
    expect_refused_answer(json_answer(R"({"elements": [], "remark": "runtime error: Query timed out"})"),
                          "the server did not finish: runtime error: Query timed out");
    expect_refused_answer(
        json_answer(
            R"({"elements": [{"type": "node", "id": 1, "lat": 91, "lon": 0, "tags": {"name": "?"}}]})"),
        "the answer is cut, or is none of an Overpass server: 'lat' is 91");
    expect_refused_answer(http_answer("200 OK", "", std::string(100001, ' ')),
                          "the file is larger than 100000 bytes");
    expect_refused_answer(http_answer("404 Not Found", "", ""), "the server has no such file");
    // Less than its Content-Length.
    std::string cut = json_answer(good);
    cut.resize(cut.size() - 100);
    expect_refused_answer(cut, "");
}

// 64 MiB of spaces in 64 KiB, said to be packed on the way: nobody asked for that, and nothing unpacks it.
TEST_F(FetchPlaces, UnpacksNoGzipBomb) {
    const std::string packed = oro::test::gzip_of(std::string(std::size_t{64} << 20U, ' '), 9);
    ASSERT_LT(packed.size(), 100000U);
    expect_refused_answer(http_answer("200 OK", "Content-Encoding: gzip\r\n", packed),
                          "the answer is packed (gzip), which was not asked for");
}

// Two requests over the antimeridian, an element in both once.
TEST_F(FetchPlaces, AsksOnBothSidesOfTheAntimeridian) {
    const LoopbackServer server(
        [&](const LoopbackRequest&, const LoopbackSend& send) { send(json_answer(answer_of_peaks)); });
    Words fetch = words(server);
    *std::ranges::find(fetch, "-84.5,36.25,-84,36.5") = "179,-17,-179,-16";
    const Outcome outcome = run_orograph(joined(fetch, {"--json"}), plain());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json said = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(said["places"], 3);
    EXPECT_EQ(said["left_out"], 4);
    ASSERT_EQ(server.requests().size(), 2U);
    EXPECT_TRUE(says(server.requests()[0].path, "%28-17%2C179%2C-16%2C180%29"));
    EXPECT_TRUE(says(server.requests()[1].path, "%28-17%2C-180%2C-16%2C-179%29"));
}

TEST_F(FetchPlaces, WhatIsWrongIsSaidInOneLine) {
    const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend&) {});
    Words fetch = words(server);
    const auto box = std::ranges::find(fetch, "-84.5,36.25,-84,36.5");
    *box = "5,40,16,50";
    expect_refusal(run_orograph(fetch, plain()), oro::test::usage,
                   {"5,40,16,50: with it the region has more than 100 square degrees: name a smaller box"});
    *box = "5,40,6,41";
    const Outcome dry = run_orograph(joined(fetch, {"--dry-run"}), plain());
    EXPECT_EQ(dry.exit_code, 0) << dry.err;
    EXPECT_TRUE(says(dry.out, "wanted   " + server.address() + "/api/interpreter?data=%5Bout")) << dry.out;
    EXPECT_TRUE(server.requests().empty());
    const fs::path table = folder_ / "table.json";
    write_bytes(table, R"({"sources": {"x": {"title": "?", "url": "http://x/", "format": "overpass",
        "query": "node({south},{west},{north});out;", "most_bytes": 1, "licence": "", "attribution": ""}}})");
    expect_refusal(run_orograph({"fetch", "--source", "x", "--sources", table.string()}, plain()),
                   oro::test::failed, {"'query' must have {south}, {west}, {north} and {east}"});
}

}  // namespace

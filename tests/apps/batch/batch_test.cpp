// A list of commands: the files of each are those of the command by itself, and a list that was stopped goes
// on.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
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
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::Words;
using oro::test::write_bytes;

class Batch : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path list = folder / "jobs.jsonl";

    [[nodiscard]] Outcome batch(const Words& more = {}, const Circumstances& how = {}) const {
        Circumstances there = how;
        there.folder = folder;
        return run_orograph(joined({"batch", list.string()}, more), there);
    }
    void write_list(const std::vector<json>& jobs) const {
        std::string text;
        for (const json& job : jobs) text += job.dump() + "\n";
        write_bytes(list, text);
    }
    // A small picture from a place.
    static json picture(double lat_deg, const std::string& out, const json& more = json::object()) {
        json job{{"command", "shot"}, {"path", bundled()},  {"at", {lat_deg, -84.2}},
                 {"size", {64, 48}},  {"style", "default"}, {"time", "2026-11-21T09:00:00Z"},
                 {"above", 300},      {"out", out}};
        job.update(more);
        return job;
    }
    // What the command by itself writes.
    [[nodiscard]] std::string alone(double lat_deg, const Words& more = {}) const {
        const fs::path out = folder / "alone.png";
        fs::remove(out);
        const Outcome shot = run_orograph(joined(
            {"shot", bundled(), "--at", json(lat_deg).dump() + ",-84.2", "--size", "64x48", "--style",
             "default", "--time", "2026-11-21T09:00:00Z", "--above", "300", "--out", out.string(), "-q"},
            more));
        EXPECT_EQ(shot.exit_code, 0) << shot.err;
        const std::string bytes = bytes_of(out);
        fs::remove(out);
        return bytes;
    }
    [[nodiscard]] std::string file(const std::string& name) const { return bytes_of(folder / name); }
};

// Different eyes, looks and details; a scene that is kept draws what a new one does.
TEST_F(Batch, FilesAreThoseOfTheCommandsAlone) {
    write_list({picture(36.55, "a.png"),
                picture(36.6, "b.png"),
                picture(36.6, "tau.png", {{"tau", 4}}),
                picture(36.58, "shown.png", {{"show", "levels"}}),
                picture(36.52, "c.png", {{"exaggeration", 2}}),
                picture(36.52, "d.png", {{"geoid", "none"}}),
                picture(36.55, "e.jpg", {{"shadows", "off"}}),
                {{"command", "viewshed"},
                 {"path", bundled()},
                 {"at", {36.55, -84.2}},
                 {"radius", 2},
                 {"out", "shed.tif"}},
                {{"command", "sight"},
                 {"path", bundled()},
                 {"from", "36.55,-84.2"},
                 {"to", "36.56,-84.21"},
                 {"json", true},
                 {"print", "sight.json"}}});
    const Outcome outcome = batch({"--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json said = json::parse(outcome.out);
    EXPECT_EQ(said["lines"]["done"], 9);
    EXPECT_EQ(said["lines"]["failed"], 0);
    EXPECT_EQ(said["regions_opened"], 1);
    EXPECT_TRUE(file("a.png") == alone(36.55));
    EXPECT_TRUE(file("b.png") == alone(36.6));
    EXPECT_TRUE(file("tau.png") == alone(36.6, {"--tau", "4"}));
    EXPECT_TRUE(file("shown.png") == alone(36.58, {"--show", "levels"}));
    EXPECT_TRUE(file("c.png") == alone(36.52, {"--exaggeration", "2"}));
    EXPECT_TRUE(file("d.png") == alone(36.52, {"--geoid", "none"}));
    const fs::path shed = folder / "alone.tif";
    const Outcome viewshed = run_orograph(
        {"viewshed", bundled(), "--at", "36.55,-84.2", "--radius", "2", "--out", shed.string(), "-q"});
    ASSERT_EQ(viewshed.exit_code, 0) << viewshed.err;
    EXPECT_TRUE(file("shed.tif") == bytes_of(shed));
    const Outcome sight =
        run_orograph({"sight", bundled(), "--from", "36.55,-84.2", "--to", "36.56,-84.21", "--json", "-q"});
    EXPECT_EQ(file("sight.json"), sight.out);
}

TEST_F(Batch, AFailedLineIsTheOnlyOneThatIsNotDone) {
    write_list({picture(36.55, "a.png"), picture(3.0, "nothing.png"),
                picture(36.6, "b.png", {{"hieghts", "f32"}}), picture(36.6, "c.png")});
    write_bytes(list, bytes_of(list) + "{\"command\": \"batch\", \"jobs\": \"jobs.jsonl\"}\nnonsense\n");
    const Outcome outcome = batch({"-q"});
    EXPECT_EQ(outcome.exit_code, 1);
    ASSERT_EQ(outcome.err_lines().size(), 5U) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "jobs.jsonl, line 2: ")) << outcome.err;
    EXPECT_TRUE(
        says(outcome.err, "jobs.jsonl, line 3: --hieghts: shot has no such option: did you mean --heights?"))
        << outcome.err;
    EXPECT_TRUE(says(outcome.err, "line 5: \"batch\" is no command that a line can give")) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "jobs.jsonl, line 6: ")) << outcome.err;
    EXPECT_TRUE(says(outcome.err_lines().back(), "4 of 6 lines failed")) << outcome.err;
    EXPECT_EQ(names_in(folder), (Words{"a.png", "c.png", "jobs.jsonl", "jobs.jsonl.done"}));
}

// Whole files of the same job stay; all others are done again where that is allowed.
TEST_F(Batch, WhatIsDoneIsNotDoneAgain) {
    write_list({picture(36.55, "a.png"), picture(36.6, "b.png"), picture(36.58, "c.png")});
    ASSERT_EQ(batch({"-q"}).exit_code, 0);
    const std::string a = file("a.png"), b = file("b.png"), c = file("c.png");
    const auto states = [&](const Outcome& outcome) {
        std::string all;
        const json said = json::parse(outcome.out);
        for (const json& line : said["each"]) all += line["state"].get<std::string>() + " ";
        return all;
    };
    EXPECT_EQ(states(batch({"--json"})), "kept kept kept ");
    // One is gone, one is damaged.
    fs::remove(folder / "a.png");
    std::string damaged = b;
    damaged[damaged.size() / 2] ^= 1;
    write_bytes(folder / "b.png", damaged);
    const Outcome again = batch({"--json"});
    EXPECT_EQ(again.exit_code, 1);
    EXPECT_EQ(states(again), "done failed kept ");
    EXPECT_TRUE(says(again.err, "line 2: b.png: is there already")) << again.err;
    EXPECT_EQ(states(batch({"--json", "--overwrite"})), "kept done kept ");
    EXPECT_TRUE(file("a.png") == a && file("b.png") == b && file("c.png") == c);
    // Another job of the same name is another file.
    write_list({picture(36.55, "a.png"), picture(36.6, "b.png", {{"tau", 2}}), picture(36.58, "c.png")});
    EXPECT_EQ(states(batch({"--json"})), "kept failed kept ");
    EXPECT_EQ(states(batch({"--json", "--overwrite"})), "kept done kept ");
    EXPECT_TRUE(file("b.png") == alone(36.6, {"--tau", "2"}));
}

// Data that are others now are told from what was drawn.
TEST_F(Batch, ChangedDataAreDrawnAgain) {
    fs::copy_file(bundled(), folder / "data.tif");
    json job = picture(36.55, "a.png");
    job["path"] = "data.tif";
    write_list({job});
    ASSERT_EQ(batch({"-q"}).exit_code, 0);
    fs::last_write_time(folder / "data.tif",
                        fs::last_write_time(folder / "data.tif") - std::chrono::hours(1));
    const Outcome again = batch({"-q"});
    EXPECT_EQ(again.exit_code, 1);
    EXPECT_TRUE(says(again.err, "a.png: is there already")) << again.err;
    EXPECT_EQ(batch({"-q", "--overwrite"}).exit_code, 0);
    EXPECT_EQ(batch({"-q"}).exit_code, 0);
}

TEST_F(Batch, PartsMakeTheWhole) {
    std::vector<json> jobs;
    for (int i = 0; i < 7; ++i) jobs.push_back(picture(36.52 + 0.01 * i, "p" + std::to_string(i) + ".png"));
    write_list(jobs);
    ASSERT_EQ(batch({"-q"}).exit_code, 0);
    std::vector<std::string> whole;
    for (int i = 0; i < 7; ++i) {
        whole.push_back(file("p" + std::to_string(i) + ".png"));
        fs::remove(folder / ("p" + std::to_string(i) + ".png"));
    }
    fs::remove(folder / "jobs.jsonl.done");
    for (const char* const part : {"1/3", "2/3", "3/3"}) {
        const Outcome outcome = batch({"--json", "--shard", part});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(json::parse(outcome.out)["lines"]["done"], part[0] == '1' ? 3 : 2);
    }
    for (int i = 0; i < 7; ++i) EXPECT_TRUE(file("p" + std::to_string(i) + ".png") == whole[i]) << i;
    // Another number of parts knows what is done.
    const Outcome all = batch({"--json"});
    EXPECT_EQ(json::parse(all.out)["lines"]["kept"], 7);
    EXPECT_EQ(json::parse(batch({"--json", "--shard", "2/2"}).out)["lines"]["kept"], 3);
}

TEST_F(Batch, AListThatWasKilledGoesOn) {
    std::vector<json> jobs;
    for (int i = 0; i < 6; ++i) jobs.push_back(picture(36.52 + 0.01 * i, "p" + std::to_string(i) + ".png"));
    write_list(jobs);
    Circumstances killed;
    killed.signal = SIGKILL;
    for (const double after_s : {0.6, 0.9, 1.2}) {
        killed.signal_after_s = after_s;
        (void)batch({"-q"}, killed);
    }
    // Half a line of the record is none.
    write_bytes(folder / "jobs.jsonl.done", bytes_of(folder / "jobs.jsonl.done") + "{\"job\": \"0123");
    const Outcome rest = batch({"--json", "--overwrite"});
    ASSERT_EQ(rest.exit_code, 0) << rest.err;
    for (int i = 0; i < 6; ++i)
        EXPECT_TRUE(file("p" + std::to_string(i) + ".png") == alone(36.52 + 0.01 * i)) << i;
    EXPECT_EQ(json::parse(batch({"--json"}).out)["lines"]["kept"], 6);
}

TEST_F(Batch, LinesThatGetInEachOthersWay) {
    fs::copy_file(bundled(), folder / "data.tif");
    const std::string data = file("data.tif");
    json reads = picture(36.55, "a.png");
    reads["path"] = "data.tif";
    write_list({reads,
                picture(36.6, "a.png", {{"overwrite", true}}),
                {{"command", "export"},
                 {"path", bundled()},
                 {"to", "cog"},
                 {"out", "data.tif"},
                 {"overwrite", true}},
                picture(36.6, "jobs.jsonl", {{"overwrite", true}}),
                {{"command", "info"}, {"path", bundled()}, {"print", "a.png"}}});
    const Outcome outcome = batch({"-q", "--overwrite"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(says(outcome.err, "line 2: --out a.png: is what line 1 writes")) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "line 3: --out data.tif: is what line 1 reads")) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "line 4: --out jobs.jsonl: would replace the list of jobs")) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "line 5: print a.png: is what line 1 writes")) << outcome.err;
    EXPECT_TRUE(file("data.tif") == data);
}

// Files beside pictures, which no line names.
TEST_F(Batch, FilesThatAnotherLineWroteBesideItsOwnStay) {
    write_list({picture(36.55, "a.png", {{"geopose", true}}),
                picture(36.6, "a.geopose.json.png"),
                {{"command", "profile"},
                 {"path", bundled()},
                 {"along", "36.55,-84.2; 36.56,-84.2"},
                 {"out", "a.geopose.json"}},
                {{"command", "sight"},
                 {"path", bundled()},
                 {"from", "36.55,-84.2"},
                 {"to", "36.56,-84.21"},
                 {"print", "a.geopose.json"}}});
    const Outcome outcome = batch({"-q", "--overwrite"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(says(outcome.err, "line 4: ")) << outcome.err;
    EXPECT_TRUE(says(file("a.geopose.json"), "quaternion")) << outcome.err;
}

// A line for each station of a table, and for each waypoint of a GPX file.
TEST_F(Batch, LinesAreDoneForEachPlace) {
    write_list({picture(36.5, "{name}.png", {{"at", "{lat},-84.2"}})});
    write_bytes(folder / "stations.csv", "name;lat;note\n\"a;b\";36.55;\"says \"\"hello\"\"\"\nsub/c;36.6\n");
    const Outcome table = batch({"--json", "--each", "stations.csv"});
    ASSERT_EQ(table.exit_code, 0) << table.err;
    EXPECT_EQ(json::parse(table.out)["each"][1]["place"], "place 2 (sub/c)");
    EXPECT_TRUE(file("a;b.png") == alone(36.55));
    EXPECT_TRUE(file("sub_c.png") == alone(36.6));
    write_bytes(folder / "other.csv", "Name,Latitude\nd,36.55\n");
    const Outcome other = batch({"--json", "--each", "other.csv"});
    ASSERT_EQ(other.exit_code, 0) << other.err;
    EXPECT_EQ(json::parse(other.out)["each"][0]["place"], "place 1 (d)");
    EXPECT_TRUE(file("d.png") == alone(36.55));
    write_bytes(folder / "points.gpx",
                R"(<gpx version="1.1" creator="test" xmlns="http://www.topografix.com/GPX/1/1">
                   <wpt lat="36.55" lon="-84.2"><ele>700</ele><name>one</name></wpt>
                   <wpt lat="36.6" lon="-84.2"><name>two</name></wpt></gpx>)");
    const Outcome points = batch({"-q", "--each", "points.gpx", "--shard", "2/2"});
    ASSERT_EQ(points.exit_code, 0) << points.err;
    EXPECT_FALSE(fs::exists(folder / "one.png"));
    EXPECT_TRUE(file("two.png") == alone(36.6));
    // The name of one place twice is the name of one file twice.
    write_bytes(folder / "twice.csv", "name,lat\nx,36.55\nx,36.6\n");
    const Outcome twice = batch({"-q", "--each", "twice.csv"});
    EXPECT_EQ(twice.exit_code, 1);
    EXPECT_TRUE(says(twice.err, "jobs.jsonl, line 1, place 2 (x): --out x.png: is what line 1 writes"))
        << twice.err;
}

TEST_F(Batch, PlacesThatAreNone) {
    write_list({picture(36.5, "{name}.png", {{"at", "{lat},{long}"}})});
    const auto refused = [&](const std::string& name, const std::string& text, const std::string& words) {
        write_bytes(folder / name, text);
        const Outcome outcome = batch({"--each", name});
        EXPECT_EQ(outcome.exit_code, 1) << name;
        EXPECT_TRUE(says(outcome.err, words)) << outcome.err << "\nlacks " << words;
    };
    refused("empty.csv", "", "has no places");
    refused("names.csv", "name,lat\n", "has no places");
    refused("wide.csv", "name,lat\nx,1,2\n", "wide.csv: line 2 has 3 fields, and the first line names 2");
    refused("bytes.csv", std::string("name\n\0", 6), "is no text");
    refused("fields.csv", "name,lat\nx,1\n",
            "line 1 there is no field {long}; these are lat, name and number");
    refused("line.geojson", R"({"type": "LineString", "coordinates": [[8, 46], [8.1, 46]]})",
            "has no points");
    refused("none.gpx", "nonsense", "none.gpx");
    EXPECT_FALSE(fs::exists(folder / "x.png"));
}

TEST_F(Batch, ArgsTakeNoSecondCommand) {
    write_list({picture(36.55, "a.png"),
                {{"command", "info"}, {"args", {bundled(), "batch", "jobs.jsonl"}}},
                {{"command", "info"}, {"path", bundled()}, {"help", true}}});
    const Outcome outcome = batch({"-q"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(says(outcome.err, "line 2: ")) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "line 3: --help: is nothing for a list of jobs")) << outcome.err;
}

TEST_F(Batch, CheckLooksAndDoesNothing) {
    write_list({picture(36.55, "a.png"), picture(36.6, "b.png", {{"samples", 3.5}})});
    const Outcome outcome = batch({"--check"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.out, "2 lines: 1 to do, 0 done already, 1 that cannot be done\n");
    EXPECT_EQ(names_in(folder), (Words{"jobs.jsonl"}));
}

// What commands print comes in the order of the list.
TEST_F(Batch, PrintsWhatTheCommandsPrint) {
    const json sight{
        {"command", "sight"}, {"path", bundled()}, {"from", "36.55,-84.2"}, {"to", "36.56,-84.21"}};
    const Outcome alone =
        run_orograph({"sight", bundled(), "--from", "36.55,-84.2", "--to", "36.56,-84.21", "-q"});
    write_list({sight, sight});
    EXPECT_EQ(batch({"-q"}).out, alone.out + alone.out);
}

TEST_F(Batch, WhatIsNoListIsRefused) {
    expect_refusal(run_orograph({"batch", (folder / "none.jsonl").string()}), 1, {"none.jsonl"});
    write_bytes(list, "");
    expect_refusal(batch(), 1, {"jobs.jsonl: has no jobs"});
    write_bytes(list, std::string("\x7F"
                                  "ELF\0\0\0",
                                  7));
    expect_refusal(batch(), 1, {"is no list of jobs: it is no text"});
    write_bytes(list, std::string(3'000'000, '['));
    expect_refusal(batch(), 1, {"has no job that can be understood: line 1"});
    write_list({picture(36.55, "a.png")});
    expect_refusal(batch({"--shard", "3/2"}), 2, {"--shard 3/2: must be NUMBER/COUNT"});
    expect_refusal(batch({"--log", (folder / "nowhere" / "log").string()}), 1, {"cannot be written"});
    EXPECT_EQ(names_in(folder), (Words{"jobs.jsonl"}));
}

}  // namespace

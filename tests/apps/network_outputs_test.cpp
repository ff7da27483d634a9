// Files that commands write to a network: objects of a store on the loopback address. Nothing here leaves the
// machine.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/apps/program.h"
#include "tests/support/object_store.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::http_answer;
using oro::test::joined;
using oro::test::LoopbackRequest;
using oro::test::names_in;
using oro::test::ObjectStore;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::s3_fault;
using oro::test::says;
using oro::test::Words;
using oro::test::write_bytes;

// No file of keys of whoever runs the tests, and a folder for temporary files that is seen to be empty.
class NetworkOutputs : public testing::Test {
  protected:
    NetworkOutputs() {
        fs::create_directories(folder_ / "tmp");
        fs::create_directories(folder_ / "work");
    }
    [[nodiscard]] Outcome run(const Words& words, const Words& environment = {}) const {
        Circumstances circumstances;
        circumstances.environment =
            joined(joined(store_.environment(),
                          {"HOME=" + folder_.string(), "TMPDIR=" + (folder_ / "tmp").string()}),
                   environment);
        circumstances.folder = folder_ / "work";
        const Outcome outcome = run_orograph(words, circumstances);
        for (const std::string& text : {outcome.out, outcome.err}) {
            EXPECT_FALSE(says(text, ObjectStore::key)) << text;
            EXPECT_FALSE(says(text, ObjectStore::key_id)) << text;
        }
        EXPECT_TRUE(names_in(folder_ / "tmp").empty());
        return outcome;
    }
    // The keys are in the headers that sign requests, and nowhere else.
    void expect_no_keys() const {
        for (const auto& [name, bytes] : store_.objects())
            EXPECT_FALSE(says(bytes, ObjectStore::key_id)) << name;
        for (const LoopbackRequest& request : store_.requests()) {
            EXPECT_FALSE(says(request.path + request.body, ObjectStore::key)) << request.path;
            for (const auto& [name, value] : request.headers)
                EXPECT_FALSE(says(value, ObjectStore::key)) << name;
        }
    }
    [[nodiscard]] std::string file(const std::string& name) const {
        return (folder_ / "work" / name).string();
    }

    fs::path folder_{oro::test::scratch_folder()};
    ObjectStore store_;
};

Words viewshed_to(const std::string& out) {
    return {"viewshed", oro::test::bundled(), "--at", "36.55,-84.25", "--radius", "3", "--out", out};
}

// A map, which has a world file beside it.
Words map_to(const std::string& out) {
    return {"shot",   "--ortho", "--bbox", "-84.26,36.54,-84.24,36.56",
            "--size", "160x160", "--time", "2026-06-21T12:00Z",
            "--out",  out};
}

TEST_F(NetworkOutputs, HaveTheBytesOfFilesOfThisMachine) {
    const Outcome near = run(viewshed_to("shed.tif"));
    ASSERT_EQ(near.exit_code, 0) << near.err;
    const Outcome far = run(joined(viewshed_to("/vsis3/bucket/out/shed.tif"), {"--network"}));
    ASSERT_EQ(far.exit_code, 0) << far.err;
    EXPECT_EQ(store_.objects().at("bucket/out/shed.tif"), bytes_of(file("shed.tif")));
    // In one request, after the server was asked whether the name is free.
    EXPECT_EQ(store_.count("PUT"), 1);
    EXPECT_EQ(store_.count("POST"), 0);
    const Words horizon{
        "horizon", oro::test::bundled(), "--bbox", "-84.26,36.54,-84.25,36.55", "--directions", "8", "--out"};
    ASSERT_EQ(run(joined(horizon, {"sky.tif"})).exit_code, 0);
    const Outcome sky = run(joined(horizon, {"/vsis3/bucket/sky.tif", "--network", "--json"}));
    ASSERT_EQ(sky.exit_code, 0) << sky.err;
    EXPECT_EQ(nlohmann::json::parse(sky.out)["sky_view"], "/vsis3/bucket/sky.sky-view.tif");
    for (const char* const name : {"sky.horizon.tif", "sky.sky-view.tif"})
        EXPECT_EQ(store_.objects().at(std::string("bucket/") + name), bytes_of(file(name))) << name;
    expect_no_keys();
}

TEST_F(NetworkOutputs, AreOptIn) {
    expect_refusal(run(viewshed_to("/vsis3/bucket/shed.tif")), oro::test::usage,
                   {"/vsis3/bucket/shed.tif: lies on a network; --network lets it be reached"});
    EXPECT_TRUE(store_.requests().empty());
    for (const auto& [out, why] : std::map<std::string, std::string>{
             {"/vsicurl/http://127.0.0.1:9/shed.tif", "GDAL only reads such files"},
             {"/vsis3_streaming/bucket/shed.tif", "GDAL only reads such files"},
             {"/vsis3/shed.tif", "names no file in a bucket"}})
        expect_refusal(run(joined(viewshed_to(out), {"--network"})), oro::test::usage, {out, why});
    // What is made of many files, and goes on in its folder.
    expect_refusal(
        run({"export", oro::test::bundled(), "--to", "3dtiles", "--out", "/vsis3/bucket/tiles", "--network"}),
        oro::test::usage, {"/vsis3/bucket/tiles: lies on a network; this is written on this machine alone"});
    EXPECT_TRUE(store_.requests().empty());
}

// A picture and what belongs to it, and the same from a file on the network as from one of this machine.
TEST_F(NetworkOutputs, PicturesTakeTheirCompanionsAlong) {
    store_.put("bucket/jacksboro.tif", bytes_of(oro::test::bundled()));
    const Outcome far =
        run(joined(map_to("/vsis3/bucket/map.png"), {"/vsis3/bucket/jacksboro.tif", "--network", "--json"}));
    ASSERT_EQ(far.exit_code, 0) << far.err;
    const auto objects = store_.objects();
    EXPECT_EQ(objects.size(), 3U);
    EXPECT_TRUE(objects.contains("bucket/map.png"));
    EXPECT_TRUE(objects.contains("bucket/map.pgw"));
    EXPECT_EQ(nlohmann::json::parse(far.out)["picture"], "/vsis3/bucket/map.png");
    expect_no_keys();
}

// More than one part of a file: GDAL's own option makes the parts small.
TEST_F(NetworkOutputs, LargeFilesGoInParts) {
    const Words words = joined(viewshed_to("/vsis3/bucket/shed.tif"), {"--network"});
    ASSERT_EQ(run(viewshed_to("shed.tif")).exit_code, 0);
    const std::string bytes = bytes_of(file("shed.tif"));
    const std::size_t part = bytes.size() / 3;
    const Outcome outcome = run(words, {"VSIS3_CHUNK_SIZE_BYTES=" + std::to_string(part)});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(store_.objects().at("bucket/shed.tif"), bytes);
    EXPECT_EQ(store_.count("POST", "?uploads"), 1);
    EXPECT_GE(store_.count("PUT", "partNumber="), 3);
    EXPECT_EQ(store_.open_uploads(), 0U);
}

// The third part is refused: nothing of the file is there, and what was begun is given up.
TEST_F(NetworkOutputs, AreAbsentWhereAPartIsRefused) {
    store_.fail([](const LoopbackRequest& request) -> std::optional<std::string> {
        if (!says(request.path, "partNumber=3")) return std::nullopt;
        return s3_fault("403 Forbidden", "AccessDenied", "no more for ORO0TEST0KEY0ID00000");
    });
    const Outcome outcome =
        run(joined(viewshed_to("/vsis3/bucket/shed.tif"), {"--network"}), {"VSIS3_CHUNK_SIZE_BYTES=500"});
    expect_refusal(outcome, oro::test::failed, {"/vsis3/bucket/shed.tif: cannot be written: "});
    EXPECT_TRUE(store_.objects().empty());
    EXPECT_EQ(store_.open_uploads(), 0U);
}

// A server that is busy is asked again; one that stays so, or refuses, is told in one line.
TEST_F(NetworkOutputs, ServersMayBeBusyOrRefuse) {
    struct Case {
        const char* status;
        const char* code;
        int times;
        int exit_code;
    };
    for (const Case& one :
         {Case{"503 Slow Down", "SlowDown", 2, 0}, Case{"429 Too Many Requests", "SlowDown", 2, 0},
          Case{"503 Slow Down", "SlowDown", 1000, 1},
          Case{"500 Internal Server Error", "InternalError", 1000, 1},
          Case{"403 Forbidden", "AccessDenied", 1000, 1}}) {
        ObjectStore store;
        store.fail(
            [&, left = one.times](const LoopbackRequest& request) mutable -> std::optional<std::string> {
                if (request.method != "PUT" || left-- <= 0) return std::nullopt;
                return s3_fault(one.status, one.code, "not now");
            });
        Circumstances circumstances;
        circumstances.environment = joined(store.environment(), {"HOME=" + folder_.string()});
        const Outcome outcome =
            run_orograph(joined(viewshed_to("/vsis3/bucket/shed.tif"), {"--network", "-q"}), circumstances);
        EXPECT_EQ(outcome.exit_code, one.exit_code) << one.status << ": " << outcome.err;
        EXPECT_EQ(store.objects().size(), one.exit_code == 0 ? 1U : 0U) << one.status;
        if (one.exit_code != 0)
            expect_refusal(outcome, oro::test::failed, {"/vsis3/bucket/shed.tif: cannot be written: "});
        if (one.times == 2) {
            EXPECT_EQ(store.count("PUT"), 3) << one.status;
        }
    }
}

// What is there is replaced where the user says so, and else nobody knows it from what cannot be asked about.
TEST_F(NetworkOutputs, ReplaceOnlyWhatTheyMay) {
    store_.put("bucket/shed.tif", "somebody's");
    const Words words = joined(viewshed_to("/vsis3/bucket/shed.tif"), {"--network"});
    expect_refusal(run(words), oro::test::failed,
                   {"/vsis3/bucket/shed.tif: is there already (--overwrite replaces it)"});
    EXPECT_EQ(store_.objects().at("bucket/shed.tif"), "somebody's");
    EXPECT_EQ(run(joined(words, {"--overwrite"})).exit_code, 0);
    EXPECT_NE(store_.objects().at("bucket/shed.tif"), "somebody's");
    ObjectStore closed;
    closed.fail([](const LoopbackRequest& request) -> std::optional<std::string> {
        if (request.method != "HEAD" && request.method != "GET") return std::nullopt;
        return s3_fault("403 Forbidden", "AccessDenied", "Access Denied");
    });
    expect_refusal(run(words, closed.environment()), oro::test::failed,
                   {"/vsis3/bucket/shed.tif: cannot be asked about: "});
    EXPECT_EQ(closed.count("PUT"), 0);
}

// Elevation data on the network are no more replaced than files of this machine.
TEST_F(NetworkOutputs, SpareWhatIsRead) {
    const std::string tif = bytes_of(oro::test::bundled());
    store_.put("bucket/jacksboro.tif", tif);
    const Words words{"viewshed",  "/vsis3/bucket/jacksboro.tif",
                      "--network", "--overwrite",
                      "--at",      "36.55,-84.25",
                      "--radius",  "3",
                      "--out",     "/vsis3/bucket/jacksboro.tif"};
    expect_refusal(run(joined(words, {"-q"})), oro::test::usage,
                   {"would replace /vsis3/bucket/jacksboro.tif"});
    EXPECT_EQ(store_.objects().at("bucket/jacksboro.tif"), tif);
}

// Files that belong together are there together: the second cannot be written, and the first is what it was.
TEST_F(NetworkOutputs, AreTakenBackWhereOthersFail) {
    store_.put("bucket/map.pgw", "was there");
    store_.put("bucket/map.png", "was there, too");
    int puts = 0;
    store_.fail([&](const LoopbackRequest& request) -> std::optional<std::string> {
        // The second file.
        if (request.method != "PUT" || puts++ != 1) return std::nullopt;
        return s3_fault("403 Forbidden", "AccessDenied", "Access Denied");
    });
    const Outcome outcome = run(
        joined(map_to("/vsis3/bucket/map.png"), {oro::test::bundled(), "--overwrite", "--network", "-q"}));
    expect_refusal(outcome, oro::test::failed, {"cannot be written: "});
    EXPECT_EQ(store_.objects().at("bucket/map.pgw"), "was there");
    EXPECT_EQ(store_.objects().at("bucket/map.png"), "was there, too");
    EXPECT_EQ(puts, 3);
}

// The two files of a horizon, too: where the second is refused the first goes back, or is what it was.
TEST_F(NetworkOutputs, BothFilesOfAHorizonOrNone) {
    const Words words{"horizon",
                      oro::test::bundled(),
                      "-q",
                      "--network",
                      "--overwrite",
                      "--radius",
                      "1",
                      "--directions",
                      "4",
                      "--bbox",
                      "-84.26,36.55,-84.25,36.56",
                      "--out",
                      "/vsis3/bucket/h.tif"};
    for (const bool there : {false, true}) {
        if (there) {
            store_.put("bucket/h.horizon.tif", "was there");
            store_.put("bucket/h.sky-view.tif", "was there, too");
        }
        int puts = 0;
        store_.fail([&](const LoopbackRequest& request) -> std::optional<std::string> {
            if (request.method != "PUT" || puts++ != 1) return std::nullopt;
            return s3_fault("403 Forbidden", "AccessDenied", "Access Denied");
        });
        expect_refusal(run(words), oro::test::failed, {"cannot be written: "});
        EXPECT_GE(puts, 2);
        if (there) {
            EXPECT_EQ(store_.objects().at("bucket/h.horizon.tif"), "was there");
            EXPECT_EQ(store_.objects().at("bucket/h.sky-view.tif"), "was there, too");
        } else {
            EXPECT_TRUE(store_.objects().empty());
        }
    }
}

// Where nothing says who the user is, nothing is signed; a file of keys says it, too.
TEST_F(NetworkOutputs, KeysComeFromTheEnvironmentOrTheirFile) {
    const Words words = joined(viewshed_to("/vsis3/bucket/shed.tif"), {"--network", "-q"});
    const Words no_keys{"AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY"};
    expect_refusal(run(words, no_keys), oro::test::failed, {"/vsis3/bucket/shed.tif"});
    for (const LoopbackRequest& request : store_.requests())
        EXPECT_FALSE(request.headers.contains("authorization"));
    EXPECT_TRUE(store_.objects().empty());
    fs::create_directories(folder_ / ".aws");
    write_bytes(folder_ / ".aws" / "credentials",
                "[default]\naws_access_key_id = " + std::string(ObjectStore::key_id) +
                    "\naws_secret_access_key = " + ObjectStore::key + "\n");
    const Outcome outcome = run(words, no_keys);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(store_.objects().size(), 1U);
    expect_no_keys();
}

// A region that is baked there, at once and by machines that share nothing but the store: the bytes of one.
TEST_F(NetworkOutputs, RegionsAreBakedThere) {
    const auto bake = [&](const std::string& out, const Words& more, const std::string& machine) {
        return run(joined({"bake", oro::test::bundled(), "--out", out, "-q"}, more),
                   {"OROGRAPH_CACHE=" + (folder_ / machine).string()});
    };
    ASSERT_EQ(bake("region.oro", {}, "a").exit_code, 0);
    const std::string whole = bytes_of(file("region.oro"));
    const std::string there = "/vsis3/bucket/region.oro";
    expect_refusal(bake("/vsis3/bucket/region.tif", {"--network"}, "a"), oro::test::usage,
                   {"must end in .oro"});
    const Outcome once = bake(there, {"--network", "--json"}, "a");
    ASSERT_EQ(once.exit_code, 0) << once.err;
    EXPECT_EQ(nlohmann::json::parse(once.out)["file"], there);
    EXPECT_EQ(store_.objects().at("bucket/region.oro"), whole);
    EXPECT_TRUE(fs::is_empty(folder_ / "a" / "baking"));
    expect_refusal(bake(there, {"--network"}, "a"), oro::test::failed, {there + ": exists already"});
    for (const auto& [part, machine] : {std::pair{"1/2", "a"}, std::pair{"2/2", "b"}}) {
        const Outcome shard =
            bake("/vsis3/bucket/joined.oro", {"--network", "--json", "--shard", part}, machine);
        ASSERT_EQ(shard.exit_code, 0) << shard.err;
        EXPECT_GT(nlohmann::json::parse(shard.out)["rows"], 0);
    }
    // A part that is there is not measured again, on a machine that has not seen it either.
    const Outcome again = bake("/vsis3/bucket/joined.oro", {"--network", "--json", "--shard", "1/2"}, "c");
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(nlohmann::json::parse(again.out)["rows"], 0);
    EXPECT_EQ(nlohmann::json::parse(again.out)["files"],
              nlohmann::json{"/vsis3/bucket/joined.oro.part-1of2"});
    const Outcome join = bake("/vsis3/bucket/joined.oro", {"--network", "--join"}, "d");
    ASSERT_EQ(join.exit_code, 0) << join.err;
    EXPECT_EQ(store_.objects().at("bucket/joined.oro"), whole);
    EXPECT_EQ(store_.objects().size(), 2U);
    expect_no_keys();
}

// What a bake has made is not lost where the server does not take it.
TEST_F(NetworkOutputs, BakedRegionsStayHereWhereTheyAreRefused) {
    store_.fail([](const LoopbackRequest& request) -> std::optional<std::string> {
        if (request.method != "PUT") return std::nullopt;
        return s3_fault("403 Forbidden", "AccessDenied", "Access Denied");
    });
    const Outcome outcome =
        run({"bake", oro::test::bundled(), "--out", "/vsis3/bucket/region.oro", "--network", "-q"},
            {"OROGRAPH_CACHE=" + (folder_ / "cache").string()});
    expect_refusal(outcome, oro::test::failed,
                   {"/vsis3/bucket/region.oro: cannot be written: ", "what was baked is "});
    const std::string kept = outcome.err.substr(outcome.err.find("what was baked is ") + 18);
    EXPECT_TRUE(fs::is_regular_file(kept.substr(0, kept.find('\n')))) << kept;
    EXPECT_TRUE(store_.objects().empty());
}

// A list of jobs whose files are objects: done in parts, and only what is not there any more is done again.
TEST_F(NetworkOutputs, BatchesGoOnWhereTheyWereStopped) {
    std::string list;
    for (int i = 0; i < 4; ++i)
        list += nlohmann::json{{"command", "viewshed"},
                               {"path", oro::test::bundled()},
                               {"at", {36.55 + 0.005 * i, -84.25}},
                               {"radius", 2},
                               {"out", "/vsis3/bucket/shed-" + std::to_string(i) + ".tif"}}
                    .dump() +
                "\n";
    write_bytes(file("jobs.jsonl"), list);
    const auto lines_of = [&](const Words& more) {
        const Outcome outcome = run(joined({"batch", "jobs.jsonl", "--network", "--json"}, more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const nlohmann::json lines = nlohmann::json::parse(outcome.out)["lines"];
        return std::pair<int, int>(lines["done"], lines["kept"]);
    };
    const Outcome without = run({"batch", "jobs.jsonl", "-q", "--shard", "4/4"});
    EXPECT_EQ(without.exit_code, oro::test::failed);
    EXPECT_TRUE(says(without.err, "/vsis3/bucket/shed-3.tif: lies on a network")) << without.err;
    EXPECT_TRUE(store_.requests().empty());
    EXPECT_EQ(lines_of({"--shard", "1/2"}), (std::pair<int, int>(2, 0)));
    EXPECT_EQ(lines_of({"--shard", "2/2"}), (std::pair<int, int>(2, 0)));
    EXPECT_EQ(store_.objects().size(), 4U);
    EXPECT_EQ(lines_of({}), (std::pair<int, int>(0, 4)));
    const std::string second = store_.objects().at("bucket/shed-1.tif");
    // Another's bytes in place of its own.
    store_.put("bucket/shed-1.tif", "x" + second.substr(1));
    EXPECT_EQ(lines_of({"--overwrite"}), (std::pair<int, int>(1, 3)));
    EXPECT_EQ(store_.objects().at("bucket/shed-1.tif"), second);
    for (const std::string& name : names_in(folder_ / "work"))
        EXPECT_FALSE(says(bytes_of(file(name)), ObjectStore::key_id)) << name;
}

}  // namespace

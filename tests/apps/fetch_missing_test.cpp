// What commands fetch for themselves, the cache of it, and paths on a network, against a server on the
// loopback address. Nothing here leaves the machine.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/gzip.h"
#include "tests/support/loopback_server.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::file_answer;
using oro::test::http_answer;
using oro::test::joined;
using oro::test::LoopbackRequest;
using oro::test::LoopbackSend;
using oro::test::LoopbackServer;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::says;
using oro::test::Words;
using oro::test::write_bytes;

// 1201 x 1201 posts of 46 N 8 E, gzipped: 500 m, and a cone of 2,000 m on it, 0.1 degrees wide, whose top is
// at 46.6 N 8.5 E.
std::string tile_with_a_mountain() {
    std::string bytes;
    for (int row = 0; row <= 1200; ++row)
        for (int column = 0; column <= 1200; ++column) {
            const double away_deg = std::hypot(row - 480, column - 600) / 1200.0;
            const auto height_m =
                static_cast<unsigned>(500.0 + 2000.0 * std::max(0.0, 1.0 - away_deg / 0.05));
            bytes += static_cast<char>(height_m >> 8U);
            bytes += static_cast<char>(height_m & 0xffU);
        }
    return oro::test::gzip_of(bytes);
}

// A user with settings and a cache of their own, whose table has the server's tiles as `skadi`, and its names
// as `peaks`.
class FetchMissing : public testing::Test {
  protected:
    void settle(const LoopbackServer& server, const nlohmann::json& more = {}) const {
        const nlohmann::json tiles{{"title", "A test"},
                                   {"url", server.address() + "/{latitude}{longitude}.hgt.gz"},
                                   {"file", "{latitude}{longitude}.hgt.gz"},
                                   {"side_deg", 1},
                                   {"format", "hgt.gz"},
                                   {"holds", "heights"},
                                   {"missing", "sea"},
                                   {"most_bytes", 10000000},
                                   {"licence", "for tests"},
                                   {"attribution", "The maker of heights"}};
        const nlohmann::json names{{"title", "A test"},
                                   {"url", server.address() + "/api/interpreter"},
                                   {"format", "overpass"},
                                   {"query", "node({south},{west},{north},{east});out;"},
                                   {"most_bytes", 100000},
                                   {"licence", "ODbL-1.0"},
                                   {"attribution", "(c) OpenStreetMap contributors"}};
        nlohmann::json table{{"sources", {{"skadi", tiles}, {"peaks", names}}}};
        if (more.is_object()) table.update(more);
        fs::create_directories(folder_ / "settings" / "orograph");
        write_bytes(folder_ / "settings" / "orograph" / "sources.json", table.dump());
    }
    [[nodiscard]] Outcome run(const Words& words) const {
        Circumstances circumstances;
        circumstances.environment = {"no_proxy=127.0.0.1",
                                     "XDG_CONFIG_HOME=" + (folder_ / "settings").string(),
                                     "OROGRAPH_CACHE=" + (folder_ / "cache").string()};
        return run_orograph(words, circumstances);
    }
    [[nodiscard]] fs::path cached() const { return folder_ / "cache" / "fetched" / "skadi"; }
    // N46E008 alone is land.
    [[nodiscard]] oro::test::LoopbackAnswer one_tile() const {
        return [this](const LoopbackRequest& request, const LoopbackSend& send) {
            send(request.path == "/N46E008.hgt.gz" ? file_answer(request, tile_, "\"1\"")
                                                   : http_answer("404 Not Found", "", ""));
        };
    }

    fs::path folder_{oro::test::scratch_folder()};
    std::string tile_{tile_with_a_mountain()};
};

const Words seen_across{"sight", "--from", "46.6,8.4", "--to", "46.6,8.6", "--above", "2"};

TEST_F(FetchMissing, CommandsGetWhatTheyLack) {
    const LoopbackServer server(one_tile());
    settle(server);
    const Outcome outcome = run(joined(seen_across, {"--fetch", "skadi", "--json"}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    // 30 km around 46.6 N: to 46.33 and 46.87 N, 8.00 and 9.00 E.
    EXPECT_TRUE(says(outcome.err, "skadi tiles: 1 fetched (")) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "to be named: The maker of heights")) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["visible"], false) << outcome.out;
    EXPECT_EQ(names_in(cached()), (Words{"N46E008.hgt.gz", "N46E008.hgt.gz.used"}));
    const std::size_t asked = server.requests().size();
    const Outcome again = run(joined(seen_across, {"--fetch", "skadi", "--fetch-km", "5", "--json"}));
    EXPECT_EQ(again.out, outcome.out);
    EXPECT_TRUE(says(again.err, "skadi tiles: 0 fetched (0.0 MB), 1 from the cache")) << again.err;
    EXPECT_EQ(server.requests().size(), asked);
    // Data of the user's own are asked for nowhere.
    fs::copy_file(cached() / "N46E008.hgt.gz", folder_ / "N46E008.hgt.gz");
    fs::remove_all(folder_ / "cache");
    const Outcome own = run(joined(
        seen_across, {"--fetch", "skadi", "--fetch-km", "5", (folder_ / "N46E008.hgt.gz").string(), "-q"}));
    EXPECT_EQ(own.exit_code, 0) << own.err;
    EXPECT_EQ(server.requests().size(), asked);
    EXPECT_FALSE(fs::exists(cached()));
}

TEST_F(FetchMissing, FailsInOneLine) {
    const LoopbackServer server([](const LoopbackRequest& request, const LoopbackSend& send) {
        send(http_answer(request.path.starts_with("/N46") ? "403 Forbidden" : "404 Not Found", "", ""));
    });
    settle(server);
    expect_refusal(run(joined(seen_across, {"--fetch", "skadi", "--fetch-km", "5"})), oro::test::failed,
                   {"/N46E008.hgt.gz: the server answers 403"});
    expect_refusal(run({"info", "--fetch", "skadi"}), oro::test::usage, {"--fetch"});
    expect_refusal(run({"sight", "--from", "10.5,20.5", "--to", "10.5,20.6", "--fetch", "skadi", "--fetch-km",
                        "5", "-q"}),
                   oro::test::no_data, {"skadi: the server has no tile there: it is sea"});
    expect_refusal(run(joined(seen_across, {"--fetch", "worldcover"})), oro::test::usage,
                   {"--fetch worldcover: choose glo30, glo90, opentopography, skadi or terrarium"});
    expect_refusal(run(joined(seen_across, {"--fetch", "skadi", "--fetch-km", "0"})), oro::test::usage,
                   {"--fetch-km 0"});
    expect_refusal(run({"horizon", "--fetch", "skadi", "--out", "x.tif"}), oro::test::usage,
                   {"--fetch skadi: needs to know where: name a place, --bbox or --tile"});
    expect_refusal(run({"sight", "--from", "Eiger", "--to", "46,8", "--fetch", "skadi"}), oro::test::usage,
                   {"--from Eiger: "});
}

// Jobs of a cluster that share a cache: one of them fetches, and the others take what it has fetched.
TEST_F(FetchMissing, JobsShareACache) {
    const LoopbackServer server([this](const LoopbackRequest& request, const LoopbackSend& send) {
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
        one_tile()(request, send);
    });
    settle(server);
    const Words words = joined(seen_across, {"--fetch", "skadi", "--fetch-km", "5"});
    std::vector<Outcome> outcomes(4);
    {
        std::vector<std::jthread> jobs;
        for (Outcome& outcome : outcomes) jobs.emplace_back([&] { outcome = run(words); });
    }
    for (const Outcome& outcome : outcomes) EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(server.requests().size(), 1U);
    EXPECT_EQ(names_in(cached()), (Words{"N46E008.hgt.gz", "N46E008.hgt.gz.used"}));
}

// Tiles used longest ago go first; those of the last hour stay.
TEST_F(FetchMissing, TheCacheHasALimit) {
    const LoopbackServer server(one_tile());
    settle(server, {{"cache_limit_gb", 0.0}});
    fs::create_directories(cached());
    const auto now = fs::file_time_type::clock::now();
    for (const auto& [name, hours] :
         {std::pair{"A.hgt.gz", 30}, std::pair{"B.hgt.gz", 3}, std::pair{"C.hgt.gz", 20}}) {
        write_bytes(cached() / name, std::string(1000000, 'x'));
        fs::last_write_time(cached() / name, now - std::chrono::hours(hours));
    }
    write_bytes(cached() / "A.hgt.gz.used", "");
    fs::last_write_time(cached() / "A.hgt.gz.used", now - std::chrono::hours(2));
    write_bytes(cached() / "D.hgt.gz.part", "on its way");
    const Outcome all = run({"fetch", "--cache", "--cache-limit", "1"});
    EXPECT_EQ(all.out, "skadi  3 tiles, 3.0 MB\nCache: 3 tiles, 3.0 MB of at most 1.0 GB\n") << all.err;
    const Outcome two = run({"fetch", "--cache", "--cache-limit", "0.002", "--json"});
    const nlohmann::json said = nlohmann::json::parse(two.out);
    EXPECT_EQ(said["removed_tiles"], 1);
    EXPECT_EQ(said["bytes"], 2000000);
    EXPECT_EQ(names_in(cached()), (Words{"A.hgt.gz", "A.hgt.gz.used", "B.hgt.gz", "D.hgt.gz.part"}));
    // The setting's limit, after a tile that is used now.
    EXPECT_EQ(run(joined(seen_across, {"--fetch", "skadi", "--fetch-km", "5", "-q"})).exit_code, 0);
    EXPECT_EQ(names_in(cached()), (Words{"D.hgt.gz.part", "N46E008.hgt.gz", "N46E008.hgt.gz.used"}));
    expect_refusal(run({"fetch", "--source", "skadi", "--cache-limit", "1"}), oro::test::usage,
                   {"--cache-limit 1.0: says nothing without --cache"});
}

// By GDAL's names, and only where the user lets them.
TEST_F(FetchMissing, PathsOnANetworkAreOptIn) {
    const std::string tif = bytes_of(oro::test::bundled());
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        if (request.path != "/jacksboro.tif") return void(send(http_answer("404 Not Found", "", "")));
        const auto range = request.headers.find("range");
        std::size_t from = 0, to = 0;
        if (range == request.headers.end() ||
            std::sscanf(range->second.c_str(), "bytes=%zu-%zu", &from, &to) != 2)
            return void(send(http_answer("200 OK", "Accept-Ranges: bytes\r\n", tif)));
        to = std::min(to, tif.size() - 1);
        send(http_answer("206 Partial Content",
                         "Content-Range: bytes " + std::to_string(from) + "-" + std::to_string(to) + "/" +
                             std::to_string(tif.size()) + "\r\n",
                         tif.substr(from, to - from + 1)));
    });
    settle(server);
    const std::string path = "/vsicurl/" + server.address() + "/jacksboro.tif";
    expect_refusal(run({"info", path}), oro::test::usage,
                   {path + ": lies on a network; --network lets it be reached"});
    EXPECT_TRUE(server.requests().empty());
    const Outcome near =
        run({"profile", oro::test::bundled(), "--along", "36.5,-84.3;36.6,-84.2", "--json", "-q"});
    const Outcome far =
        run({"profile", path, "--network", "--along", "36.5,-84.3;36.6,-84.2", "--json", "-q"});
    ASSERT_EQ(far.exit_code, 0) << far.err;
    EXPECT_FALSE(server.requests().empty());
    // Heights are the same to the bit.
    for (const char* const what : {"length_m", "points", "begin", "end", "highest", "lowest", "ascent_m"})
        EXPECT_EQ(nlohmann::json::parse(far.out)[what], nlohmann::json::parse(near.out)[what]) << what;
}

// The words of the commands of a page's section, but for the program's name.
std::vector<Words> commands_of_page(const fs::path& page, const std::string& heading) {
    std::vector<Words> commands;
    std::istringstream lines(bytes_of(page));
    bool is_there = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("## ")) is_there = line == "## " + heading;
        if (!is_there || !line.starts_with("    orograph ")) continue;
        std::istringstream words(line.substr(13));
        Words& command = commands.emplace_back();
        for (std::string word; words >> word;) command.push_back(word);
    }
    return commands;
}

// A new user's way, from nothing to a panorama of a mountain with its name: the commands of two pages, word
// for word but for the picture's size, in an empty home. The server stands in for the network.
TEST_F(FetchMissing, FromNothingToAPanoramaWithNames) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        if (request.path.starts_with("/api/interpreter?")) {
            send(http_answer("200 OK", "", R"({"elements": [{"type": "node", "id": 1, "lat": 46.6,
                "lon": 8.5, "tags": {"natural": "peak", "name": "My Mountain", "ele": "2500"}}]})"));
        } else {
            one_tile()(request, send);
        }
    });
    settle(server);
    const fs::path root = oro::test::bundled_data().parent_path();
    const auto commands = commands_of_page(root / "README.md", "A panorama of your mountain, with names");
    ASSERT_EQ(commands.size(), 2U);
    EXPECT_EQ(commands, commands_of_page(root / "docs" / "commands" / "fetch.md",
                                         "From nothing to a panorama with names"));
    const fs::path home = folder_ / "home", work = folder_ / "work";
    fs::create_directories(home / ".config");
    fs::create_directories(work);
    fs::rename(folder_ / "settings" / "orograph", home / ".config" / "orograph");
    Circumstances circumstances;
    circumstances.environment = {"no_proxy=127.0.0.1", "HOME=" + home.string(), "XDG_CONFIG_HOME",
                                 "XDG_CACHE_HOME",     "XDG_STATE_HOME",        "OROGRAPH_CACHE"};
    circumstances.folder = work;
    const auto begin = std::chrono::steady_clock::now();
    std::string said;
    for (const Words& command : commands) {
        const bool draws = command.front() == "panorama";
        const Outcome outcome =
            run_orograph(draws ? joined(command, {"--width", "800", "--json"}) : command, circumstances);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        said = outcome.out;
    }
    const double all_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const nlohmann::json named = nlohmann::json::parse(said)["names"]["named"];
    ASSERT_EQ(named.size(), 1U) << said;
    EXPECT_EQ(named[0]["name"], "My Mountain");
    // From 46.6599 N 8.0536 E along the ellipsoid, by pyproj.Geod: 34.83 km; the line rises to the summit.
    EXPECT_NEAR(named[0]["distance_m"].get<double>(), 34828.0, 100.0);
    std::printf("from nothing to a panorama with names: %zu commands, %zu requests, %.1f s\n",
                commands.size(), server.requests().size(), all_s);
    EXPECT_LT(all_s, 600.0);
    // Where the pages say that things are, and nothing elsewhere.
    EXPECT_EQ(names_in(home), (Words{".cache", ".config"}));
    EXPECT_EQ(names_in(home / ".cache" / "orograph" / "fetched" / "skadi"),
              (Words{"N46E008.hgt.gz", "N46E008.hgt.gz.used"}));
    EXPECT_TRUE(fs::exists(work / "panorama.png") && fs::exists(work / "peaks.geojson"));
}

}  // namespace

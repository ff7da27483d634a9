// orograph fetch against a server on the loopback address. Nothing here leaves the machine.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

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
using oro::test::gzip_of;
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

// 1201 x 1201 posts that rise by a metre from row to row, with noise of 0 to 3 m, so that it packs badly.
std::string tile_hgt() {
    std::string bytes;
    unsigned noise = 54;
    for (int post = 0; post < 1201 * 1201; ++post) {
        noise = noise * 1664525U + 1013904223U;
        const unsigned height_m = static_cast<unsigned>(post / 1201) + (noise >> 30U);
        bytes += static_cast<char>(height_m >> 8U);
        bytes += static_cast<char>(height_m & 0xffU);
    }
    return bytes;
}

class FetchCommand : public testing::Test {
  protected:
    // A table whose one source, `test`, lies on the server.
    [[nodiscard]] std::string table(const LoopbackServer& server, const nlohmann::json& changes = {}) const {
        nlohmann::json source{{"title", "A test"},
                              {"url", server.address() + "/{latitude}/{latitude}{longitude}.hgt.gz"},
                              {"file", "{latitude}{longitude}.hgt.gz"},
                              {"side_deg", 1},
                              {"format", "hgt.gz"},
                              {"holds", "heights"},
                              {"missing", "sea"},
                              {"most_bytes", 10000000},
                              {"licence", "for tests"},
                              {"attribution", "Nobody"}};
        if (changes.is_object()) source.update(changes);
        const fs::path file = folder_ / "table.json";
        write_bytes(file, nlohmann::json{{"sources", {{"test", source}}}}.dump());
        return file.string();
    }
    [[nodiscard]] Words words(const std::string& table, const Words& more) const {
        return joined({"fetch", "--source", "test", "--sources", table, "--out", tiles_.string()}, more);
    }
    static Circumstances plain() {
        Circumstances circumstances;
        circumstances.environment = {"no_proxy=127.0.0.1", "XDG_CONFIG_HOME=/nonexistent"};
        return circumstances;
    }
    [[nodiscard]] Outcome run(const std::string& table, const Words& more) const {
        return run_orograph(words(table, more), plain());
    }
    // The one line on a tile that a server answers so, and nothing is left of it.
    void expect_refused_tile(const std::string& body, const std::string& words) {
        const LoopbackServer server([&](const LoopbackRequest&, const LoopbackSend& send) {
            send(http_answer("200 OK", "ETag: \"1\"\r\n", body));
        });
        const Outcome outcome = run(table(server), {"--tile", "N46E008"});
        EXPECT_EQ(outcome.exit_code, oro::test::failed);
        EXPECT_EQ(outcome.err_lines().size(), 2U) << outcome.err;
        EXPECT_TRUE(says(outcome.err, "/N46/N46E008.hgt.gz: " + words)) << outcome.err;
        EXPECT_TRUE(says(outcome.err, "test: 1 of 1 tiles could not be fetched")) << outcome.err;
        EXPECT_EQ(names_in(tiles_), Words{});
        EXPECT_EQ(server.requests().size(), 1U);
    }

    fs::path folder_{oro::test::scratch_folder()};
    fs::path tiles_{folder_ / "tiles"};
    std::string tile_{gzip_of(tile_hgt())};
};

// Two tiles, one sea and one that fails twice; a second run keeps all and asks for the sea alone; info reads
// them.
TEST_F(FetchCommand, GetsTilesThatOtherCommandsRead) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        if (request.path == "/N46/N46E009.hgt.gz" && request.number < 1) {
            send(http_answer("500 Internal Server Error", "", ""));
        } else {
            send(request.path.starts_with("/N46") ? file_answer(request, tile_, "\"1\"")
                                                  : http_answer("404 Not Found", "", "no"));
        }
    });
    const std::string source = table(server);
    const Outcome outcome = run(source, {"--tile", "N46E008:N46E009", "--tile", "N45E008"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(outcome.out.starts_with("N46E008  fetched  " + (tiles_ / "N46E008.hgt.gz").string() + ", "))
        << outcome.out;
    EXPECT_TRUE(says(outcome.out, "N45E008  missing  no tile there: sea\nTiles: 2 fetched, 1 missing\n"))
        << outcome.out;
    EXPECT_TRUE(says(outcome.out, "Licence: for tests\nTo be named: Nobody\n")) << outcome.out;
    EXPECT_EQ(names_in(tiles_), (Words{"N46E008.hgt.gz", "N46E009.hgt.gz"}));
    EXPECT_EQ(bytes_of(tiles_ / "N46E009.hgt.gz"), tile_);
    EXPECT_EQ(server.requests().size(), 4U);
    const Outcome again = run(source, {"--bbox", "8.2,45.5,9.2,46.5", "--json"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    const auto reported = nlohmann::json::parse(again.out);
    EXPECT_EQ(reported["counts"]["kept"], 2);
    EXPECT_EQ(reported["counts"]["missing"], 2);
    EXPECT_EQ(reported["tiles"][0]["tile"], "N46E008");
    EXPECT_EQ(reported["tiles"][0]["state"], "kept");
    EXPECT_EQ(server.requests().size(), 6U);
    const Outcome info = run_orograph({"info", tiles_.string()});
    EXPECT_EQ(info.exit_code, 0) << info.err;
}

TEST_F(FetchCommand, ADryRunAsksNobody) {
    const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend&) {});
    const Outcome outcome = run(table(server), {"--tile", "S07W073", "--dry-run"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("S07W073  wanted   " + server.address() +
                                        "/S07/S07W073.hgt.gz\nTiles: 1 wanted\n"))
        << outcome.out;
    EXPECT_TRUE(server.requests().empty());
    EXPECT_FALSE(fs::exists(tiles_));
}

// Killed on the way, by a signal that nothing can catch, and run again: the same bytes, and only the rest is
// sent.
TEST_F(FetchCommand, GoesOnAfterAKill) {
    const LoopbackServer* self = nullptr;
    const std::size_t half = tile_.size() / 2;
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        const std::string answer = file_answer(request, tile_, "\"1\"");
        if (request.number > 0) {
            send(answer);
            return;
        }
        send(answer.substr(0, answer.find("\r\n\r\n") + 4 + half));
        for (int i = 0; i < 100 && !self->is_ending(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
    });
    self = &server;
    Circumstances killed = plain();
    killed.signal = 9;
    killed.signal_after_s = 1.0;
    const Words fetch = words(table(server), {"--tile", "N46E008"});
    EXPECT_EQ(run_orograph(fetch, killed).exit_code, 128 + 9);
    EXPECT_EQ(names_in(tiles_), (Words{"N46E008.hgt.gz.part", "N46E008.hgt.gz.part-etag"}));
    EXPECT_EQ(bytes_of(tiles_ / "N46E008.hgt.gz.part"), tile_.substr(0, half));
    const Outcome again = run_orograph(fetch, plain());
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(names_in(tiles_), (Words{"N46E008.hgt.gz"}));
    EXPECT_EQ(bytes_of(tiles_ / "N46E008.hgt.gz"), tile_);
    ASSERT_EQ(server.requests().size(), 2U);
    EXPECT_EQ(server.requests()[1].headers.at("range"), "bytes=" + std::to_string(half) + "-");
    EXPECT_TRUE(server.requests()[1].headers.at("user-agent").starts_with("Orograph/"));
}

// Stopped at several moments and in each way, and run again: the files of a run that nobody stopped, and of
// what had come nothing is sent again.
TEST_F(FetchCommand, StoppedInAnyWayItGoesOn) {
    const LoopbackServer* self = nullptr;
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        const std::string answer = file_answer(request, tile_, "\"1\"");
        constexpr int pieces = 8;
        for (int i = 0; i < pieces && !self->is_ending(); ++i) {
            const std::size_t begin = answer.size() * static_cast<std::size_t>(i) / pieces;
            const std::size_t end = answer.size() * static_cast<std::size_t>(i + 1) / pieces;
            if (!send(answer.substr(begin, end - begin))) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(40));
        }
    });
    self = &server;
    const Words three{"--tile", "N46E008:N46E010", "--jobs", "2"};
    const std::string source = table(server);
    int stopped = 0, gone_on = 0;
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(run(source, three).exit_code, 0);
    const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
        for (const double share : {0.35, 0.6, 0.85}) {
            const double after_s = share * whole_s;
            SCOPED_TRACE(std::to_string(signal) + " after " + std::to_string(after_s));
            fs::remove_all(tiles_);
            Circumstances killed = plain();
            killed.signal = signal;
            killed.signal_after_s = after_s;
            const Outcome first = run_orograph(words(source, three), killed);
            if (first.exit_code != 0) {
                EXPECT_EQ(first.exit_code, 128 + signal) << first.err;
                ++stopped;
            }
            // A tile has its name when it is whole, and only then.
            std::size_t there = 0;
            for (const std::string& name : fs::exists(tiles_) ? names_in(tiles_) : Words{}) {
                const bool is_part = name.ends_with(".part") || name.ends_with(".part-etag");
                EXPECT_TRUE(is_part || bytes_of(tiles_ / name) == tile_) << name;
                if (!name.ends_with("-etag")) there += fs::file_size(tiles_ / name);
            }
            const std::size_t asked = server.requests().size();
            const Outcome again = run(source, three);
            EXPECT_EQ(again.exit_code, 0) << again.err;
            EXPECT_EQ(names_in(tiles_), (Words{"N46E008.hgt.gz", "N46E009.hgt.gz", "N46E010.hgt.gz"}));
            for (const std::string& name : names_in(tiles_)) EXPECT_TRUE(bytes_of(tiles_ / name) == tile_);
            std::size_t wanted = 0;
            const auto requests = server.requests();
            for (std::size_t i = asked; i < requests.size(); ++i) {
                const auto range = requests[i].headers.find("range");
                wanted += tile_.size() -
                          (range == requests[i].headers.end() ? 0 : std::stoul(range->second.substr(6)));
            }
            EXPECT_EQ(wanted, 3 * tile_.size() - there);
            gone_on += there > 0 && there < 3 * tile_.size();
        }
    }
    EXPECT_GE(stopped, 3);
    EXPECT_GE(gone_on, 1);
}

// 64 MiB of zeros in 64 KiB; pages and errors instead of tiles; what is cut; what is damaged.
TEST_F(FetchCommand, RefusesWhatIsNoTile) {
    expect_refused_tile(gzip_of(std::string(std::size_t{64} << 20U, '\0')),
                        "unpacks to more than a tile of 3601 x 3601 posts: it is refused");
    expect_refused_tile("<!DOCTYPE html><html>log in</html>", "is no gzip file: it is a page of the web");
    expect_refused_tile("<?xml version=\"1.0\"?><Error/>",
                        "is no gzip file: it is an XML text, as servers send with an error");
    expect_refused_tile("", "is no gzip file: it is empty");
    expect_refused_tile(gzip_of("0123456789"), "unpacks to 10 bytes; a tile has 2884802");
    expect_refused_tile(tile_.substr(0, tile_.size() - 4), "is a damaged or truncated gzip file");
    std::string damaged = tile_;
    damaged[tile_.size() / 2] = static_cast<char>(damaged[tile_.size() / 2] ^ 0x10);
    expect_refused_tile(damaged, "is a damaged or truncated gzip file");
}

// The bundled GeoTIFF is no whole tile; as the tile of another place it is refused, whatever it holds.
TEST_F(FetchCommand, RefusesGeoTiffsOfOtherPlaces) {
    const std::string tif = bytes_of(oro::test::bundled());
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(file_answer(request, request.path == "/N46E008.tif" ? tif : "<html>", "\"1\""));
    });
    const std::string source = table(server, {{"url", server.address() + "/{latitude}{longitude}.tif"},
                                              {"file", "{latitude}{longitude}.tif"},
                                              {"format", "geotiff"}});
    const Outcome outcome = run(source, {"--tile", "N46E008:N46E009"});
    EXPECT_EQ(outcome.exit_code, oro::test::failed);
    EXPECT_TRUE(says(outcome.err, "/N46E008.tif: does not lie at N46E008")) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "/N46E009.tif: is no GeoTIFF: it is a page of the web")) << outcome.err;
    EXPECT_EQ(names_in(tiles_), Words{});
}

// Errors of one tile stop no other; a source may hold every missing tile for an error.
TEST_F(FetchCommand, OneFailureDoesNotStopTheOthers) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        if (request.path == "/N46/N46E007.hgt.gz") {
            send(http_answer("403 Forbidden", "", ""));
        } else if (request.path == "/N46/N46E008.hgt.gz") {
            send(http_answer("404 Not Found", "", ""));
        } else {
            send(file_answer(request, tile_, "\"1\""));
        }
    });
    const std::string source = table(server, {{"missing", "error"}});
    const Outcome outcome = run(source, {"--tile", "N46E007:N46E009", "--jobs", "1"});
    EXPECT_EQ(outcome.exit_code, oro::test::failed);
    EXPECT_EQ(outcome.err_lines().size(), 3U) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "/N46/N46E007.hgt.gz: the server answers 403")) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "/N46/N46E008.hgt.gz: the server has no such tile")) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "test: 2 of 3 tiles could not be fetched")) << outcome.err;
    EXPECT_EQ(names_in(tiles_), (Words{"N46E009.hgt.gz"}));
}

// What is there and is no good tile may be the user's: it stays.
TEST_F(FetchCommand, LeavesDamagedFilesThatAreThere) {
    const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend&) {});
    fs::create_directories(tiles_);
    write_bytes(tiles_ / "N46E008.hgt.gz", "mine");
    const Outcome outcome = run(table(server), {"--tile", "N46E008"});
    EXPECT_EQ(outcome.exit_code, oro::test::failed);
    EXPECT_TRUE(says(outcome.err, "N46E008.hgt.gz: is no gzip file; remove it to fetch the tile again"))
        << outcome.err;
    EXPECT_EQ(bytes_of(tiles_ / "N46E008.hgt.gz"), "mine");
    EXPECT_TRUE(server.requests().empty());
}

TEST_F(FetchCommand, WhatIsWrongIsSaidInOneLine) {
    const auto refused = [&](const Words& more, const Words& words, int code = oro::test::usage) {
        expect_refusal(run_orograph(joined({"fetch"}, more), plain()), code, words);
    };
    refused({}, {"--source: is missing: choose canopy, glo30, glo90, opentopography, passes, peaks, "
                 "settlements, skadi, terrarium or worldcover"});
    refused({"--source", "srtm"}, {"--source srtm: choose canopy, glo30, glo90, opentopography, passes, "
                                   "peaks, settlements, skadi, terrarium or worldcover"});
    refused({"--source", "skadi", "--out", "x"}, {"--bbox: is missing: name the region"});
    refused({"--source", "skadi", "--tile", "N46E008"}, {"--out: is missing: name the folder"});
    refused({"--source", "skadi", "--tile", "N46", "--out", "x"}, {"--tile N46: "});
    refused({"--source", "skadi", "--bbox", "-180,-90,180,90", "--out", "x"},
            {"-180,-90,180,90: holds more than 1000 tiles of skadi: name a smaller box"});
    refused({"--source", "skadi", "--tile", "N46E008", "--out", "x", "--jobs", "17"}, {"--jobs 17"});
    const fs::path table = folder_ / "table.json";
    write_bytes(table, R"({"sources": {"x": {"titel": "?"}}})");
    refused({"--source", "x", "--sources", table.string()}, {"table.json: is no table of sources: ", "titel"},
            oro::test::failed);
    write_bytes(table, R"({"sources": {"../x": {}}})");
    refused({"--source", "x", "--sources", table.string()},
            {"table.json: is no table of sources: '../x' is no name of a source"}, oro::test::failed);
    write_bytes(table, "[");
    refused({"--source", "x", "--sources", table.string()}, {"table.json: is no table of sources: "},
            oro::test::failed);
}

}  // namespace

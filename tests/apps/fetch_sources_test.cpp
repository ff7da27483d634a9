// orograph fetch of pictures of heights, of canopy, and from a server that wants a key, against a server on
// the loopback address. Nothing here leaves the machine.
#include <gtest/gtest.h>
#include <png.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/apps/program.h"
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

constexpr const char* key = "SECRET-0123456789abcdef";

class FetchSources : public testing::Test {
  protected:
    // A table whose one source is `test`.
    fs::path write_table(const nlohmann::json& changes) const {
        nlohmann::json source{{"title", "A test"},     {"side_deg", 1},          {"missing", "sea"},
                              {"most_bytes", 1000000}, {"licence", "for tests"}, {"attribution", "Nobody"},
                              {"holds", "heights"},    {"format", "geotiff"}};
        source.update(changes);
        const fs::path file = folder_ / "table.json";
        write_bytes(file, nlohmann::json{{"sources", {{"test", source}}}}.dump());
        return file;
    }
    [[nodiscard]] Words words(const nlohmann::json& changes, const Words& more) const {
        const fs::path file = write_table(changes);
        return joined({"fetch", "--source", "test", "--sources", file.string(), "--out", tiles_.string(),
                       "--retries", retries_},
                      more);
    }
    static Circumstances plain(const Words& environment = {}) {
        Circumstances circumstances;
        circumstances.environment =
            joined({"no_proxy=127.0.0.1", "XDG_CONFIG_HOME=/nonexistent"}, environment);
        return circumstances;
    }
    // A GeoTIFF of 46 N 8 E that other commands open, of one degree.
    [[nodiscard]] std::string geotiff(const std::string& type) const {
        const fs::path file = folder_ / "made.tif";
        const Outcome made =
            run_program({"gdal_create", "-q", "-outsize", "128", "128", "-a_srs", "EPSG:4326", "-a_ullr", "8",
                         "47", "9", "46", "-burn", "17", "-ot", type, file.string()});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        const std::string bytes = bytes_of(file);
        fs::remove(file);
        return bytes;
    }

    std::string retries_{"1"};
    fs::path folder_{oro::test::scratch_folder()};
    fs::path tiles_{folder_ / "tiles"};
};

// H = 1000 + 0.25 column + 0.5 row of all the world's pixels at a zoom, modulo 4096.
double made_height_m(std::int64_t column, std::int64_t row) {
    return 1000.0 + static_cast<double>((column + 2 * row) % 16384) * 0.25;
}

std::string picture_of(std::int64_t x, std::int64_t y) {
    std::vector<std::uint8_t> rgb;
    for (std::int64_t row = 0; row < 256; ++row)
        for (std::int64_t column = 0; column < 256; ++column) {
            const auto quarter =
                static_cast<unsigned>(4.0 * (made_height_m(256 * x + column, 256 * y + row) + 32768.0));
            rgb.push_back(static_cast<std::uint8_t>(quarter >> 10U));
            rgb.push_back(static_cast<std::uint8_t>(quarter >> 2U));
            rgb.push_back(static_cast<std::uint8_t>(quarter << 6U));
        }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = 256;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = 0;
    EXPECT_NE(png_image_write_to_memory(&image, nullptr, &size, 0, rgb.data(), 0, nullptr), 0);
    std::string bytes(size, '\0');
    EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr), 0);
    bytes.resize(size);
    return bytes;
}

// N46E008 at zoom 9, by mercantile.tiles(8, 46, 9, 47, 9): x 267 to 268, y 180 to 182.
const nlohmann::json terrarium_layout(const LoopbackServer& server) {
    return {{"url", server.address() + "/{z}/{x}/{y}.png"},
            {"file", "{latitude}{longitude}_terrarium.tif"},
            {"format", "terrarium"},
            {"zoom", 9}};
}

std::string picture_answer(const LoopbackRequest& request) {
    int zoom = 0;
    long x = 0, y = 0;
    EXPECT_EQ(std::sscanf(request.path.c_str(), "/%d/%ld/%ld.png", &zoom, &x, &y), 3) << request.path;
    return file_answer(request, picture_of(x, y), "\"1\"");
}

TEST_F(FetchSources, PutsPicturesOfHeightsTogether) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(request.path == "/9/267/181.png" && request.number == 0
                 ? http_answer("503 Service Unavailable", "", "")
                 : picture_answer(request));
    });
    const Words fetch = words(terrarium_layout(server), {"--tile", "N46E008"});
    const Outcome outcome = run_orograph(fetch, plain());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.out, "N46E008  fetched  ")) << outcome.out;
    EXPECT_EQ(names_in(tiles_), (Words{"N46E008_terrarium.tif"}));
    EXPECT_EQ(server.requests().size(), 7U);
    const std::string file = (tiles_ / "N46E008_terrarium.tif").string();
    // By GDAL's own way from degrees to pixels, at places in three pictures.
    const double pixel_deg = 360.0 / (512 * 256);
    for (const auto& [lon_deg, lat_deg] :
         {std::pair{8.1, 46.9}, std::pair{8.5, 46.5}, std::pair{8.95, 46.05}}) {
        const Outcome height = run_program({"gdallocationinfo", "-valonly", "-wgs84", file,
                                            std::to_string(lon_deg), std::to_string(lat_deg)});
        const double sine = std::sin(lat_deg * 3.14159265358979 / 180.0);
        const double north = 0.5 - std::log((1.0 + sine) / (1.0 - sine)) / (4.0 * 3.14159265358979);
        const auto column = static_cast<std::int64_t>((lon_deg + 180.0) / pixel_deg);
        const auto row = static_cast<std::int64_t>(north * 512 * 256);
        EXPECT_EQ(std::atof(height.out.c_str()), made_height_m(column, row)) << lon_deg << height.err;
    }
    const Outcome again = run_orograph(fetch, plain());
    EXPECT_TRUE(says(again.out, "N46E008  kept")) << again.out << again.err;
    EXPECT_EQ(server.requests().size(), 7U);
    const Outcome info = run_orograph({"info", tiles_.string()}, plain());
    EXPECT_EQ(info.exit_code, 0) << info.out << info.err;
    EXPECT_TRUE(says(info.out, "Nobody")) << info.out;
}

// Pictures that have come stay for the next run; one that is none leaves no tile.
TEST_F(FetchSources, GoesOnWithPictures) {
    std::atomic<bool> is_broken = true;
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(is_broken && request.path == "/9/268/182.png" ? http_answer("200 OK", "", "<html>")
                                                           : picture_answer(request));
    });
    const Words fetch = words(terrarium_layout(server), {"--tile", "N46E008", "--jobs", "1"});
    const Outcome outcome = run_orograph(fetch, plain());
    EXPECT_EQ(outcome.exit_code, oro::test::failed);
    EXPECT_TRUE(says(outcome.err, "/9/268/182.png: is no picture of 256 x 256 heights: ")) << outcome.err;
    EXPECT_EQ(names_in(tiles_), (Words{"N46E008_terrarium.tif.parts"}));
    is_broken = false;
    const Outcome again = run_orograph(fetch, plain());
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(names_in(tiles_), (Words{"N46E008_terrarium.tif"}));
    EXPECT_EQ(server.requests().size(), 7U);
}

// At zoom 15 a degree at 46 N has 92 x 133 of them.
TEST_F(FetchSources, TooManyPicturesAreRefused) {
    const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend&) {});
    nlohmann::json layout = terrarium_layout(server);
    layout["zoom"] = 15;
    const Outcome outcome = run_orograph(words(layout, {"--tile", "N46E008"}), plain());
    EXPECT_EQ(outcome.exit_code, oro::test::failed);
    EXPECT_TRUE(says(outcome.err, "N46E008_terrarium.tif: has 12236 pictures at zoom 15, and at most 4096"))
        << outcome.err;
    EXPECT_TRUE(server.requests().empty());
}

TEST_F(FetchSources, CanopyIsWholeMetres) {
    std::string body = geotiff("Byte");
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(file_answer(request, body, "\"1\""));
    });
    const nlohmann::json layout{{"url", server.address() + "/d?path=/x&files={latitude}{longitude}_Map.tif"},
                                {"file", "{latitude}{longitude}_Map.tif"},
                                {"holds", "canopy"}};
    const Outcome outcome = run_orograph(words(layout, {"--tile", "N46E008"}), plain());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(bytes_of(tiles_ / "N46E008_Map.tif"), body);
    EXPECT_EQ(server.requests()[0].path, "/d?path=/x&files=N46E008_Map.tif");
    fs::remove_all(tiles_);
    body = geotiff("Float32");
    const Outcome refused = run_orograph(words(layout, {"--tile", "N46E008"}), plain());
    EXPECT_TRUE(says(refused.err, "holds fractions, and no classes or whole metres")) << refused.err;
}

// Everything that runs with the key goes through here: the key is in nothing that is said or left.
class FetchWithKey : public FetchSources {
  protected:
    FetchWithKey() { retries_ = "0"; }
    [[nodiscard]] static nlohmann::json layout(const std::string& address) {
        return {{"url", address + "/API?south={south}&north={north}&west={west}&east={east}&API_Key={key}"},
                {"key_variable", "TEST_API_KEY"},
                {"file", "{latitude}{longitude}.tif"}};
    }
    Outcome run(const std::string& address, const Words& more, const Circumstances& circumstances) {
        Outcome outcome =
            run_orograph(words(layout(address), joined({"--tile", "N46E008"}, more)), circumstances);
        EXPECT_FALSE(says(outcome.out, key)) << outcome.out;
        EXPECT_FALSE(says(outcome.err, key)) << outcome.err;
        for (const auto& place : fs::recursive_directory_iterator(folder_)) {
            EXPECT_FALSE(says(place.path().string(), key)) << place.path();
            if (place.is_regular_file() && place.path().filename() != "key") {
                EXPECT_FALSE(says(bytes_of(place.path()), key)) << place.path();
            }
        }
        return outcome;
    }
    Outcome run(const std::string& address, const Words& more = {}) {
        return run(address, more, plain({std::string("TEST_API_KEY=") + key}));
    }
};

TEST_F(FetchWithKey, TellsTheServerAlone) {
    const std::string tif = geotiff("Float32");
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(file_answer(request, tif, "\"1\""));
    });
    const Outcome dry = run(server.address(), {"--dry-run"});
    EXPECT_TRUE(says(dry.out, "API_Key={key}")) << dry.out << dry.err;
    const Outcome outcome = run(server.address(), {"--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_EQ(server.requests().size(), 1U);
    EXPECT_EQ(server.requests()[0].path, std::string("/API?south=46&north=47&west=8&east=9&API_Key=") + key);
    EXPECT_EQ(server.requests()[0].headers.count("referer"), 0U);
    EXPECT_EQ(bytes_of(tiles_ / "N46E008.tif"), tif);
    const Outcome picture = run_orograph({"shot", tiles_.string(), "--at", "46.5,8.5", "--above", "500",
                                          "--size", "64x48", "--out", (folder_ / "shot.png").string()},
                                         plain({std::string("TEST_API_KEY=") + key}));
    EXPECT_EQ(picture.exit_code, 0) << picture.err;
    EXPECT_FALSE(says(bytes_of(folder_ / "shot.png"), key));
}

// A command by itself gets a GeoTIFF, and draws from it at once.
TEST_F(FetchSources, AGeoTiffIsReadAsSoonAsItHasCome) {
    const std::string tif = geotiff("Float32");
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(file_answer(request, tif, "\"1\""));
    });
    write_table(
        {{"url", server.address() + "/{latitude}{longitude}.tif"}, {"file", "{latitude}{longitude}.tif"}});
    fs::create_directories(folder_ / "settings" / "orograph");
    fs::rename(folder_ / "table.json", folder_ / "settings" / "orograph" / "sources.json");
    const Circumstances circumstances = plain({"XDG_CONFIG_HOME=" + (folder_ / "settings").string(),
                                               "OROGRAPH_CACHE=" + (folder_ / "cache").string()});
    const Outcome outcome = run_orograph(
        {"sight", "--fetch", "test", "--fetch-km", "2", "--from", "46.5,8.5", "--to", "46.51,8.5", "--json"},
        circumstances);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["visible"], true);
    EXPECT_EQ(names_in(folder_ / "cache" / "fetched" / "test"), (Words{"N46E008.tif", "N46E008.tif.used"}));
}

// From a file that the user alone may read, and from the folder of settings.
TEST_F(FetchWithKey, ComesFromAFile) {
    const std::string tif = geotiff("Float32");
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(says(request.path, key) ? file_answer(request, tif, "\"1\"")
                                     : http_answer("401 Unauthorized", "", ""));
    });
    const fs::path file = folder_ / "key";
    write_bytes(file, std::string(key) + "\n");
    fs::permissions(file, fs::perms::owner_read | fs::perms::others_read);
    const Outcome open = run(server.address(), {"--key-file", file.string()}, plain());
    expect_refusal(open, oro::test::failed,
                   {"key: may be read by others: make it yours alone with chmod 600"});
    fs::permissions(file, fs::perms::owner_read);
    const Outcome outcome = run(server.address(), {"--key-file", file.string()}, plain());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    fs::remove_all(tiles_);
    fs::create_directories(folder_ / "settings" / "orograph" / "keys");
    fs::rename(file, folder_ / "settings" / "orograph" / "keys" / "test");
    fs::create_directories(tiles_);
    const Outcome own = run_orograph(words(layout(server.address()), {"--tile", "N46E008"}),
                                     plain({"XDG_CONFIG_HOME=" + (folder_ / "settings").string()}));
    EXPECT_EQ(own.exit_code, 0) << own.err;
    EXPECT_FALSE(says(own.out + own.err, key));
}

TEST_F(FetchWithKey, FaultsDoNotTellIt) {
    std::string answer;
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        // What servers echo.
        std::string all = answer;
        if (const auto at = all.find("PATH"); at != std::string::npos) all.replace(at, 4, request.path);
        send(all);
    });
    const auto says_of = [&](const std::string& of_server, const std::string& what) {
        answer = of_server;
        const Outcome outcome = run(server.address());
        EXPECT_EQ(outcome.exit_code, oro::test::failed);
        EXPECT_TRUE(says(outcome.err, "API_Key={key}: " + what)) << outcome.err;
    };
    says_of(http_answer("401 Unauthorized", "", "PATH"), "the server answers 401: it does not take the key");
    says_of(http_answer("500 Internal Server Error", "", "PATH"), "the server answers 500");
    says_of(http_answer("200 OK", "", "<error>PATH</error>"), "is no GeoTIFF: it is a page of the web");
    says_of(http_answer("302 Found", "Location: PATH\r\n", ""), "Maximum (5) redirects followed");
    says_of(http_answer("302 Found", "Location: ftp://127.0.0.1PATH\r\n", ""), "");
    // Half of a file, with an ETag: its part stays, with the address that it is of.
    std::string half = http_answer("200 OK", "ETag: \"1\"\r\n", std::string(100000, 'x'));
    half.resize(50000);
    says_of(half, "");
    EXPECT_EQ(names_in(tiles_), (Words{"N46E008.tif.part", "N46E008.tif.part-etag"}));
    const Outcome nobody = run("http://127.0.0.1:1");
    EXPECT_EQ(nobody.exit_code, oro::test::failed);
}

// What others on the machine see of a process, while the server is asked; and what it sees of the key's file.
TEST_F(FetchWithKey, IsNotInTheProcessList) {
    const std::string tif = geotiff("Float32");
    std::vector<std::string> seen;
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        for (const auto& process : fs::directory_iterator("/proc")) {
            std::ifstream stream(process.path() / "cmdline", std::ios::binary);
            std::ostringstream line;
            line << stream.rdbuf();
            if (!says(line.str(), (folder_ / "table.json").string())) continue;
            std::ifstream variables(process.path() / "environ", std::ios::binary);
            line << variables.rdbuf();
            seen.push_back(line.str());
        }
        send(file_answer(request, tif, "\"1\""));
    });
    const fs::path file = folder_ / "key";
    write_bytes(file, std::string(key) + "\n");
    fs::permissions(file, fs::perms::owner_read);
    const Outcome outcome = run(server.address(), {"--key-file", file.string()}, plain());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_GE(seen.size(), 1U);
    for (const std::string& process : seen) EXPECT_FALSE(says(process, key)) << process;
}

// What other commands fetch for themselves: not in what they say, in the cache, in pictures and what lies
// beside them, in the record of a list.
TEST_F(FetchWithKey, StaysOutOfTheCacheAndOfPictures) {
    const std::string tif = geotiff("Float32");
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(file_answer(request, tif, "\"1\""));
    });
    const fs::path settings = folder_ / "settings" / "orograph", out = folder_ / "out";
    fs::create_directories(settings / "keys");
    fs::create_directories(out);
    write_table(layout(server.address()));
    fs::rename(folder_ / "table.json", settings / "sources.json");
    write_bytes(settings / "keys" / "test", std::string(key) + "\n");
    fs::permissions(settings / "keys" / "test", fs::perms::owner_read);
    const Circumstances circumstances = plain({"XDG_CONFIG_HOME=" + (folder_ / "settings").string(),
                                               "OROGRAPH_CACHE=" + (folder_ / "cache").string()});
    const nlohmann::json job{{"command", "shot"},  {"fetch", "test"},
                             {"fetch_km", 2},      {"at", {46.5, 8.5}},
                             {"above", 500},       {"size", {64, 48}},
                             {"style", "default"}, {"layers", true},
                             {"json", true},       {"out", (out / "shot.png").string()}};
    write_bytes(out / "jobs.jsonl", job.dump() + "\n");
    const Outcome outcome = run_orograph({"batch", (out / "jobs.jsonl").string(), "--json"}, circumstances);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    ASSERT_FALSE(server.requests().empty());
    EXPECT_TRUE(says(server.requests()[0].path, key));
    EXPECT_TRUE(fs::exists(out / "shot.png") && fs::exists(out / "jobs.jsonl.done"));
    EXPECT_FALSE(says(outcome.out + outcome.err, key)) << outcome.out << outcome.err;
    int files = 0;
    for (const fs::path& folder : {out, folder_ / "cache"})
        for (const auto& place : fs::recursive_directory_iterator(folder)) {
            EXPECT_FALSE(says(place.path().string(), key)) << place.path();
            if (!place.is_regular_file()) continue;
            EXPECT_FALSE(says(bytes_of(place.path()), key)) << place.path();
            ++files;
        }
    EXPECT_GE(files, 5);
}

TEST_F(FetchWithKey, WhatIsWrongIsSaidInOneLine) {
    expect_refusal(run("http://127.0.0.1:1", {}, plain()), oro::test::usage,
                   {"--source test: needs a key of your own: ", "--key-file", "TEST_API_KEY"});
    expect_refusal(run("http://127.0.0.1:1", {}, plain({std::string("TEST_API_KEY=") + key + " " + key})),
                   oro::test::failed, {"TEST_API_KEY: holds no key"});
    expect_refusal(run("http://example.org"), oro::test::failed,
                   {"'url' must begin with https://, for it has a key"});
}

}  // namespace

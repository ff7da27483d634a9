// Files from a server that does everything wrong that servers do. Nothing here leaves the machine.
#include "geo/fetch/fetch_file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "tests/support/loopback_server.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::Error;
using oro::ErrorKind;
using oro::fetch_file;
using oro::FetchedFile;
using oro::FetchLimits;
using oro::Result;
using oro::test::file_answer;
using oro::test::http_answer;
using oro::test::LoopbackRequest;
using oro::test::LoopbackSend;
using oro::test::LoopbackServer;

const std::string etag = "\"one\"";

// 300,000 bytes by chance, always the same.
std::string chance_bytes(unsigned seed = 54) {
    std::mt19937 random(seed);
    std::string bytes(300000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random() & 0xffU);
    return bytes;
}

std::string bytes_in(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

FetchLimits quick(int retries = 3) {
    FetchLimits limits;
    limits.retries = retries;
    limits.first_wait_s = 0.01;
    limits.most_wait_s = 2.0;
    limits.transfer.stall_s = 1.0;
    limits.transfer.most_bytes = 1000000;
    return limits;
}

// One file of one server.
class FetchFile : public testing::Test {
  protected:
    // A proxy of the machine is not asked for its loopback address.
    static void SetUpTestSuite() { setenv("no_proxy", "127.0.0.1", 1); }
    Result<FetchedFile> fetch(const LoopbackServer& server, const FetchLimits& limits = quick()) {
        return fetch_file(server.address() + "/tile", file_.string(), limits, [&](const std::string& part) {
            return bytes_in(part) == wanted_ ? Result<void>{}
                                             : Result<void>{Error{ErrorKind::failed, "tile", "is another"}};
        });
    }
    // Fetched whole, in so many requests, and nothing is left beside it.
    void expect_fetched(const LoopbackServer& server, int requests) {
        const Result<FetchedFile> fetched = fetch(server);
        ASSERT_TRUE(fetched.ok()) << fetched.error().line();
        EXPECT_TRUE(fetched->is_there);
        EXPECT_EQ(fetched->bytes, wanted_.size());
        EXPECT_EQ(fetched->requests, requests);
        EXPECT_EQ(bytes_in(file_), wanted_);
        expect_alone(1);
    }
    // The one line of what failed; nothing has the file's name.
    std::string fault(const LoopbackServer& server, const FetchLimits& limits = quick()) {
        const Result<FetchedFile> fetched = fetch(server, limits);
        EXPECT_FALSE(fetched.ok());
        EXPECT_FALSE(fs::exists(file_));
        return fetched.ok() ? "" : fetched.error().line();
    }
    void expect_alone(std::ptrdiff_t files) const {
        EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), files);
    }

    fs::path folder_{oro::test::scratch_folder()};
    fs::path file_{folder_ / "tile"};
    std::string wanted_{chance_bytes()};
};

bool says(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

TEST_F(FetchFile, WritesItWhole) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(file_answer(request, wanted_, etag));
    });
    expect_fetched(server, 1);
}

// A server that breaks off after 100,000 bytes, then after as many more: three requests, each for the rest.
TEST_F(FetchFile, GoesOnWhereItWasTruncated) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        const std::string answer = file_answer(request, wanted_, etag);
        const std::size_t body = answer.find("\r\n\r\n") + 4;
        send(request.number < 2 ? answer.substr(0, body + 100000) : answer);
    });
    expect_fetched(server, 3);
    const auto requests = server.requests();
    ASSERT_EQ(requests.size(), 3U);
    EXPECT_EQ(requests[0].headers.count("range"), 0U);
    EXPECT_EQ(requests[1].headers.at("range"), "bytes=100000-");
    EXPECT_EQ(requests[1].headers.at("if-range"), etag);
    EXPECT_EQ(requests[2].headers.at("range"), "bytes=200000-");
}

// What one run leaves, the next goes on with: as after a kill, which leaves the same.
TEST_F(FetchFile, GoesOnWithWhatAnEarlierRunLeft) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        const std::string answer = file_answer(request, wanted_, etag);
        send(request.number == 0 ? answer.substr(0, answer.size() - 50000) : answer);
    });
    EXPECT_NE(fault(server, quick(0)), "");
    EXPECT_EQ(bytes_in(folder_ / "tile.part"), wanted_.substr(0, 250000));
    expect_fetched(server, 1);
    EXPECT_EQ(server.requests()[1].headers.at("range"), "bytes=250000-");
}

// The server has a new version when the rest is asked for: nothing of the old one is in the file.
TEST_F(FetchFile, StartsAgainWhenTheFileChanged) {
    const std::string before = chance_bytes(55);
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        const bool first = request.number == 0;
        const std::string answer = file_answer(request, first ? before : wanted_, first ? etag : "\"two\"");
        send(first ? answer.substr(0, answer.size() - 50000) : answer);
    });
    expect_fetched(server, 2);
}

// It sends a rest of another version with the old ETag: what was put together is no tile, and is asked for
// anew.
TEST_F(FetchFile, AsksAnewWhenThePartsDoNotFit) {
    const std::string before = chance_bytes(55);
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        const std::string answer = file_answer(request, request.number == 0 ? before : wanted_, etag);
        send(request.number == 0 ? answer.substr(0, answer.size() - 50000) : answer);
    });
    expect_fetched(server, 3);
}

// All of it instead of the rest; a rest from elsewhere; no such range.
TEST_F(FetchFile, StartsAgainWhenRangesAreRefused) {
    for (const int way : {0, 1, 2}) {
        fs::remove(file_);
        const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
            const std::string whole = http_answer("200 OK", "ETag: " + etag + "\r\n", wanted_);
            if (request.number == 0) {
                send(whole.substr(0, whole.size() - 50000));
            } else if (request.number > 1 || way == 0) {
                send(whole);
            } else if (way == 1) {
                send(http_answer("206 Partial Content", "Content-Range: bytes 7-9/300000\r\n", "abc"));
            } else {
                send(http_answer("416 Range Not Satisfiable", "", ""));
            }
        });
        expect_fetched(server, way == 0 ? 2 : 3);
    }
}

// Without a strong ETag nobody knows whether the rest is of the same file.
TEST_F(FetchFile, StartsAgainWithoutAStrongETag) {
    for (const char* tag : {"", "ETag: W/\"one\"\r\n"}) {
        fs::remove(file_);
        const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
            const std::string whole = http_answer("200 OK", tag, wanted_);
            send(request.number == 0 ? whole.substr(0, whole.size() - 50000) : whole);
        });
        expect_fetched(server, 2);
        EXPECT_EQ(server.requests()[1].headers.count("range"), 0U);
    }
}

TEST_F(FetchFile, NoSuchFileIsNoError) {
    const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend& send) {
        send(http_answer("404 Not Found", "", "<html>no</html>"));
    });
    const Result<FetchedFile> fetched = fetch(server);
    ASSERT_TRUE(fetched.ok()) << fetched.error().line();
    EXPECT_FALSE(fetched->is_there);
    EXPECT_EQ(fetched->requests, 1);
    expect_alone(0);
}

TEST_F(FetchFile, ForbiddenIsAnErrorAtOnce) {
    const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend& send) {
        send(http_answer("403 Forbidden", "", "<Error/>"));
    });
    EXPECT_EQ(fault(server),
              server.address() + "/tile: the server answers 403: it does not give this file to everybody");
    EXPECT_EQ(server.requests().size(), 1U);
    expect_alone(0);
}

TEST_F(FetchFile, TriesAgainAfterErrorsOfTheServer) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        const char* const status[] = {"500 Internal Server Error", "503 Service Unavailable"};
        send(request.number < 2 ? http_answer(status[request.number], "", "busy")
                                : file_answer(request, wanted_, etag));
    });
    expect_fetched(server, 3);
}

TEST_F(FetchFile, GivesUpAfterAllRetries) {
    const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend& send) {
        send(http_answer("502 Bad Gateway", "", ""));
    });
    EXPECT_TRUE(says(fault(server, quick(2)), "/tile: the server answers 502 (after 3 requests)"));
    EXPECT_EQ(server.requests().size(), 3U);
}

// It asks for a second, and would have waited 0.01 s.
TEST_F(FetchFile, WaitsAsLongAsTheServerAsks) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(request.number == 0 ? http_answer("429 Too Many Requests", "Retry-After: 1\r\n", "")
                                 : file_answer(request, wanted_, etag));
    });
    const auto start = std::chrono::steady_clock::now();
    expect_fetched(server, 2);
    EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(1000));
}

TEST_F(FetchFile, DoesNotWaitForHours) {
    const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend& send) {
        send(http_answer("429 Too Many Requests", "Retry-After: 3600\r\n", ""));
    });
    EXPECT_TRUE(says(fault(server), "it asks to wait 3600 s, and at most 2 s are waited"));
    EXPECT_EQ(server.requests().size(), 1U);
}

// 10 bytes, then silence: given up after stall_s, and gone on with.
TEST_F(FetchFile, GivesUpOnAServerThatFallsSilent) {
    const LoopbackServer* ending = nullptr;
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        const std::string answer = file_answer(request, wanted_, etag);
        if (request.number > 0) {
            send(answer);
            return;
        }
        send(answer.substr(0, answer.find("\r\n\r\n") + 14));
        for (int i = 0; i < 40 && !ending->is_ending(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
    });
    ending = &server;
    expect_fetched(server, 2);
    EXPECT_EQ(server.requests()[1].headers.at("range"), "bytes=10-");
}

// 300,000 bytes in 1.5 s, longer than stall_s: waited for, in one request.
TEST_F(FetchFile, WaitsForASlowServer) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        const std::string answer = file_answer(request, wanted_, etag);
        const std::size_t piece = answer.size() / 15 + 1;
        for (std::size_t at = 0; at < answer.size(); at += piece) {
            if (!send(answer.substr(at, piece))) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
    });
    expect_fetched(server, 1);
}

// A byte each 50 ms, for hours: less than slowest_bytes_per_s, and given up.
TEST_F(FetchFile, GivesUpOnAServerThatDrips) {
    const LoopbackServer* ending = nullptr;
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        for (const char byte : file_answer(request, wanted_, etag)) {
            if (ending->is_ending() || !send(std::string(1, byte))) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    });
    ending = &server;
    EXPECT_TRUE(says(fault(server, quick(0)), "/tile: "));
    EXPECT_EQ(server.requests().size(), 1U);
}

TEST_F(FetchFile, FollowsRedirectsAndNoCircle) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(request.path == "/tile" ? http_answer("302 Found", "Location: /other\r\n", "")
                                     : file_answer(request, wanted_, etag));
    });
    expect_fetched(server, 1);
    fs::remove(file_);
    const LoopbackServer circle([](const LoopbackRequest&, const LoopbackSend& send) {
        send(http_answer("302 Found", "Location: /tile\r\n", ""));
    });
    EXPECT_TRUE(says(fault(circle), "Maximum (5) redirects followed"));
    EXPECT_EQ(circle.requests().size(), 6U);
}

// file:, ftp: and others are not followed.
TEST_F(FetchFile, FollowsToHttpAlone) {
    std::ofstream(folder_ / "secret") << "secret";
    for (const std::string& to :
         {"file://" + (folder_ / "secret").string(), std::string("gopher://127.0.0.1/")}) {
        const LoopbackServer server([&](const LoopbackRequest&, const LoopbackSend& send) {
            send(http_answer("302 Found", "Location: " + to + "\r\n", ""));
        });
        EXPECT_NE(fault(server), "");
        EXPECT_EQ(server.requests().size(), 1U);
    }
    expect_alone(1);
}

// By what it says, and, where it says nothing, by what it sends.
TEST_F(FetchFile, RefusesFilesThatAreTooLarge) {
    FetchLimits limits = quick();
    limits.transfer.most_bytes = 299999;
    const LoopbackServer says_so([&](const LoopbackRequest& request, const LoopbackSend& send) {
        send(file_answer(request, wanted_, etag));
    });
    EXPECT_TRUE(says(fault(says_so, limits), "the file is larger than 299999 bytes"));
    EXPECT_EQ(says_so.requests().size(), 1U);
    const LoopbackServer endless([&](const LoopbackRequest&, const LoopbackSend& send) {
        send("HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n");
        while (send("4000\r\n" + std::string(0x4000, 'x') + "\r\n")) {
        }
    });
    EXPECT_TRUE(says(fault(endless, limits), "the file is larger than 299999 bytes"));
    expect_alone(0);
}

// Whether all has come cannot be known: HTTP/1 that ends with the connection, and a chunk that is cut.
TEST_F(FetchFile, RefusesWhatHasNoEnd) {
    const LoopbackServer open_end([&](const LoopbackRequest&, const LoopbackSend& send) {
        send("HTTP/1.1 200 OK\r\nConnection: close\r\n\r\n" + wanted_);
    });
    EXPECT_TRUE(says(fault(open_end), "the server does not say where the file ends"));
    const LoopbackServer cut([&](const LoopbackRequest&, const LoopbackSend& send) {
        send("HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n4000\r\nabc");
    });
    EXPECT_NE(fault(cut, quick(1)), "");
    EXPECT_EQ(cut.requests().size(), 2U);
    expect_alone(0);
}

TEST_F(FetchFile, WhatIsAnotherFileIsRemoved) {
    const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend& send) {
        send(http_answer("200 OK", "Content-Type: text/html\r\nETag: \"x\"\r\n", "<html>log in</html>"));
    });
    EXPECT_EQ(fault(server), "tile: is another");
    EXPECT_EQ(server.requests().size(), 1U);
    expect_alone(0);
}

TEST_F(FetchFile, NobodyListens) {
    std::string address;
    {
        const LoopbackServer server([](const LoopbackRequest&, const LoopbackSend&) {});
        address = server.address();
    }
    const Result<FetchedFile> fetched = fetch_file(address + "/tile", file_.string(), quick(1),
                                                   [](const std::string&) { return Result<void>{}; });
    ASSERT_FALSE(fetched.ok());
    EXPECT_TRUE(says(fetched.error().line(), "(after 2 requests)")) << fetched.error().line();
    expect_alone(0);
}

// The name was taken while the file came: what has it stays.
TEST_F(FetchFile, ReplacesNothing) {
    const LoopbackServer server([&](const LoopbackRequest& request, const LoopbackSend& send) {
        std::ofstream(file_) << "mine";
        send(file_answer(request, wanted_, etag));
    });
    EXPECT_FALSE(fetch(server).ok());
    EXPECT_EQ(bytes_in(file_), "mine");
}

}  // namespace

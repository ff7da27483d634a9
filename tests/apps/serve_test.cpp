// orograph serve, as browsers and as strangers ask it.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <thread>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/served_program.h"

namespace {
namespace fs = std::filesystem;

using oro::test::body_of;
using oro::test::folder_to_serve;
using oro::test::Served;
using oro::test::status_of;

TEST(Serve, GivesFilesAndRanges) {
    const fs::path folder = folder_to_serve();
    const Served served(folder);
    EXPECT_TRUE(served.line.starts_with("serving " + folder.string() + " at http://127.0.0.1:"))
        << served.line;
    const std::string tiles = served.get("/tiles.json");
    EXPECT_EQ(status_of(tiles), 200) << tiles;
    EXPECT_EQ(body_of(tiles), R"({"tilejson": "3.0.0"})");
    EXPECT_NE(tiles.find("Content-Type: application/json\r\n"), std::string::npos) << tiles;
    EXPECT_EQ(tiles.find("Access-Control"), std::string::npos) << tiles;
    const std::string part = served.get("/5/16/11.png", "Range: bytes=2-4\r\n");
    EXPECT_EQ(status_of(part), 206) << part;
    EXPECT_EQ(body_of(part), "234");
    EXPECT_NE(part.find("Content-Range: bytes 2-4/10\r\n"), std::string::npos) << part;
    EXPECT_EQ(body_of(served.get("/5/16/11.png", "Range: bytes=-3\r\n")), "789");
    EXPECT_EQ(status_of(served.get("/5/16/11.png", "Range: bytes=90-99\r\n")), 416);
    EXPECT_EQ(status_of(served.get("/5/16/11.png", "Range: bytes=-0\r\n")), 416) << "RFC 9110, 14.1.2";
    const std::string head = served.get("/5/16/11.png", "", "HEAD");
    EXPECT_EQ(status_of(head), 200) << head;
    EXPECT_NE(head.find("Content-Length: 10\r\n"), std::string::npos) << head;
    EXPECT_EQ(body_of(head), "");
    EXPECT_EQ(status_of(served.get("/empty.json")), 200);
    EXPECT_EQ(status_of(served.get("/inner.json")), 200) << "a link within the folder";
    const std::string list = served.get("/5/");
    EXPECT_NE(list.find("<a href=\"./%3Cb%3E%20%26%20c.txt\">&lt;b&gt; &amp; c.txt</a>"), std::string::npos)
        << list;
    EXPECT_EQ(body_of(served.get("/5/%3Cb%3E%20%26%20c.txt")), "text");
    EXPECT_EQ(body_of(served.get("/")).find(".key"), std::string::npos);
}

TEST(Serve, NothingOutsideTheFolderIsGiven) {
    const Served served(folder_to_serve());
    for (const char* const address : {"/../secret.txt",
                                      "/%2e%2e/secret.txt",
                                      "/5/..%2f..%2fsecret.txt",
                                      "/5/../../secret.txt",
                                      "//etc/passwd",
                                      "/%2fetc/passwd",
                                      "/..%5csecret.txt",
                                      "/link.txt",
                                      "/up/secret.txt",
                                      "/up/",
                                      "/.key",
                                      "/tiles.json%00.png",
                                      "/%252e%252e/secret.txt",
                                      "/5/./16/11.png/../../../../secret.txt",
                                      "http://localhost/../secret.txt",
                                      "/nothing",
                                      "/%",
                                      "/%zz",
                                      "/\x01",
                                      "/5/16/11.png/"}) {
        const std::string answer = served.get(address);
        EXPECT_NE(status_of(answer), 200) << address << "\n" << answer;
        EXPECT_EQ(answer.find("SECRET"), std::string::npos) << address;
        EXPECT_EQ(answer.find("root:"), std::string::npos) << address;
    }
    for (const char* const method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS"})
        EXPECT_NE(status_of(served.get("/tiles.json", "", method)), 200) << method;
    EXPECT_EQ(status_of(served.answer(
                  "GET /tiles.json HTTP/1.1\r\nHost: elsewhere.example\r\nConnection: close\r\n\r\n")),
              403)
        << "a name of somebody else's that leads here";
    EXPECT_EQ(
        status_of(served.answer("GET /tiles.json HTTP/1.1\r\nHost: 127.elsewhere.example:8080\r\nConnection: "
                                "close\r\n\r\n")),
        403)
        << "one that looks like an address";
    EXPECT_EQ(status_of(served.answer("GET /tiles.json HTTP/1.1\r\nHost: 127.0.0.1:8080\r\nConnection: "
                                      "close\r\n\r\n")),
              200);
    EXPECT_EQ(status_of(served.get("/tiles.json")), 200) << "after all of that";
}

TEST(Serve, OutlivesHostileAndSlowClients) {
    const Served served(folder_to_serve());
    const std::string begin = "GET /tiles.json HTTP/1.1\r\nHost: localhost\r\n";
    EXPECT_NE(status_of(served.answer(begin + "X: " + std::string(1U << 20U, 'x') + "\r\n\r\n")), 200);
    EXPECT_NE(status_of(served.get("/" + std::string(1U << 20U, 'a'))), 200);
    EXPECT_NE(status_of(served.get("/" + std::string(8000, '/'))), 0);
    EXPECT_NE(status_of(served.get("/tiles.json", "Range: bytes=5-2,,-,1-\r\n")), 0);
    for (const std::string& bytes :
         {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string(1000, '\0'),
          std::string("GET /tiles.json HTTP/9.9\r\n\r\n")}) {
        const int client = served.connection();
        send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        close(client);
    }
    std::vector<int> slow;
    for (int i = 0; i < 60; ++i) {
        slow.push_back(served.connection());
        send(slow.back(), begin.data(), 10, MSG_NOSIGNAL);
    }
    std::vector<std::thread> clients;
    std::vector<int> statuses(140);
    for (int& status : statuses)
        clients.emplace_back([&served, &status] { status = status_of(served.get("/5/16/11.png")); });
    for (std::thread& client : clients) client.join();
    EXPECT_EQ(statuses, std::vector<int>(140, 200));
    for (const int client : slow) close(client);
    EXPECT_EQ(status_of(served.get("/tiles.json")), 200) << "after all of that";
}

TEST(Serve, WhatCannotBeServedEndsInOneLine) {
    using oro::test::run_orograph;
    const fs::path folder = folder_to_serve();
    const auto none = run_orograph({"serve", (folder / "none").string()});
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_NE(none.err.find("none: No such file or directory\n"), std::string::npos) << none.err;
    const auto file = run_orograph({"serve", (folder / "tiles.json").string()});
    EXPECT_EQ(file.exit_code, 1);
    EXPECT_NE(file.err.find("tiles.json: is no folder\n"), std::string::npos) << file.err;
    const auto port = run_orograph({"serve", folder.string(), "--port", "70000"});
    EXPECT_EQ(port.exit_code, 2) << port.err;
    const auto host = run_orograph({"serve", folder.string(), "--port", "0", "--host", "203.0.113.1"});
    EXPECT_EQ(host.exit_code, 1) << host.err;
    EXPECT_NE(host.err.find("cannot be listened at"), std::string::npos) << host.err;
}

}  // namespace

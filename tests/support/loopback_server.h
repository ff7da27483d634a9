// A server on the loopback address that answers as a test wants it to: rightly, wrongly, slowly or not at
// all.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace oro::test {

struct LoopbackRequest {
    std::string method;                          // "GET"
    std::string path;                            // "/N46/N46E008.hgt.gz"
    std::map<std::string, std::string> headers;  // names in lower case
    std::string body;                            // as long as Content-Length says
    int number{};                                // of this path: 0, 1, ...
};

// Sends bytes as they are; false when the client has gone.
using LoopbackSend = std::function<bool(const std::string& bytes)>;
// Answers a request; the connection is closed after it. Called from a thread of its own.
using LoopbackAnswer = std::function<void(const LoopbackRequest& request, const LoopbackSend& send)>;

class LoopbackServer {
  public:
    explicit LoopbackServer(LoopbackAnswer answer);
    // Ends after the answers that are being given.
    ~LoopbackServer();
    LoopbackServer(const LoopbackServer&) = delete;
    LoopbackServer& operator=(const LoopbackServer&) = delete;

    // "http://127.0.0.1:40123"
    [[nodiscard]] std::string address() const;
    // What was asked so far.
    [[nodiscard]] std::vector<LoopbackRequest> requests() const;
    // True once the server is to end: for answers that take their time.
    [[nodiscard]] bool is_ending() const { return is_ending_; }

  private:
    void accept_all();
    void serve(int connection);

    LoopbackAnswer answer_;
    int listening_{-1};
    int port_{};
    std::atomic<bool> is_ending_{false};
    mutable std::mutex mutex_;
    std::vector<LoopbackRequest> requests_;
    std::vector<std::jthread> serving_;
    std::jthread accepting_;
};

// An answer: "200 OK", headers each ending in \r\n, the body with its Content-Length.
std::string http_answer(const std::string& status, const std::string& headers, const std::string& body);

// What a good server does with a file: all of it, or the part that Range asks for where If-Range names the
// ETag.
std::string file_answer(const LoopbackRequest& request, const std::string& body, const std::string& etag);

}  // namespace oro::test

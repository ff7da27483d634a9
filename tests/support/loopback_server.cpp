#include "tests/support/loopback_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace oro::test {
namespace {

// Until its empty line.
std::string head_from(int connection) {
    std::string head;
    char byte = 0;
    while (head.size() < 65536 && !head.ends_with("\r\n\r\n") && recv(connection, &byte, 1, 0) == 1)
        head += byte;
    return head;
}

LoopbackRequest request_from(const std::string& head) {
    LoopbackRequest request;
    std::istringstream lines(head);
    std::string line;
    std::getline(lines, line);
    const std::size_t begin = line.find(' ');
    request.method = line.substr(0, begin);
    if (begin != std::string::npos)
        request.path = line.substr(begin + 1, line.find(' ', begin + 1) - begin - 1);
    while (std::getline(lines, line)) {
        const std::size_t colon = line.find(": ");
        if (colon == std::string::npos) continue;
        std::string name = line.substr(0, colon);
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
        request.headers[name] = line.substr(colon + 2, line.size() - colon - 3);
    }
    return request;
}

bool send_all(int connection, const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
        const ssize_t count = ::send(connection, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (count <= 0) return false;
        sent += static_cast<std::size_t>(count);
    }
    return true;
}

// What a client wants to send it may wait with until it is told to.
std::string body_from(int connection, const LoopbackRequest& request) {
    const auto length = request.headers.find("content-length");
    if (length == request.headers.end()) return {};
    if (request.headers.contains("expect")) send_all(connection, "HTTP/1.1 100 Continue\r\n\r\n");
    std::string body(std::strtoull(length->second.c_str(), nullptr, 10), '\0');
    for (std::size_t at = 0; at < body.size();) {
        const ssize_t count = recv(connection, body.data() + at, body.size() - at, 0);
        if (count <= 0) return body.substr(0, at);
        at += static_cast<std::size_t>(count);
    }
    return body;
}

}  // namespace

LoopbackServer::LoopbackServer(LoopbackAnswer answer) : answer_(std::move(answer)) {
    listening_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const plain = reinterpret_cast<sockaddr*>(&address);
    if (listening_ < 0 || bind(listening_, plain, size) != 0 || listen(listening_, 64) != 0 ||
        getsockname(listening_, plain, &size) != 0)
        std::abort();
    port_ = ntohs(address.sin_port);
    accepting_ = std::jthread([this] { accept_all(); });
}

LoopbackServer::~LoopbackServer() {
    is_ending_ = true;
    accepting_.join();
    serving_.clear();
    close(listening_);
}

std::string LoopbackServer::address() const {
    return "http://127.0.0.1:" + std::to_string(port_);
}

std::vector<LoopbackRequest> LoopbackServer::requests() const {
    const std::lock_guard lock(mutex_);
    return requests_;
}

void LoopbackServer::accept_all() {
    while (!is_ending_) {
        pollfd ready{listening_, POLLIN, 0};
        if (poll(&ready, 1, 20) <= 0) continue;
        const int connection = accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
        if (connection >= 0) serving_.emplace_back([this, connection] { serve(connection); });
    }
}

void LoopbackServer::serve(int connection) {
    LoopbackRequest request = request_from(head_from(connection));
    request.body = body_from(connection, request);
    {
        const std::lock_guard lock(mutex_);
        request.number = static_cast<int>(
            std::ranges::count_if(requests_, [&](const auto& one) { return one.path == request.path; }));
        requests_.push_back(request);
    }
    answer_(request, [&](const std::string& bytes) { return send_all(connection, bytes); });
    shutdown(connection, SHUT_WR);
    // What the client still sends is read, so that closing resets nothing.
    char rest[256];
    pollfd ready{connection, POLLIN, 0};
    while (poll(&ready, 1, 200) > 0 && recv(connection, rest, sizeof rest, 0) > 0) {
    }
    close(connection);
}

std::string http_answer(const std::string& status, const std::string& headers, const std::string& body) {
    return "HTTP/1.1 " + status + "\r\nConnection: close\r\n" + headers +
           "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

std::string file_answer(const LoopbackRequest& request, const std::string& body, const std::string& etag) {
    const std::string headers = "ETag: " + etag + "\r\n";
    const auto range = request.headers.find("range"), condition = request.headers.find("if-range");
    if (range == request.headers.end() || condition == request.headers.end() || condition->second != etag)
        return http_answer("200 OK", headers, body);
    const std::size_t from = std::strtoull(range->second.c_str() + 6, nullptr, 10);  // "bytes=100-"
    if (from >= body.size()) return http_answer("416 Range Not Satisfiable", headers, "");
    return http_answer("206 Partial Content",
                       headers + "Content-Range: bytes " + std::to_string(from) + "-" +
                           std::to_string(body.size() - 1) + "/" + std::to_string(body.size()) + "\r\n",
                       body.substr(from));
}

}  // namespace oro::test

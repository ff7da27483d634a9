// orograph serve: a folder for browsers, read-only.
#include <httplib.h>

#include <arpa/inet.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/commands/commands.h"
#include "apps/commands/serve/served_folder.h"
#include "apps/options/serve_options.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"

namespace oro {
namespace {

// A client that is slow holds one of them, and so many may be: they are created at once.
constexpr std::size_t threads = 320;
// Of one request: more of them are no reader's, but ask for a file many times over.
constexpr std::size_t most_ranges = 16;

bool is_loopback(const std::string& host) {
    if (host == "localhost" || host == "::1" || host == "[::1]") return true;
    in_addr address{};  // 127.0.0.0/8, and no name that begins so
    return inet_pton(AF_INET, host.c_str(), &address) == 1 && ntohl(address.s_addr) >> 24U == 127U;
}

// What browsers name in "Host": a name that somebody else's server points to this machine is not served, or
// pages of others could read the folder (DNS rebinding).
bool names_this_machine(const httplib::Request& request) {
    std::string host = request.get_header_value("Host");
    const std::size_t colon = host.rfind(':');
    if (colon != std::string::npos && host.find(']', colon) == std::string::npos) host.resize(colon);
    return is_loopback(host);
}

void refuse(httplib::Response& response, int status, const char* words) {
    response.status = status;
    response.set_content(std::string(words) + "\n", "text/plain; charset=utf-8");
}

// Without words: the library would cut them into these ranges.
void refuse_ranges(httplib::Response& response, std::uintmax_t bytes) {
    response.status = 416;
    response.set_header("Content-Range", "bytes */" + std::to_string(bytes));
}

// A file of any size, read as it is sent; ranges are the library's.
void give_file(const std::filesystem::path& file, const httplib::Request& request,
               httplib::Response& response) {
    std::error_code problem;
    const std::uintmax_t bytes = std::filesystem::file_size(file, problem);
    const auto stream = std::make_shared<std::ifstream>(file, std::ios::binary);
    if (problem || !*stream) return refuse(response, 404, "there is no such file");
    if (request.ranges.size() > most_ranges) return refuse_ranges(response, bytes);
    // From a byte on that is not there, or the last 0 bytes: "-0" (RFC 9110, section 14.1.2).
    const auto holds_nothing = [&](const auto& range) {
        return range.first >= static_cast<std::int64_t>(bytes) || (range.first == -1 && range.second == 0);
    };
    if (std::ranges::any_of(request.ranges, holds_nothing)) return refuse_ranges(response, bytes);
    if (bytes == 0) return response.set_content("", media_type_of(file));
    response.set_content_provider(static_cast<std::size_t>(bytes), media_type_of(file),
                                  [stream](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                      std::vector<char> part(std::min<std::size_t>(length, 1U << 16U));
                                      stream->clear();
                                      stream->seekg(static_cast<std::streamoff>(offset));
                                      stream->read(part.data(), static_cast<std::streamsize>(part.size()));
                                      const std::streamsize count = stream->gcount();
                                      return count > 0 &&
                                             sink.write(part.data(), static_cast<std::size_t>(count));
                                  });
}

void answer(const ServedFolder& folder, bool local, const httplib::Request& request,
            httplib::Response& response) {
    if (local && !names_this_machine(request))
        return refuse(response, 403, "this folder is served to this machine alone");
    if (const auto file = folder.file_of(request.path)) return give_file(*file, request, response);
    if (const auto page = folder.listing_of(request.path)) {
        response.set_content(*page, "text/html; charset=utf-8");
        return;
    }
    refuse(response, 404, "there is no such file");
}

void set_up(httplib::Server& server, const ServedFolder& folder, const ServeOptions& options) {
    server.new_task_queue = [] { return new httplib::ThreadPool(threads); };
    server.set_read_timeout(5, 0);
    server.set_write_timeout(20, 0);
    server.set_payload_max_length(0);
    httplib::Headers headers{{"X-Content-Type-Options", "nosniff"}};
    if (options.any_origin) headers.emplace("Access-Control-Allow-Origin", "*");
    server.set_default_headers(std::move(headers));
    const bool local = is_loopback(options.host);
    // Before the library's own routes: those match addresses by std::regex, whose stack grows with the
    // address.
    server.set_pre_routing_handler(
        [&folder, local](const httplib::Request& request, httplib::Response& response) {
            if (request.method == "GET" || request.method == "HEAD") {
                answer(folder, local, request, response);
            } else {
                refuse(response, 405, "this folder is read-only");
                response.set_header("Connection", "close");
            }
            return httplib::Server::HandlerResponse::Handled;
        });
}

}  // namespace

Result<void> run_serve(const ServeOptions& options) {
    ORO_TRY(const ServedFolder folder, ServedFolder::of(options.folder));
    std::signal(SIGPIPE, SIG_IGN);  // a client that leaves ends its own connection alone
    httplib::Server server;
    set_up(server, folder, options);
    int port = options.port;
    errno = 0;
    const bool is_bound = port == 0 ? (port = server.bind_to_any_port(options.host)) > 0
                                    : server.bind_to_port(options.host, port);
    if (!is_bound)
        return Error{
            ErrorKind::failed, options.host + ":" + std::to_string(options.port),
            "cannot be listened at: " + (errno != 0 ? std::generic_category().message(errno)
                                                    : "the address is not this machine's, or is taken")};
    const std::string host =
        options.host.find(':') != std::string::npos ? "[" + options.host + "]" : options.host;
    std::printf("serving %s at http://%s:%d/ until Ctrl-C\n", one_line(folder.root().string()).c_str(),
                host.c_str(), port);
    std::fflush(stdout);
    if (!is_loopback(options.host)) say(options.quiet, "note: other machines can read this folder");
    if (!server.listen_after_bind())
        return Error{ErrorKind::failed, options.folder, "cannot be served any more"};
    return {};
}

}  // namespace oro

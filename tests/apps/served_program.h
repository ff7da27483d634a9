// The program as a server, and what strangers ask it.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/test_data.h"

namespace oro::test {

// The program, serving a folder at a free port until the test ends.
class Served {
  public:
    explicit Served(const std::filesystem::path& folder) {
        int ends[2];
        if (pipe(ends) != 0) return;
        process_ = fork();
        if (process_ == 0) {
            dup2(ends[1], STDOUT_FILENO);
            close(ends[0]);
            execl(OROGRAPH_PROGRAM, OROGRAPH_PROGRAM, "serve", folder.c_str(), "--port", "0", nullptr);
            _exit(127);
        }
        close(ends[1]);
        char c = 0;
        while (read(ends[0], &c, 1) == 1 && c != '\n') line += c;
        close(ends[0]);
        const std::size_t colon = line.rfind(':');
        if (colon != std::string::npos) port_ = std::atoi(line.c_str() + colon + 1);
    }
    ~Served() {
        kill(process_, SIGTERM);
        int status = 0;
        waitpid(process_, &status, 0);
    }
    Served(const Served&) = delete;
    Served& operator=(const Served&) = delete;

    // A connection; the test closes it.
    [[nodiscard]] int connection() const {
        const int client = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port_));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        return connect(client, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 ? client : -1;
    }
    // All that comes back for some bytes, until the other side closes, or nothing comes for so long.
    [[nodiscard]] std::string answer(const std::string& bytes, int patience_s = 30) const {
        const int client = connection();
        const timeval limit{patience_s, 0};
        setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        std::string all;
        std::size_t sent = 0;
        while (sent < bytes.size()) {
            const auto count = send(client, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (count <= 0) break;
            sent += static_cast<std::size_t>(count);
        }
        std::vector<char> part(1U << 16U);
        for (ssize_t count = 0; (count = recv(client, part.data(), part.size(), 0)) > 0;)
            all.append(part.data(), static_cast<std::size_t>(count));
        close(client);
        return all;
    }
    [[nodiscard]] std::string get(const std::string& address, const std::string& header = "",
                                  const std::string& method = "GET") const {
        return answer(method + " " + address + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" +
                      header + "\r\n");
    }

    std::string line{};

  private:
    pid_t process_{};
    int port_{};
};

inline int status_of(const std::string& answer) {
    int status = 0;
    return std::sscanf(answer.c_str(), "HTTP/1.1 %d", &status) == 1 ? status : 0;
}

inline std::string body_of(const std::string& answer) {
    const std::size_t end = answer.find("\r\n\r\n");
    return end == std::string::npos ? "" : answer.substr(end + 4);
}

// A folder with tiles, a secret beside it, links to that, and a name that is no good HTML.
inline std::filesystem::path folder_to_serve() {
    const std::filesystem::path top = scratch_folder();
    std::filesystem::create_directories(top / "served" / "5" / "16");
    std::ofstream(top / "secret.txt") << "SECRET";
    std::ofstream(top / "served" / "tiles.json") << R"({"tilejson": "3.0.0"})";
    std::ofstream(top / "served" / "5" / "16" / "11.png") << "0123456789";
    std::ofstream(top / "served" / "5" / "<b> & c.txt") << "text";
    std::ofstream(top / "served" / ".key") << "SECRET";
    std::ofstream(top / "served" / "empty.json");
    std::filesystem::create_symlink(top / "secret.txt", top / "served" / "link.txt");
    std::filesystem::create_directory_symlink(top, top / "served" / "up");
    std::filesystem::create_symlink("tiles.json", top / "served" / "inner.json");
    return top / "served";
}

}  // namespace oro::test

#include "apps/output/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>

#include "core/base/open_file.h"

extern char** environ;

namespace oro {
namespace {

// Ends of a pipe, closed with it.
class Pipe {
  public:
    Pipe() { is_open_ = pipe2(ends_.data(), O_CLOEXEC) == 0; }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        if (!is_open_) return;
        close(ends_[0]);
        close_input();
    }
    void close_input() {
        if (ends_[1] >= 0) close(ends_[1]);
        ends_[1] = -1;
    }
    [[nodiscard]] bool is_open() const { return is_open_; }
    [[nodiscard]] int output() const { return ends_[0]; }
    [[nodiscard]] int input() const { return ends_[1]; }

  private:
    std::array<int, 2> ends_{-1, -1};
    bool is_open_{};
};

// Begins a program whose output goes into a descriptor. Gives the system's fault, 0 for none.
int begin_program(const std::string& folder, std::vector<std::string>& words, int output, pid_t& child) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, output, STDERR_FILENO);
    if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
    // Signals that this program waits for in a thread of its own end the other one as they end any.
    posix_spawnattr_t how;
    posix_spawnattr_init(&how);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&how, &none);
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int fault = posix_spawn(&child, words[0].c_str(), &files, &how, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&how);
    return fault;
}

// What a program says, to its end: the last line of it.
std::string last_line_from(int descriptor, pid_t child, const ProgramWait& wait) {
    constexpr std::size_t longest = 4096;
    constexpr int turn_ms = 500;
    const bool is_watched = wait.each_turn || wait.stop.stop_possible();
    std::string said;
    std::array<char, 1024> part{};
    bool interrupted = false;
    while (true) {
        if (wait.stop.stop_requested() && !interrupted) interrupted = kill(child, SIGINT) == 0;
        pollfd ready{descriptor, POLLIN, 0};
        const int answers = poll(&ready, 1, is_watched ? turn_ms : -1);
        if (answers == 0 && wait.each_turn) wait.each_turn();
        if (answers == 0 || (answers < 0 && errno == EINTR)) continue;
        const ssize_t got = answers < 0 ? -1 : read(descriptor, part.data(), part.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        said.append(part.data(), static_cast<std::size_t>(got));
        if (said.size() > 2 * longest) said.erase(0, said.size() - longest);
    }
    while (!said.empty() && (said.back() == '\n' || said.back() == '\r')) said.pop_back();
    return said.substr(said.find_last_of("\r\n") + 1);
}

}  // namespace

Result<void> run_program(const std::string& folder, std::vector<std::string> words, const ProgramWait& wait) {
    const auto not_started = [&](int fault) {
        return Error{ErrorKind::failed, words[0], "cannot be started: " + system_reason(fault)};
    };
    Pipe pipe;
    if (!pipe.is_open()) return not_started(errno);
    pid_t child = 0;
    if (const int fault = begin_program(folder, words, pipe.input(), child); fault != 0)
        return not_started(fault);
    pipe.close_input();
    const std::string said = last_line_from(pipe.output(), child, wait);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    if (wait.stop.stop_requested()) return Error{ErrorKind::failed, words[0], "stopped"};
    const std::string end = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                                : "exit code " + std::to_string(WEXITSTATUS(status));
    return Error{ErrorKind::failed, words[0], "ended with " + end + (said.empty() ? "" : ": " + said)};
}

Result<std::string> own_program() {
    std::error_code fault;
    const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", fault);
    if (fault) return Error{ErrorKind::failed, "/proc/self/exe", "cannot be read: " + fault.message()};
    return path.string();
}

}  // namespace oro

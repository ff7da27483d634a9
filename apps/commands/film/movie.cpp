#include "apps/commands/film/movie.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/base/file_target.h"
#include "core/base/open_file.h"

extern char** environ;

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr const char* unnamed_movie = "film.mp4";

// What a program says, to its end: the last line of it.
std::string last_line_from(int descriptor) {
    constexpr std::size_t longest = 4096;
    std::string said;
    std::array<char, 1024> part{};
    for (ssize_t got = 0; (got = read(descriptor, part.data(), part.size())) != 0;) {
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) break;
        said.append(part.data(), static_cast<std::size_t>(got));
        if (said.size() > 2 * longest) said.erase(0, said.size() - longest);
    }
    while (!said.empty() && (said.back() == '\n' || said.back() == '\r')) said.pop_back();
    return said.substr(said.find_last_of("\r\n") + 1);
}

// Runs a program in a folder, its standard input closed. Errors: it cannot be started, or has failed.
Result<void> run_in(const std::string& folder, std::vector<std::string> words) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        return Error{ErrorKind::failed, words[0], "cannot be started: " + system_reason(errno)};
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
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
    pid_t child = 0;
    const int failed = posix_spawn(&child, words[0].c_str(), &files, &how, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&how);
    close(ends[1]);
    const std::string said = failed == 0 ? last_line_from(ends[0]) : "";
    close(ends[0]);
    if (failed != 0) return Error{ErrorKind::failed, words[0], "cannot be started: " + system_reason(failed)};
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    const std::string end = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                                : "exit code " + std::to_string(WEXITSTATUS(status));
    return Error{ErrorKind::failed, words[0], "ended with " + end + (said.empty() ? "" : ": " + said)};
}

}  // namespace

Result<std::string> ffmpeg_in_path(const std::string& out) {
    const char* const path = std::getenv("PATH");
    const std::string_view all(path != nullptr ? path : "");
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = std::min(all.find(':', begin), all.size());
        const fs::path program = fs::path(all.substr(begin, end - begin)) / "ffmpeg";
        std::error_code ignored;
        if (program.is_absolute() && fs::is_regular_file(program, ignored) &&
            access(program.c_str(), X_OK) == 0)
            return program.string();
        begin = end + 1;
    }
    return Error{
        ErrorKind::usage, "--out " + out,
        "needs ffmpeg, which is not in PATH: install it, or name a folder, into which the frames are "
        "drawn"};
}

Result<void> write_movie(const std::string& ffmpeg, const MovieFrames& frames, const std::string& out,
                         bool overwrite) {
    char rate[40];
    std::snprintf(rate, sizeof rate, "%.10g", frames.fps);
    ORO_CHECK(run_in(frames.folder, {ffmpeg,
                                     "-nostdin",
                                     "-y",
                                     "-loglevel",
                                     "error",
                                     "-framerate",
                                     rate,
                                     "-start_number",
                                     "1",
                                     "-i",
                                     "frame-%06d" + frames.ending,
                                     "-frames:v",
                                     std::to_string(frames.count),
                                     "-vf",
                                     "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                     "-pix_fmt",
                                     "yuv420p",
                                     "-movflags",
                                     "+faststart",
                                     "-f",
                                     "mp4",
                                     unnamed_movie}));
    const std::string file = (fs::path(frames.folder) / unnamed_movie).string();
    ORO_TRY(OpenFile movie, OpenFile::open(file, OpenFile::Use::read_own));
    ORO_CHECK(movie.sync());
    return give_name(file, out, overwrite);
}

}  // namespace oro

#include "tests/apps/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/support/test_data.h"

namespace oro::test {
namespace fs = std::filesystem;
namespace {

constexpr int cannot_start = 127;

void redirect(const fs::path& file, int descriptor, int flags) {
    const int opened = open(file.c_str(), flags, 0600);
    if (opened < 0 || dup2(opened, descriptor) < 0) _exit(cannot_start);
    close(opened);
}

void give_up_power_over_permissions() {
    prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0);
    prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH, 0, 0, 0);
}

// In the child, between fork and exec.
void take_on(const Circumstances& circumstances) {
    for (const std::string& setting : circumstances.environment) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos) {
            unsetenv(setting.c_str());
        } else {
            setenv(setting.substr(0, equals).c_str(), setting.c_str() + equals + 1, 1);
        }
    }
    if (circumstances.bound_by_permissions) give_up_power_over_permissions();
    if (!circumstances.folder.empty() && chdir(circumstances.folder.c_str()) != 0) _exit(cannot_start);
}

// Where the program keeps what it has measured: of this build of it, as its program file tells.
std::string cache_folder() {
    const auto built = fs::last_write_time(OROGRAPH_PROGRAM).time_since_epoch().count();
    return (fs::path(TEST_CACHE) / std::to_string(built)).string();
}

// Whether a command draws in the style that a view has when nothing is said of it.
bool draws_as_it_likes(const std::vector<std::string>& words) {
    const auto has = [&](const char* word) { return std::ranges::find(words, word) != words.end(); };
    return !words.empty() &&
           (words[0] == "shot" || words[0] == "panorama" || words[0] == "trade" || words[0] == "view" ||
            words[0] == "film") &&
           !has("--style") && !has("--view");
}

}  // namespace

std::vector<std::string> Outcome::err_lines() const {
    std::vector<std::string> lines;
    std::istringstream text(err);
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

Outcome run_program(const std::vector<std::string>& words, const Circumstances& circumstances) {
    const fs::path said = scratch_folder();
    static const std::string cache = cache_folder();
    // They are there, too, where a signal comes before the program does.
    for (const char* const file : {"out", "err"}) write_bytes(said / file, "");
    const pid_t child = fork();
    if (child == 0) {
        redirect("/dev/null", STDIN_FILENO, O_RDONLY);
        redirect(said / "out", STDOUT_FILENO, O_WRONLY | O_CREAT);
        redirect(said / "err", STDERR_FILENO, O_WRONLY | O_CREAT);
        setenv("OROGRAPH_CACHE", cache.c_str(), 1);
        // What a window keeps is nobody's but this run's.
        for (const char* const name : {"XDG_CONFIG_HOME", "XDG_STATE_HOME"})
            setenv(name, (said / "user").c_str(), 1);
        take_on(circumstances);
        std::vector<char*> arguments;
        for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
        arguments.push_back(nullptr);
        execvp(arguments[0], arguments.data());
        _exit(cannot_start);
    }
    int status = 0;
    EXPECT_GT(child, 0);
    if (circumstances.signal != 0 && child > 0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(circumstances.signal_after_s));
        kill(child, circumstances.signal);  // one that has ended waits to be asked how: its number is its own
    }
    EXPECT_EQ(waitpid(child, &status, 0), child);
    Outcome outcome;
    outcome.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    EXPECT_NE(outcome.exit_code, cannot_start) << words[0] << " cannot be started";
    outcome.out = bytes_of(said / "out");
    outcome.err = bytes_of(said / "err");
    return outcome;
}

Outcome run_orograph(std::vector<std::string> words, const Circumstances& circumstances) {
    if (!circumstances.natural && draws_as_it_likes(words))
        words.insert(words.begin() + 1, {"--style", "default"});
    words.insert(words.begin(), OROGRAPH_PROGRAM);
    return run_program(words, circumstances);
}

void expect_refusal(const Outcome& outcome, int exit_code, const std::vector<std::string>& says) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    ASSERT_EQ(outcome.err_lines().size(), 1U) << outcome.err;
    const std::string line = outcome.err_lines().front();
    EXPECT_EQ(line.rfind("orograph: ", 0), 0U) << line;
    EXPECT_LT(line.size(), 400U) << line;
    for (const std::string& word : says)
        EXPECT_NE(line.find(word), std::string::npos) << line << "\nlacks: " << word;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    EXPECT_TRUE(stream.is_open()) << file;
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

std::string view_in(const fs::path& png) {
    const std::string bytes = bytes_of(png), starts = "<orograph:View>";
    const std::size_t start = bytes.find(starts), end = bytes.find("</orograph:View>");
    EXPECT_LT(start, end) << png << " carries no view";
    if (start >= end) return {};
    std::string view = bytes.substr(start + starts.size(), end - start - starts.size());
    for (const auto& [entity, letter] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}}) {
        for (std::size_t at = 0; (at = view.find(entity, at)) != std::string::npos; ++at)
            view.replace(at, std::string(entity).size(), letter);
    }
    return view;
}

void write_bytes(const fs::path& file, const std::string& bytes) {
    std::ofstream stream(file, std::ios::binary);
    stream << bytes;
    stream.close();
    EXPECT_TRUE(stream.good()) << file;
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

bool permissions_bind() {
    const fs::path file = scratch_folder() / "locked";
    write_bytes(file, "locked");
    fs::permissions(file, fs::perms::none);
    Circumstances bound;
    bound.bound_by_permissions = true;
    return run_program({"cat", file.string()}, bound).exit_code != 0;
}

}  // namespace oro::test

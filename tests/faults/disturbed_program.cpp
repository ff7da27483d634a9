#include "tests/faults/disturbed_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/test_data.h"

namespace oro::test {
namespace fs = std::filesystem;
namespace {

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

void write_bytes(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// The innermost library of a stack.
std::string library_of(const std::string& where) {
    std::istringstream frames(where);
    for (std::string frame; frames >> frame;) {
        const std::string name = frame.substr(0, frame.rfind('+'));
        if (name.rfind("libc.", 0) != 0 && name.rfind("libstdc++", 0) != 0) return name;
    }
    return "";
}

// Libraries abort or fall over where their own small allocations fail, and nothing outside them can help:
// CPLMalloc where GDAL's own quiet handler listens, assertions of PROJ, libgeotiff. Never our own code, and
// never an exception that nobody caught.
bool library_ended_it(const Disturbed& run, const Fault& fault) {
    const bool by_signal = run.exit_code == 128 + SIGABRT || run.exit_code == 128 + SIGSEGV;
    return fault.calls == "allocation" && !fault.own && by_signal &&
           library_of(run.where).rfind("lib", 0) == 0 &&
           run.err.find("terminate called") == std::string::npos;
}

// What GDAL writes past every handler when it has no memory to find them, and the C library for the text of a
// library's assertion (PROJ's, in proj_create_crs_to_crs_from_pj) that it has no memory for.
bool is_last_words(const std::string& line) {
    if (line == "Unexpected error.") return true;
    return line.rfind("CPL", 0) == 0 || line.rfind("FATAL: CPL", 0) == 0 ||
           line.rfind("Out of memory attempting", 0) == 0;
}

}  // namespace

std::string Fault::line() const {
    return calls + " " + std::to_string(number) + " " + std::to_string(period) + " " + std::to_string(error) +
           (own ? " own" : " all");
}

DisturbedProgram::DisturbedProgram(const std::vector<std::string>& words, fs::path folder, int processors)
    : folder_(std::move(folder)), said_(scratch_folder()) {
    std::array<int, 2> plans{}, reports{};
    if (pipe2(plans.data(), O_CLOEXEC) != 0 || pipe2(reports.data(), O_CLOEXEC) != 0) return;
    server_ = fork();
    if (server_ == 0) become_server(words, plans[0], reports[1], processors);
    close(plans[0]);
    close(reports[1]);
    plans_ = fdopen(plans[1], "w");
    reports_ = fdopen(reports[0], "r");
}

DisturbedProgram::~DisturbedProgram() {
    if (plans_) std::fclose(plans_);
    if (reports_) std::fclose(reports_);
    if (server_ > 0) waitpid(server_, nullptr, 0);
}

void DisturbedProgram::become_server(const std::vector<std::string>& words, int in, int out,
                                     int processors) const {
    for (const auto& [descriptor, name] : {std::pair{1, "out"}, std::pair{2, "err"}}) {
        const int file = open((said_ / name).c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
        if (file < 0 || dup2(file, descriptor) < 0) _exit(125);
        close(file);
    }
    const int nothing = open("/dev/null", O_RDONLY);
    if (nothing < 0 || dup2(nothing, 0) < 0 || chdir(folder_.c_str()) != 0) _exit(125);
    fcntl(in, F_SETFD, 0);
    fcntl(out, F_SETFD, 0);
    setenv("FAULT_SERVER", (std::to_string(in) + "," + std::to_string(out)).c_str(), 1);
    setenv("FAULT_PROCESSORS", std::to_string(processors).c_str(), 1);
    setenv("LD_PRELOAD", FAULT_INJECTION, 1);
    setenv("OROGRAPH_CACHE", (said_ / "cache").c_str(), 1);
    setenv("SOURCE_DATE_EPOCH", "1790000000", 1);
    setenv("MESA_SHADER_CACHE_DIR", SHADER_CACHE, 1);  // compiling takes 10 s
    const char* const another_build = std::getenv("OROGRAPH_PROGRAM");
    std::vector<char*> arguments{const_cast<char*>(another_build ? another_build : OROGRAPH_PROGRAM)};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(125);
}

Disturbed DisturbedProgram::run(const Fault& fault) {
    for (const char* name : {"out", "err"}) {
        std::error_code ignored;
        if (fs::exists(said_ / name, ignored)) fs::resize_file(said_ / name, 0, ignored);
    }
    Disturbed run;
    std::array<char, 2400> report{};
    if (!plans_ || !reports_ || std::fprintf(plans_, "%s\n", fault.line().c_str()) < 0 ||
        std::fflush(plans_) != 0 || !std::fgets(report.data(), report.size(), reports_)) {
        run.exit_code = 125;
        return run;
    }
    std::istringstream words(report.data());
    int status = 0;
    words >> status >> run.timed_out >> run.counted >> run.failed >> run.skipped;
    std::getline(words, run.where);
    run.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    run.out = bytes_of(said_ / "out");
    run.err = bytes_of(said_ / "err");
    return run;
}

FaultRuns::FaultRuns(Command command, int processors)
    : command_(std::move(command)), folder_(scratch_folder()), program_(command_.words, folder_, processors) {
    put_back();
    const Disturbed run = program_.run({"thread"});
    EXPECT_EQ(run.exit_code, 0) << command_.name << ": " << run.err;
    after_ = files();
    out_ = run.out;
    for (const auto& [name, bytes] : command_.before) EXPECT_TRUE(after_.contains(name)) << name;
}

void FaultRuns::put_back() {
    for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry.path());
    for (const auto& [name, bytes] : command_.inputs) write_bytes(folder_ / name, bytes);
    for (const auto& [name, bytes] : command_.before)
        if (!bytes.empty()) write_bytes(folder_ / name, bytes);
}

std::map<std::string, std::string> FaultRuns::files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_))
        all[entry.path().filename().string()] = bytes_of(entry.path());
    return all;
}

long FaultRuns::count(const Fault& fault) {
    const Fault none{fault.calls, 0, fault.period, fault.error, fault.own};
    const auto [known, is_new] = counts_.try_emplace(none.line(), 0);
    if (!is_new) return known->second;
    put_back();
    const Disturbed run = program_.run(none);
    EXPECT_EQ(run.exit_code, 0) << command_.name << ", " << none.line() << ": " << run.err;
    return known->second = run.counted;
}

std::string FaultRuns::fault_of_run(const Fault& fault) {
    put_back();
    const Disturbed run = program_.run(fault);
    std::string wrong = judge(run, fault);
    if (wrong.empty() && command_.goes_on && run.exit_code != 0) wrong = judge_going_on();
    if (run.skipped > 0) ++ends_["left out for a driver on the stack"];
    if (wrong.empty()) return "";
    return command_.name + ", " + fault.line() + ": " + wrong + "\n  exit " + std::to_string(run.exit_code) +
           ", said: " + run.err.substr(0, 300) + "\n  failed at:" + run.where;
}

std::string FaultRuns::judge(const Disturbed& run, const Fault& fault) {
    ++ends_["runs"];
    const auto there = files();
    std::string wrong;
    if (run.timed_out) {
        wrong = "it hangs";
    } else if (library_ended_it(run, fault)) {
        wrong = outputs_are_old(there) ? "" : "a library ended it, and outputs are not as they were";
        if (wrong.empty()) ++ends_["of these in " + library_of(run.where) + " itself"];
    } else if (run.exit_code >= 125) {
        wrong = "a signal ended it";
    } else if (run.exit_code == 0) {
        wrong = judge_success(run, there);
    } else {
        wrong = judge_failure(run, there);
    }
    ++ends_[!wrong.empty() ? wrong : "exit " + std::to_string(run.exit_code)];
    return wrong;
}

bool FaultRuns::outputs_are_old(const std::map<std::string, std::string>& there) const {
    return std::all_of(command_.before.begin(), command_.before.end(), [&](const auto& old) {
        return there.contains(old.first) ? there.at(old.first) == old.second : old.second.empty();
    });
}

std::string FaultRuns::judge_success(const Disturbed& run,
                                     const std::map<std::string, std::string>& there) const {
    for (const auto& [name, bytes] : there)
        if (!after_.contains(name)) return "exit 0, and leaves a file that should not be there";
    if (there == after_ && run.out == out_) return "";
    return run.err.find("note: ") != std::string::npos ? "exit 0 with another result, and a note"
                                                       : "exit 0 with another result, silently";
}

// What a bake that was broken off goes on from: what is unfinished, and the whole grid of a file with more in
// it.
static bool goes_on_from(const std::string& name) {
    return name.find(".partial") != std::string::npos || name.find(".grid-") != std::string::npos;
}

std::string FaultRuns::judge_failure(const Disturbed& run,
                                     const std::map<std::string, std::string>& there) const {
    if (run.exit_code == 2) return "told as a mistake of the user";
    const auto says = lines_of(run.err);
    const auto is_note = [](const std::string& line) {
        return line.rfind("note: ", 0) == 0 || is_last_words(line);
    };
    const auto count =
        says.size() - static_cast<std::size_t>(std::count_if(says.begin(), says.end(), is_note));
    if (count != 1 || says.back().rfind("orograph: ", 0) != 0) return "not one line that says why";
    const bool all_new = std::all_of(command_.before.begin(), command_.before.end(), [&](const auto& output) {
        return there.contains(output.first) && there.at(output.first) == after_.at(output.first);
    });
    if (!all_new && !outputs_are_old(there))
        return "outputs that are neither as they were nor as they shall be";
    for (const auto& [name, bytes] : there) {
        if (command_.inputs.contains(name)) {
            if (bytes != command_.inputs.at(name)) return "an input was changed";
        } else if (!command_.before.contains(name) && !(command_.goes_on && goes_on_from(name))) {
            return "a file was left behind";
        }
    }
    return "";
}

std::string FaultRuns::judge_going_on() {
    const auto there = files();
    if (std::none_of(there.begin(), there.end(), [](const auto& file) { return goes_on_from(file.first); }))
        return "";
    const Disturbed again = program_.run({"thread"});
    ++ends_["gone on with"];
    return again.exit_code == 0 && files() == after_
               ? ""
               : "going on from there gives another result: " + again.err;
}

long FaultRuns::ended(const std::string& how) const {
    const auto found = ends_.find(how);
    return found == ends_.end() ? 0 : found->second;
}

std::string FaultRuns::summary() const {
    std::string text = command_.name;
    for (const auto& [how, count] : ends_) text += ", " + how + ": " + std::to_string(count);
    return text;
}

void expect_order(FaultRuns& runs, const Fault& kind, long dense, long sparse) {
    const long count = runs.count(kind);
    EXPECT_GT(count, 0) << kind.line();
    std::vector<long> numbers;
    for (long number = 1; number <= std::min(dense, count); ++number) numbers.push_back(number);
    for (long i = 0; i < sparse && count > dense; ++i)
        numbers.push_back(dense + 1 + i * (count - dense - 1) / std::max(1L, sparse - 1));
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    int wrong = 0;
    for (const long number : numbers) {
        Fault fault = kind;
        fault.number = number;
        const std::string text = runs.fault_of_run(fault);
        if (text.empty()) continue;
        ++wrong;
        if (wrong <= 40) ADD_FAILURE() << text;
    }
    EXPECT_EQ(wrong, 0) << "of " << numbers.size();
    std::printf("%s of %ld, %s\n", kind.line().c_str(), count, runs.summary().c_str());
    std::fflush(stdout);
}

long runs_asked_for() {
    const char* const asked = std::getenv("OROGRAPH_FAULTS");
    return asked ? std::max(1L, std::strtol(asked, nullptr, 10)) : 12;
}

}  // namespace oro::test

// Runs the program as a user does, and tells what it said.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/test_data.h"

namespace oro::test {

using Words = std::vector<std::string>;
inline Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}
inline bool says(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

// Exit codes that are not 0.
inline constexpr int failed = 1, usage = 2, no_data = 3, no_device = 4;

// The region that comes with the program.
inline std::string bundled() {
    return (bundled_data() / "jacksboro.tif").string();
}

// What is unlike a plain run.
struct Circumstances {
    std::vector<std::string> environment;  // "NAME=VALUE" sets, "NAME" removes
    bool bound_by_permissions{false};      // root, too, heeds the permissions of files
    std::filesystem::path folder;          // the working folder, if not the test's
    int signal{0};                         // is sent to it so long after its start, if it still runs then
    double signal_after_s{0.0};
    bool natural{false};  // see run_orograph()
};

struct Outcome {
    int exit_code{};  // 128 + signal when a signal ended it
    std::string out;
    std::string err;

    // The lines of standard error.
    [[nodiscard]] std::vector<std::string> err_lines() const;
};

// Runs a program (looked up in PATH when it has no slash) with standard input closed, and a cache folder in
// the build tree that all these tests share and nobody else. So the ways of drawing are measured once, and
// not by each of them.
Outcome run_program(const std::vector<std::string>& words, const Circumstances& circumstances = {});
// Runs the program under test. What draws and names neither a style nor a view is told `--style default`,
// which takes a third of the time of the style that users get, unless it shall be `natural` as with them.
Outcome run_orograph(std::vector<std::string> words, const Circumstances& circumstances = {});

// Expects one line on standard error that holds all of `says`, nothing on standard output, and the exit code.
void expect_refusal(const Outcome& outcome, int exit_code, const std::vector<std::string>& says);

// The file's bytes; a failed expectation when it cannot be read.
std::string bytes_of(const std::filesystem::path& file);
// The view that a PNG carries, JSON; a failed expectation when it carries none.
std::string view_in(const std::filesystem::path& png);
void write_bytes(const std::filesystem::path& file, const std::string& bytes);
// Names of what lies in a folder, sorted.
std::vector<std::string> names_in(const std::filesystem::path& folder);

// True when this process may take root's power over permissions from its children, or has none.
bool permissions_bind();

}  // namespace oro::test

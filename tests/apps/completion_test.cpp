// The scripts of completion, asked by the shells themselves; and the pages of the manual, as man(1) reads
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/found_texts.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;

bool is_there(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

std::string printed_by(const Words& words) {
    const Outcome outcome = run_orograph(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
}

std::set<std::string> lines_in(const std::string& text) {
    std::set<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (!line.empty()) lines.insert(line);
    return lines;
}

// What bash completes the last of these words to, as it stands after the others.
std::set<std::string> completed(const Words& words, const fs::path& folder = oro::test::scratch_folder()) {
    const fs::path script = oro::test::scratch_folder() / "orograph";
    oro::test::write_bytes(script, printed_by({"completion", "bash"}));
    oro::test::Circumstances there;
    there.folder = folder;
    const Outcome outcome = run_program(
        oro::test::joined(
            {"bash", "--norc", "-c",
             "source \"$1\" || exit 9; shift; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _orograph; "
             "printf '%s\\n' \"${COMPREPLY[@]}\"",
             "bash", script.string()},
            words),
        there);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return lines_in(outcome.out);
}

using WordSet = std::set<std::string>;

TEST(BashCompletion, OfCommandsAndOptions) {
    EXPECT_EQ(completed({"orograph", "sh"}), WordSet{"shot"});
    EXPECT_EQ(completed({"orograph", "--v"}), WordSet{"--version"});
    const WordSet all = completed({"orograph", ""});
    for (const char* command : {"shot", "view", "doctor", "--help"})
        EXPECT_TRUE(all.contains(command)) << command;
    EXPECT_FALSE(all.contains("completion"));
    EXPECT_EQ(completed({"orograph", "shot", "--sty"}), WordSet{"--style"});
    EXPECT_EQ(completed({"orograph", "shot", "a.hgt", "--over"}),
              (WordSet{"--overlay", "--overlay-colour", "--overlay-fill", "--overlay-width", "--overwrite"}));
    EXPECT_EQ(completed({"orograph", "doctor", ""}), (WordSet{"--json", "--help", "-h"}));
    EXPECT_EQ(completed({"orograph", "trade", "--tau"}), WordSet()) << "what help hides";
    EXPECT_EQ(completed({"orograph", "shot", "--help", ""}), WordSet{"all"});
}

TEST(BashCompletion, OfChoicesAndStyles) {
    EXPECT_EQ(completed({"orograph", "shot", "--style", "re"}), WordSet{"relief"});
    EXPECT_EQ(completed({"orograph", "shot", "--style", "=", "re"}), WordSet{"relief"}) << "--style=re";
    EXPECT_EQ(completed({"orograph", "view", "--sea", "="}), (WordSet{"level", "low", "voids"})) << "--sea=";
    EXPECT_EQ(completed({"orograph", "info", "--height-unit", ""}),
              (WordSet{"m", "ft", "us-ft", "cm", "dm", "mm"}));
    EXPECT_EQ(completed({"orograph", "plan", "--air", "s"}), WordSet{"standard"});
    EXPECT_EQ(completed({"orograph", "bake", "--mesh", ""}), (WordSet{"grid", "clusters"}));
    EXPECT_EQ(completed({"orograph", "shot", "--heading", ""}), WordSet()) << "a number is typed";
}

TEST(BashCompletion, OfFilesByTheirType) {
    const fs::path folder = oro::test::scratch_folder();
    for (const char* name : {"N46E008.HGT", "a map.tif", "track.gpx", "notes.txt", "old.oro", "p.png"})
        oro::test::write_bytes(folder / name, "");
    fs::create_directory(folder / "data");
    EXPECT_EQ(completed({"orograph", "shot", ""}, folder),
              (WordSet{"N46E008.HGT", "a map.tif", "old.oro", "data"}));
    EXPECT_EQ(completed({"orograph", "shot", "--names", ""}, folder), (WordSet{"track.gpx", "data"}));
    EXPECT_EQ(completed({"orograph", "bake", "--out", "o"}, folder), WordSet{"old.oro"});
    EXPECT_EQ(completed({"orograph", "shot", "--view", "p"}, folder), WordSet{"p.png"});
    EXPECT_EQ(completed({"orograph", "trade", "--out", ""}, folder), WordSet{"data"});
    EXPECT_EQ(completed({"orograph", "shot", "no"}, folder), WordSet{"notes.txt"})
        << "any, where none has its type";
    EXPECT_EQ(completed({"orograph", "shot", "--drape", "n"}, folder), WordSet{"notes.txt"});
    EXPECT_EQ(completed({"orograph", "compare", "p"}, folder), WordSet{"p.png"});
}

// The other shells read their scripts without a fault.
TEST(ShellScripts, AreRead) {
    for (const std::string shell : {"bash", "zsh", "fish"}) {
        const fs::path script = oro::test::scratch_folder() / shell;
        oro::test::write_bytes(script, printed_by({"completion", shell}));
        if (!is_there(shell)) continue;
        const Outcome outcome = run_program({shell, "-n", script.string()});
        EXPECT_EQ(outcome.exit_code, 0) << shell << ": " << outcome.err;
        EXPECT_EQ(outcome.err, "") << shell;
    }
}

TEST(ShellScripts, FishCompletes) {
    if (!is_there("fish")) GTEST_SKIP() << "needs fish";
    const fs::path folder = oro::test::scratch_folder();
    oro::test::write_bytes(folder / "script", printed_by({"completion", "fish"}));
    oro::test::write_bytes(folder / "N46E008.hgt", "");
    oro::test::Circumstances there;
    there.folder = folder;
    there.environment = {"HOME=" + folder.string()};
    const auto ask = [&](const std::string& line) {
        const Outcome outcome =
            run_program({"fish", "--no-config", "-c", "source script; complete -C '" + line + "'"}, there);
        return oro::test::replaced_texts(outcome.out, "\t[^\n]*", "");
    };
    EXPECT_EQ(lines_in(ask("orograph shot --sty")), WordSet{"--style"});
    EXPECT_TRUE(lines_in(ask("orograph shot --style re")).contains("relief"));
    EXPECT_EQ(lines_in(ask("orograph sho")), WordSet{"shot"});
    EXPECT_TRUE(lines_in(ask("orograph shot N46")).contains("N46E008.hgt"));
}

TEST(ShellScripts, WhatIsNoShellOrPageIsRefused) {
    oro::test::expect_refusal(run_orograph({"completion", "tcsh"}), oro::test::usage, {"bash, zsh or fish"});
    oro::test::expect_refusal(run_orograph({"completion"}), oro::test::usage, {"SHELL", "is missing"});
    oro::test::expect_refusal(run_orograph({"manual", "fly"}), oro::test::usage, {"fly", "shot", "doctor"});
}

// The options that `--help all` lists: "--above".
std::set<std::string> options_of(const std::string& command) {
    std::set<std::string> options;
    const std::string help = printed_by({command, "--help", "all"});
    for (const auto& found : oro::test::found_texts(help, "\n  (?:-q, |-h, )?(--[a-z-]+)"))
        options.insert(found[1]);
    return options;
}

// The commands whose pages the program's page names.
std::vector<std::string> commands_in(const std::string& page) {
    std::vector<std::string> named;
    for (const auto& found : oro::test::found_texts(page, "\n\\.BR orograph\\\\-([a-z]+) \\(1\\)"))
        named.push_back(found[1]);
    return named;
}

TEST(Manual, HasEachOptionOfHelp) {
    const std::vector<std::string> pages = commands_in(printed_by({"manual"}));
    EXPECT_GE(pages.size(), 13U);
    for (const std::string& command : pages) {
        const std::string page = oro::test::replaced_texts(printed_by({"manual", command}), "\\\\-", "-");
        const auto options = options_of(command);
        EXPECT_GE(options.size(), 2U) << command;
        for (const std::string& option : options)
            EXPECT_NE(page.find("\\fB" + option + "\\fR"), std::string::npos) << command << " " << option;
    }
}

TEST(Manual, IsReadWithoutAWarning) {
    if (!is_there("groff")) GTEST_SKIP() << "needs groff";
    std::vector<Words> pages = {{"manual"}};
    for (const std::string& command : commands_in(printed_by({"manual"})))
        pages.push_back({"manual", command});
    for (const Words& words : pages) {
        const fs::path file = oro::test::scratch_folder() / "page.1";
        oro::test::write_bytes(file, printed_by(words));
        const Outcome outcome = run_program({"groff", "-man", "-Tutf8", "-ww", "-P-cbou", file.string()});
        EXPECT_EQ(outcome.exit_code, 0) << words.back();
        EXPECT_EQ(outcome.err, "") << words.back();
        EXPECT_NE(outcome.out.find("EXIT STATUS"), std::string::npos) << words.back();
        EXPECT_EQ(outcome.out.find("\\f"), std::string::npos) << words.back();
    }
}

}  // namespace

// What a line of a list becomes: words of a command line.
#include "apps/batch/job_list.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/batch/job_conflicts.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using Words = std::vector<std::string>;

std::string fault_of(const std::string& text) {
    const BatchJob job = job_of_line(text, 1);
    return job.fault ? job.fault->what : "";
}

TEST(JobList, NamesAreOptionsAndListsOfNumbersOneValue) {
    const BatchJob job = job_of_line(
        R"({"command": "shot", "out": "a.png", "path": "alps", "at": [46.5, -8.25], "size": [1920, 1080],
            "look_at": "46,8", "legend": true, "verify": false, "bbox": null, "above": 2.5,
            "view": ["a.json", "b.json"], "args": ["--tau", "2"]})",
        7);
    ASSERT_FALSE(job.fault.has_value()) << job.fault->what;
    EXPECT_EQ(job.line, 7U);
    EXPECT_EQ(job.command, "shot");
    // The names of an object are in the order of their letters.
    EXPECT_EQ(job.words,
              (Words{"shot", "alps", "--above=2.5", "--at=46.5,-8.25", "--legend", "--look-at=46,8",
                     "--out=a.png", "--size=1920x1080", "--view=a.json", "--view=b.json", "--tau", "2"}));
    ASSERT_EQ(job.writes.size(), 1U);
    EXPECT_EQ(job.writes[0].option, "--out");
    EXPECT_EQ(job.writes[0].file, "a.png");
}

TEST(JobList, SeveralObserversAreListsInAList) {
    const BatchJob job = job_of_line(
        R"({"command": "viewshed", "paths": ["a.tif", "-b.tif"], "at": [[46, 8], [46.1, 8.1]]})", 1);
    EXPECT_EQ(job.words, (Words{"viewshed", "a.tif", "./-b.tif", "--at=46,8", "--at=46.1,8.1"}));
    EXPECT_TRUE(job.writes.empty());
}

// The same for jobs of the same data, whatever they do with them.
TEST(JobList, ARegionIsItsPathsAndTheOptionsOfData) {
    const auto region = [](const std::string& text) { return job_of_line(text, 1).region; };
    const std::string one = region(R"({"command": "shot", "path": "alps", "at": "46,8", "out": "a.png"})");
    EXPECT_EQ(one, region(R"({"command": "sight", "path": "alps", "from": "46,8", "to": "46,9"})"));
    EXPECT_NE(one, region(R"({"command": "shot", "path": "tatras", "at": "46,8", "out": "a.png"})"));
    EXPECT_NE(one, region(R"({"command": "shot", "path": "alps", "tile": "N46E008", "out": "a.png"})"));
}

TEST(JobList, LinesThatCannotBeUnderstoodTellWhy) {
    const auto tells = [](const std::string& text, const std::string& words) {
        EXPECT_NE(fault_of(text).find(words), std::string::npos) << text << "\n" << fault_of(text);
    };
    tells("shot alps --out a.png", "");
    EXPECT_NE(fault_of("shot alps --out a.png"), "");
    tells("[]", "must be a JSON object");
    tells("{}", "'command' is missing");
    tells(R"({"command": 3})", "'command' must be text");
    tells(R"({"command": "fly"})", "\"fly\" is no command that a line can give; these are shot, panorama");
    for (const char* const command : {"batch", "view", "serve", "completion", "manual", "doctor", ""})
        tells(R"({"command": ")" + std::string(command) + "\"}", "is no command that a line can give");
    tells(R"({"command": "shot", "out": "a.png", "out": "b.png"})", "'out' is there twice");
    tells(R"({"command": "shot", "at": {"lat": 46}})", "'at' must be a text, a number");
    tells(R"({"command": "shot", "at": []})", "'at' is an empty list");
    tells(R"({"command": "shot", "at": [46, "8"], "out": [null]})", "must be a text, a number");
    tells(R"({"command": "shot", "--at": "46,8"})", "'--at' is no name of an option");
    tells(R"({"command": "shot", "a t": "46,8"})", "'a t' is no name of an option");
    tells(R"({"command": "shot", "at": "46\u0000,8"})", "holds a zero byte");
    tells(R"({"command": "shot", "args": "--tau 2"})", "args");
    tells(R"({"command": "shot", "at": )" + std::string(100000, '[') + std::string(100000, ']') + "}",
          "deep");
    tells(R"({"command": "shot", "at": ")" + std::string(most_line_bytes, '4') + "\"}", "longer than 1 MiB");
}

class JobConflicts : public testing::Test {
  protected:
    const std::filesystem::path folder = test::scratch_folder();

    std::string path(const std::string& name) const { return (folder / name).string(); }
    void touch(const std::string& name) const { std::ofstream(folder / name) << "1"; }
    std::vector<BatchJob> jobs_of(const Words& lines) const {
        std::vector<BatchJob> jobs;
        for (const std::string& line : lines) jobs.push_back(job_of_line(line, jobs.size() + 1));
        find_conflicts("jobs.jsonl", {path("jobs.jsonl")}, jobs);
        return jobs;
    }
    std::string shot(const std::string& data, const std::string& out) const {
        return R"({"command": "shot", "path": ")" + path(data) + R"(", "out": ")" + path(out) + "\"}";
    }
    static std::string said(const BatchJob& job) { return job.fault ? job.fault->line() : ""; }
};

TEST_F(JobConflicts, TwoLinesThatWriteOneFile) {
    std::filesystem::create_directory(folder / "sub");
    const auto jobs =
        jobs_of({shot("a.tif", "a.png"), shot("a.tif", "b.png"), shot("a.tif", "sub/../a.png")});
    EXPECT_EQ(said(jobs[0]), "");
    EXPECT_EQ(said(jobs[1]), "");
    EXPECT_EQ(said(jobs[2]), "--out " + path("sub/../a.png") + ": is what line 1 writes");
}

TEST_F(JobConflicts, AFileThatAnotherLineReads) {
    touch("a.tif");
    std::filesystem::create_hard_link(folder / "a.tif", folder / "link.tif");
    const auto jobs = jobs_of({shot("a.tif", "a.png"), shot("b.tif", "link.tif"), shot("c.tif", "c.tif")});
    EXPECT_EQ(said(jobs[0]), "");
    EXPECT_NE(said(jobs[1]).find("is what line 1 reads"), std::string::npos) << said(jobs[1]);
    EXPECT_NE(said(jobs[2]).find("would replace what the job itself reads"), std::string::npos)
        << said(jobs[2]);
}

TEST_F(JobConflicts, AFolderOfDataAndTheListAreSpared) {
    std::filesystem::create_directories(folder / "data" / "deep");
    touch("jobs.jsonl");
    const auto jobs = jobs_of({shot("data", "a.png"), shot("b.tif", "data/deep/b.tif"),
                               shot("b.tif", "data/b.png"), shot("b.tif", "jobs.jsonl")});
    EXPECT_NE(said(jobs[1]).find("would be among the elevation data that line 1 reads"), std::string::npos);
    EXPECT_EQ(said(jobs[2]), "");
    EXPECT_NE(said(jobs[3]).find("would replace the list of jobs"), std::string::npos);
}

TEST_F(JobConflicts, FilmsMayShareAFolder) {
    const auto film = [&](const std::string& frames) {
        return R"({"command": "film", "flight": "f.json", "path": "a.tif", "out": ")" + path("frames") +
               R"(", "frames": ")" + frames + "\"}";
    };
    const auto jobs = jobs_of({film("1:2"), film("3:4")});
    EXPECT_EQ(said(jobs[0]) + said(jobs[1]), "");
}

class JobFile : public testing::Test {
  protected:
    const std::filesystem::path file = test::scratch_folder() / "jobs.jsonl";
    Result<std::vector<BatchJob>> jobs_in(const std::string& text) const {
        std::ofstream(file, std::ios::binary) << text;
        return read_jobs(file.string());
    }
};

TEST_F(JobFile, EmptyLinesAndCommentsArePassedOver) {
    const auto jobs = jobs_in(
        "\xEF\xBB\xBF# stations\r\n\r\n{\"command\": \"info\", \"path\": \"a\"}\r\n  \n"
        "nonsense\n{\"command\": \"info\", \"path\": \"b\"}");
    ASSERT_TRUE(jobs.ok());
    ASSERT_EQ(jobs->size(), 3U);
    EXPECT_EQ((*jobs)[0].line, 3U);
    EXPECT_TRUE((*jobs)[1].fault.has_value());
    EXPECT_EQ((*jobs)[2].line, 6U);
}

TEST_F(JobFile, WhatIsNoListIsRefusedAsAWhole) {
    for (const auto& [text, words] :
         {std::pair<std::string, std::string>{"", "has no jobs"},
          {"# nothing\n\n", "has no jobs"},
          {std::string("\x89PNG\r\n\0\0", 8), "it is no text"},
          {"shot a.tif\nshot b.tif\n", "has no job that can be understood: line 1"}}) {
        const auto jobs = jobs_in(text);
        ASSERT_FALSE(jobs.ok()) << text;
        EXPECT_NE(jobs.error().what.find(words), std::string::npos) << jobs.error().line();
    }
    // More than 1 GiB, all of it a hole.
    std::filesystem::resize_file(file, std::uintmax_t{1} << 34U);
    const auto huge = read_jobs(file.string());
    ASSERT_FALSE(huge.ok());
    EXPECT_NE(huge.error().what.find("a list of jobs has at most 1 GiB"), std::string::npos);
    EXPECT_FALSE(read_jobs(file.parent_path().string()).ok());
    EXPECT_FALSE(read_jobs("/nowhere/jobs.jsonl").ok());
}

// What no honest program writes: each is one line, that says what is wrong and is no longer than a screen.
TEST_F(JobFile, HostileLinesAreFaultsInOneLine) {
    const std::string begin = R"({"command": "sight", "path": "a.tif", "from": "36,-84")";
    const auto fault_of = [&](const std::string& line) {
        const auto jobs = jobs_in(begin + "}\n" + line + "\n");
        if (!jobs.ok() || jobs->size() != 2)
            return std::string("the list: ") + (jobs.ok() ? "" : jobs.error().line());
        return (*jobs)[1].fault ? (*jobs)[1].fault->line() : std::string();
    };
    const auto deep = [](const std::string& open, const std::string& close) {
        std::string text;
        for (int i = 0; i < 100000; ++i) text += open;
        text += "1";
        for (int i = 0; i < 100000; ++i) text += close;
        return text;
    };
    const std::vector<std::pair<std::string, std::string>> lines{
        {begin + R"(, "from": "36,-85"})", "'from' is there twice"},
        {begin + R"(, "above": 1e999})", "number overflow"},
        {begin + R"(, "above": )" + std::string(5000, '9') + "}", "number overflow"},
        {begin + R"(, "above": NaN})", "is no JSON"},
        {begin + R"(, "above": {"a": 1}})", "'above' must be a text, a number"},
        {begin + R"(, "above": )" + deep("[", "]") + "}", "nested deeper than 16"},
        {deep("{\"a\":", "}"), "nested deeper than 16"},
        {begin + R"(, "print": "x\u0000y"})", "'print' holds a zero byte"},
        {begin + R"(, "print": "\ud800"})", "is no JSON"},
        {begin + ", \"print\": \"\xff\"}", "is no JSON"},
        {begin + "}" + begin + "}", "is no JSON"},
        {begin + ",}", "is no JSON"},
        {begin + R"(, "--json": true})", "'--json' is no name of an option"},
        {begin + R"(, "": true})", "'' is no name of an option"},
        {begin + R"(, "args": "--json"})", "'args' must be a list"},
        {R"({"command": "batch", "path": "b.jsonl"})", "\"batch\" is no command"},
        {R"({"command": 5})", "'command' must be text"},
        {"[1, 2]", "must be a JSON object"},
        {"{}", "'command' is missing"},
        {begin + R"(, "print": ")" + std::string(std::size_t{1} << 20U, 'x') + "\"}", "longer than 1 MiB"}};
    for (const auto& [line, says] : lines) {
        const std::string fault = fault_of(line);
        EXPECT_NE(fault.find(says), std::string::npos) << line.substr(0, 200) << "\n" << fault;
        EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
        EXPECT_LT(fault.size(), 400U) << fault;
    }
    // A mark of the byte order, ends of lines as of Windows, and no end of the last line are no faults.
    const auto jobs = jobs_in("\xEF\xBB\xBF" + begin + "}\r\n\r\n" + begin + "}");
    ASSERT_TRUE(jobs.ok());
    ASSERT_EQ(jobs->size(), 2U);
    for (const BatchJob& job : *jobs) EXPECT_FALSE(job.fault) << job.fault->line();
    EXPECT_EQ((*jobs)[1].line, 3U);
    const auto cut = jobs_in(begin + "}" + std::string(1, '\0') + "\n");
    ASSERT_FALSE(cut.ok());
    EXPECT_NE(cut.error().line().find("it is no text"), std::string::npos) << cut.error().line();
}

// Lines by grammar, right ones with a part taken away, doubled or replaced: a line is a job or one line.
TEST_F(JobFile, LinesByGrammar) {
    constexpr unsigned seed = 541;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const std::vector<std::string> parts{"{",           "}",
                                         "[",           "]",
                                         ",",           ":",
                                         "\"command\"", "\"shot\"",
                                         "\"path\"",    "\"a.tif\"",
                                         "\"out\"",     "\"x.png\"",
                                         "\"size\"",    "1e308",
                                         "-0",          "1e-400",
                                         "null",        "true",
                                         "\"args\"",    "\"\\u0000\"",
                                         "\"\\u202e\"", "\xEF\xBB\xBF",
                                         "\t",          "\r",
                                         "#",           "\"\"",
                                         "0x1",         "18446744073709551616",
                                         "\x80",        "{{",
                                         "\"at\"",      "[46.5, 8]",
                                         "\"--\""};
    int understood = 0;
    for (int i = 0; i < 5000; ++i) {
        std::vector<std::string> line{"{", "\"command\"", ":", "\"shot\"",  ",", "\"path\"", ":", "\"a.tif\"",
                                      ",", "\"out\"",     ":", "\"x.png\"", "}"};
        for (std::size_t change = random() % 3; change > 0; --change) {
            const std::size_t at = random() % line.size();
            const std::string& part = parts[random() % parts.size()];
            if (random() % 3 == 0)
                line.erase(line.begin() + static_cast<std::ptrdiff_t>(at));
            else if (random() % 2 == 0)
                line.insert(line.begin() + static_cast<std::ptrdiff_t>(at), part);
            else
                line[at] = part;
        }
        std::string text;
        for (const std::string& part : line) text += part;
        const BatchJob job = job_of_line(text, 1);
        understood += !job.fault;
        if (!job.fault) continue;
        EXPECT_EQ(job.fault->kind, ErrorKind::usage);
        EXPECT_EQ(job.fault->line().find('\n'), std::string::npos) << text;
        EXPECT_FALSE(job.fault->what.empty() || job.fault->line().size() > 400) << text;
    }
    EXPECT_GT(understood, 1000);
    EXPECT_LT(understood, 4500);
}

// The same file by other names, of files that are not there yet, from the working folder.
TEST_F(JobConflicts, OtherNamesOfOneFileFromTheWorkingFolder) {
    const auto sight = [](const std::string& print) {
        return R"({"command": "sight", "path": "nowhere.tif", "print": ")" + print + "\"}";
    };
    const std::string here = std::filesystem::current_path().filename().string();
    const auto jobs = jobs_of({sight("not-there-x.txt"), sight("./not-there-x.txt"),
                               sight("../" + here + "/not-there-x.txt"), sight("not-there-y.txt")});
    EXPECT_EQ(said(jobs[0]), "");
    EXPECT_NE(said(jobs[1]).find("is what line 1 writes"), std::string::npos) << said(jobs[1]);
    EXPECT_NE(said(jobs[2]).find("is what line 1 writes"), std::string::npos) << said(jobs[2]);
    EXPECT_EQ(said(jobs[3]), "");
}

}  // namespace
}  // namespace oro

// What a line of a list becomes: words of a command line.
#include "apps/batch/job_list.h"

#include <gtest/gtest.h>

#include <fstream>

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
    EXPECT_EQ(job.writes, (Words{"a.png"}));
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

}  // namespace
}  // namespace oro

// Parts of an output that are done: what a write that fails, and a signal, leave of them.
#include "geo/files/kept_parts.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

std::string names_of(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    std::ranges::sort(names);
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : " ") + name;
    return all;
}

TEST(KeptParts, ArePartsThatAreWhole) {
    const fs::path folder = test::scratch_folder() / "a.tiles";
    const auto parts = KeptParts::open(folder, "key");
    ASSERT_TRUE(parts.ok()) << parts.error().line();
    const std::vector<std::uint8_t> bytes(5000, 7);
    ASSERT_TRUE(parts->write("1-2-3", bytes).ok());
    EXPECT_EQ(names_of(folder), "1-2-3.tile tileset.key");
    EXPECT_EQ(parts->read("1-2-3").value(), bytes);
    EXPECT_FALSE(KeptParts::open(folder, "another key").ok());
    ASSERT_TRUE(parts->write("1-2-3", std::vector<std::uint8_t>(1, 8)).ok());
    EXPECT_EQ(parts->read("1-2-3").value(), std::vector<std::uint8_t>(1, 8));
    parts->remove();
    EXPECT_FALSE(fs::exists(folder));
}

// A disk that is full, here a limit of 1,000 bytes a file: "1-2-4.tile.PID" stayed until the next good run.
TEST(KeptParts, AWriteThatFailsLeavesNothing) {
    const fs::path folder = test::scratch_folder() / "a.tiles";
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const auto parts = KeptParts::open(folder, "key");
        const rlimit limit{1000, 1000};
        const bool is_right = parts.ok() && parts->write("1-2-3", std::vector<std::uint8_t>(900, 7)).ok() &&
                              setrlimit(RLIMIT_FSIZE, &limit) == 0 &&
                              !parts->write("1-2-4", std::vector<std::uint8_t>(100000, 7)).ok();
        _exit(is_right ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(names_of(folder), "1-2-3.tile tileset.key");
}

}  // namespace
}  // namespace oro

// Programs that are run and waited for.
#include "apps/output/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

namespace {

using oro::run_program;

TEST(ChildProcess, TellsHowAProgramEnded) {
    EXPECT_TRUE(run_program("", {"/bin/sh", "-c", "exit 0"}).ok());
    const auto failed = run_program("/", {"/bin/sh", "-c", "echo first; echo last >&2; exit 3"});
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().what, "ended with exit code 3: last");
    const auto killed = run_program("", {"/bin/sh", "-c", "kill -9 $$"});
    ASSERT_FALSE(killed.ok());
    EXPECT_EQ(killed.error().what, "ended with signal 9");
    const auto none = run_program("", {"/no/such/program"});
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().where, "/no/such/program");
    EXPECT_NE(none.error().what.find("cannot be started"), std::string::npos) << none.error().what;
}

TEST(ChildProcess, RunsInAFolderWithoutInput) {
    const auto ended = run_program("/", {"/bin/sh", "-c", "pwd; read line || exit 4"});
    ASSERT_FALSE(ended.ok());
    EXPECT_EQ(ended.error().what, "ended with exit code 4: /");
}

// More than a pipe holds, and the last line is kept.
TEST(ChildProcess, TakesAllThatIsPrinted) {
    const auto ended = run_program("", {"/bin/sh", "-c", "seq 100000; exit 1"});
    ASSERT_FALSE(ended.ok());
    EXPECT_EQ(ended.error().what, "ended with exit code 1: 100000");
}

TEST(ChildProcess, IsInterruptedWhereItIsAskedTo) {
    std::stop_source stop;
    int turns = 0;
    oro::ProgramWait wait;
    wait.stop = stop.get_token();
    wait.each_turn = [&] {
        if (++turns == 2) stop.request_stop();
    };
    const auto begun = std::chrono::steady_clock::now();
    const auto ended = run_program("", {"/bin/sh", "-c", "exec sleep 60"}, wait);
    ASSERT_FALSE(ended.ok());
    EXPECT_EQ(ended.error().what, "stopped");
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(30));
}

TEST(ChildProcess, KnowsItsOwnProgram) {
    const auto own = oro::own_program();
    ASSERT_TRUE(own.ok());
    EXPECT_EQ(std::filesystem::path(*own).filename().string().find("commands_tests"), 0U) << *own;
}

}  // namespace

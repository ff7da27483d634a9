// Threads that are not to be had: a user's or a container's limit. Pictures and files are the same with
// fewer.
#include <gtest/gtest.h>

#include "tests/faults/commands.h"

namespace {
using oro::test::Command;
using oro::test::Fault;
using oro::test::FaultRuns;

class FailedThreads : public testing::TestWithParam<Command (*)()> {};

TEST_P(FailedThreads, EachAndAllFromOneOn) {
    const Command command = GetParam()();
    FaultRuns runs(command, 3);
    for (const long period : {0, 1, 2}) {
        Fault fault{"thread"};
        fault.period = period;
        const long count = runs.count(fault);
        for (fault.number = 1; fault.number <= count; ++fault.number) EXPECT_EQ(runs.fault_of_run(fault), "");
    }
    EXPECT_EQ(runs.ended("exit 1"), 0) << "a thread less is no reason to give up";
    // But a software driver waits for ever for threads that it did not get, and is not begun with.
    if (command.words.front() != "shot") {
        EXPECT_EQ(runs.ended("exit 4"), 0);
    }
    std::printf("%s\n", runs.summary().c_str());
}

std::string name_of_start(const testing::TestParamInfo<Command (*)()>& info) {
    const std::vector<std::string> names{"Info", "Bake", "Shot", "ShotOfBaked"};
    return names[info.index];
}
INSTANTIATE_TEST_SUITE_P(Commands, FailedThreads,
                         testing::Values(oro::test::info_of_tiles, oro::test::bake_new,
                                         oro::test::shot_of_tiles, oro::test::shot_of_baked),
                         name_of_start);

}  // namespace

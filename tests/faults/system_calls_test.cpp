// Files that fail: each system call in turn, and all of a kind from one on.
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/faults/commands.h"
#include "tests/support/test_data.h"

namespace {
using oro::test::Command;
using oro::test::expect_order;
using oro::test::Fault;
using oro::test::FaultRuns;
using oro::test::runs_asked_for;

bool each() {
    return runs_asked_for() >= 1000;
}

class FailedSystemCalls : public testing::TestWithParam<Command (*)()> {};

TEST_P(FailedSystemCalls, OfAll) {
    FaultRuns runs(GetParam()(), 1);
    expect_order(runs, Fault{"system"}, each() ? runs_asked_for() : 0, runs_asked_for());
}

TEST_P(FailedSystemCalls, OfTheProgram) {
    FaultRuns runs(GetParam()(), 1);
    Fault fault{"system"};
    fault.own = true;
    expect_order(runs, fault, each() ? runs_asked_for() : 0, runs_asked_for());
}

// Few, and each with what it fails of in practice.
TEST_P(FailedSystemCalls, OfWriting) {
    FaultRuns runs(GetParam()(), 1);
    for (const auto& [name, error] :
         {std::pair{"rename", EACCES}, std::pair{"fsync", EIO}, std::pair{"write", ENOSPC},
          std::pair{"truncate", EFBIG}, std::pair{"close", EDQUOT}}) {
        Fault fault{name};
        fault.error = error;
        fault.own = true;
        if (runs.count(fault) > 0) expect_order(runs, fault, 10, runs_asked_for() / 3);
    }
}

TEST_P(FailedSystemCalls, AllOfAKindFromOneOn) {
    FaultRuns runs(GetParam()(), 1);
    for (const auto& [name, error] :
         {std::pair{"open", EMFILE}, std::pair{"read", EIO}, std::pair{"lseek", EIO},
          std::pair{"map", ENOMEM}, std::pair{"stat", EACCES}}) {
        Fault fault{name};
        fault.error = error;
        fault.period = 1;
        if (runs.count(fault) > 0) expect_order(runs, fault, 2, runs_asked_for() / 4);
    }
}

// Where the file system cannot tell whether the output is an input, the input stays.
TEST(FailedQuestions, LetNoInputBeReplaced) {
    const std::string region = oro::test::shot_of_baked().inputs.at("tile.oro");
    const std::filesystem::path folder = oro::test::scratch_folder(), file = folder / "region.png";
    oro::test::DisturbedProgram program(
        {"shot", "region.png", "-q", "--size", "64x48", "--overwrite", "--out", "region.png"}, folder, 1);
    Fault fault{"stat"};
    fault.own = true;
    for (long count = 0; fault.number <= count; ++fault.number) {
        std::ofstream(file, std::ios::binary) << region;
        const oro::test::Disturbed run = program.run(fault);
        if (fault.number == 0) count = run.counted;
        EXPECT_TRUE(run.exit_code == 1 || run.exit_code == 2) << fault.line() << ": " << run.exit_code;
        std::ostringstream left;
        left << std::ifstream(file, std::ios::binary).rdbuf();
        EXPECT_TRUE(left.str() == region) << fault.line();
    }
    EXPECT_GT(fault.number, 10);
}

std::string name_of_calls(const testing::TestParamInfo<Command (*)()>& info) {
    const std::vector<std::string> names{"Info",
                                         "InfoOfBaked",
                                         "Bake",
                                         "BakeAgain",
                                         "Shot",
                                         "ShotOfBaked",
                                         "Viewshed",
                                         "Profile",
                                         "Export",
                                         "Horizon",
                                         "ViewshedOfTable",
                                         "InfoOfMesh",
                                         "BakeWithMesh",
                                         "InfoOfBakedMesh"};
    return names[info.index];
}
INSTANTIATE_TEST_SUITE_P(Commands, FailedSystemCalls,
                         testing::Values(oro::test::info_of_tiles, oro::test::info_of_baked,
                                         oro::test::bake_new, oro::test::bake_again, oro::test::shot_of_tiles,
                                         oro::test::shot_of_baked, oro::test::viewshed_of_tiles,
                                         oro::test::profile_of_tiles, oro::test::export_of_tiles,
                                         oro::test::horizon_of_tiles, oro::test::viewshed_of_table,
                                         oro::test::info_of_mesh, oro::test::bake_with_mesh,
                                         oro::test::info_of_baked_mesh),
                         name_of_calls);

}  // namespace

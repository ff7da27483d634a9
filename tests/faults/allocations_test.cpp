// Memory that runs out: each allocation in turn, all from one on, and one in six.
#include <gtest/gtest.h>

#include "tests/faults/commands.h"

namespace {
using oro::test::Command;
using oro::test::expect_order;
using oro::test::Fault;
using oro::test::FaultRuns;
using oro::test::runs_asked_for;

class FailedAllocations : public testing::TestWithParam<Command (*)()> {};

// The program's own, which it must be able to do without; the first of them, and some of all others.
TEST_P(FailedAllocations, OfTheProgram) {
    FaultRuns runs(GetParam()(), 1);
    Fault fault{"allocation"};
    fault.own = true;
    const bool each = runs_asked_for() >= 1000;
    expect_order(runs, fault, each ? runs_asked_for() : 0, runs_asked_for() / (each ? 2 : 1));
}

// Those of the program and of the libraries that it uses.
TEST_P(FailedAllocations, OfAll) {
    FaultRuns runs(GetParam()(), 1);
    const bool each = runs_asked_for() >= 1000;
    expect_order(runs, Fault{"allocation"}, each ? runs_asked_for() : 0, runs_asked_for() / (each ? 2 : 1));
}

TEST_P(FailedAllocations, AllFromOneOn) {
    FaultRuns runs(GetParam()(), 2);
    Fault fault{"allocation"};
    fault.period = 1;
    expect_order(runs, fault, 5, runs_asked_for() / 2);
}

TEST_P(FailedAllocations, OneInSix) {
    FaultRuns runs(GetParam()(), 2);
    Fault fault{"allocation"};
    fault.period = 6;
    expect_order(runs, fault, 5, runs_asked_for() / 2);
}

std::string name_of_loss(const testing::TestParamInfo<Command (*)()>& info) {
    const std::vector<std::string> names{"Info",        "Bake",         "Shot",
                                         "ShotOfBaked", "Viewshed",     "ViewshedOfTable",
                                         "InfoOfMesh",  "BakeWithMesh", "InfoOfBakedMesh"};
    return names[info.index];
}

void expect_order_of_all(const Command& command, const char* calls, bool own) {
    FaultRuns runs(command, 1);
    Fault fault{calls};
    fault.own = own;
    expect_order(runs, fault, runs.count(fault), 0);
}

// Of the C library's allocations for the program comes no exception but an error code, which could pass for
// an answer ("no such file").
class FailedAllocationsOfC : public testing::TestWithParam<Command (*)()> {};

TEST_P(FailedAllocationsOfC, ForTheProgram) {
    expect_order_of_all(GetParam()(), "by:libc.so", true);
}

// libpng leaves out a tag that it has no memory for, and only warns.
TEST(FailedAllocationsOfLibpng, ForAPicture) {
    expect_order_of_all(oro::test::shot_of_tiles(), "by:libpng", false);
}

// A picture with a letter missing would be another picture.
TEST(FailedAllocationsOfFreetype, ForLabels) {
    FaultRuns runs(oro::test::shot_with_labels(), 1);
    expect_order(runs, Fault{"by:libfreetype"}, 0, runs_asked_for() >= 1000 ? 1000 : runs_asked_for());
}

INSTANTIATE_TEST_SUITE_P(Commands, FailedAllocationsOfC,
                         testing::Values(oro::test::info_of_tiles, oro::test::bake_new,
                                         oro::test::shot_of_tiles),
                         name_of_loss);
INSTANTIATE_TEST_SUITE_P(Commands, FailedAllocations,
                         testing::Values(oro::test::info_of_tiles, oro::test::bake_new,
                                         oro::test::shot_of_tiles, oro::test::shot_of_baked,
                                         oro::test::viewshed_of_tiles, oro::test::viewshed_of_table,
                                         oro::test::info_of_mesh, oro::test::bake_with_mesh,
                                         oro::test::info_of_baked_mesh),
                         name_of_loss);

}  // namespace

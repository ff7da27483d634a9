// bake --shard and bake --join: the bytes of one machine.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/baked/baking.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::Bake;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::Words;
using oro::test::write_bytes;

class SharedBakeCommand : public Bake {
  protected:
    const fs::path out_ = folder / "joined.oro";
    [[nodiscard]] Outcome bake(const Words& data, const Words& more) const {
        return run_orograph(joined(joined({"bake", "--out", out_.string()}, data), more));
    }
    // Bakes data at once, and from parts.
    void expect_same_bytes(const Words& data, int count, const Words& more = {}) const {
        const fs::path whole = folder / "whole.oro";
        const Outcome at_once =
            run_orograph(joined(joined({"bake", "--out", whole.string(), "-q", "--overwrite"}, data), more));
        ASSERT_EQ(at_once.exit_code, 0) << at_once.err;
        for (int number = 1; number <= count; ++number) {
            const std::string part = std::to_string(number) + "/" + std::to_string(count);
            const Outcome shard = bake(data, joined({"--shard", part, "--json", "-q"}, more));
            ASSERT_EQ(shard.exit_code, 0) << shard.err;
            EXPECT_EQ(json::parse(shard.out)["shard"]["number"], number);
            EXPECT_FALSE(fs::exists(out_));
        }
        const Outcome join = bake(data, joined({"--join", "-q"}, more));
        ASSERT_EQ(join.exit_code, 0) << join.err;
        EXPECT_TRUE(bytes_of(out_) == bytes_of(whole)) << count << " parts";
        fs::remove(out_);
        fs::remove(whole);
        EXPECT_EQ(names_in(folder), leftovers_);
    }
    Words leftovers_;
};

TEST_F(SharedBakeCommand, HasTheBytesOfOneMachine) {
    expect_same_bytes({bundled()}, 1);
    expect_same_bytes({bundled()}, 3);
    expect_same_bytes({bundled()}, 2, {"--mesh", "clusters"});
}

// Two grids, far apart.
TEST_F(SharedBakeCommand, HasTheBytesOfOneMachineOfSeveralGrids) {
    const fs::path tile = file("N10E020.hgt", oro::test::hills());
    leftovers_ = {"N10E020.hgt"};
    expect_same_bytes({bundled(), tile.string()}, 2);
}

TEST_F(SharedBakeCommand, WhatDoesNotFitIsRefused) {
    const Words data{bundled()};
    expect_refusal(bake(data, {"--join", "-q"}), 1, {"part-1of1", "bake --shard writes them"});
    ASSERT_EQ(bake(data, {"--shard", "1/2", "-q"}).exit_code, 0);
    const Outcome missing = bake(data, {"--join", "-q"});
    expect_refusal(missing, 1, {"joined.oro.part-2of2: is not there: bake --shard 2/2 writes it"});
    expect_refusal(bake(data, {"--shard", "1/2", "--join"}), 2, {"--shard", "--join"});
    expect_refusal(bake(data, {"--shard", "2"}), 2, {"--shard 2: must be NUMBER/COUNT"});
    // A part of other data.
    ASSERT_EQ(bake(data, {"--shard", "2/2", "-q", "--bbox", "-84.3,36.5,-84.2,36.6"}).exit_code, 0);
    expect_refusal(bake(data, {"--join", "-q"}), 1, {"part-2of2: is a part of other data"});
    // The same command goes on.
    const Outcome again = bake(data, {"--shard", "1/2"});
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_TRUE(says(again.err, "is there already: ")) << again.err;
    write_bytes(folder / "joined.oro.part-2of2", "mine");
    expect_refusal(bake(data, {"--shard", "2/2", "-q"}), 1, {"no bake has left it behind"});
    EXPECT_EQ(bytes_of(folder / "joined.oro.part-2of2"), "mine");
}

}  // namespace

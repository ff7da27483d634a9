// A bake that is stopped at any moment leaves no half file, and goes on where it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/apps/baked/baking.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::Bake;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::joined;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;
using oro::test::write_bytes;

// Bakes that take their time, to be broken off.
class BrokenOffBake : public Bake {
  protected:
    void SetUp() override {
        // The corner where four tiles meet, of real data where there are such: the bundled region is baked
        // before a kill can meet it.
        const auto alps = oro::test::real_data("alps");
        input_ = alps ? Words{*alps, "--bbox", "6.5,46.5,7.5,47.5"} : made_tiles();
        for (int i = 0; i < 3; ++i) {
            const auto start = std::chrono::steady_clock::now();
            const Outcome outcome = run({}, {"-q", "--overwrite"});
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
            ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
            duration_s_ = i == 0 ? took.count() : std::min(duration_s_, took.count());
        }
        whole_ = bytes_of(out_);
        fs::remove(out_);
        std::printf("seed %u, a bake takes %.2f s\n", seed_, duration_s_);
    }
    void TearDown() override { fs::remove_all(tiles_); }
    Words made_tiles() const {
        fs::create_directories(tiles_);
        for (const char* name : {"N10E020.hgt", "N10E021.hgt", "N11E020.hgt", "N11E021.hgt"})
            write_bytes(tiles_ / name, oro::test::hills());
        return {tiles_.string(), "--bbox", "20.5,10.5,21.5,11.5"};
    }
    Outcome run(const Circumstances& circumstances, const Words& more = {"-q"}) const {
        return run_orograph(joined(joined({"bake", "--out", out_}, input_), more), circumstances);
    }

    Words input_;
    const fs::path tiles_ =
        folder.string() + "-tiles";  // beside: nothing but the bake's own lies in `folder`
    const fs::path out_ = folder / "region.oro";
    std::string whole_;  // what an uninterrupted bake writes
    double duration_s_{};
    const unsigned seed_{std::random_device{}()};
    std::mt19937 random_{seed_};
};

// Under the name there is nothing, or what was there before, or a whole file; and the same command, once it
// may, writes what it would have written at once.
TEST_F(BrokenOffBake, KilledAtAnyMoment) {
    constexpr int kills = 20, most_kills = 80;
    const std::string old = "what was there";
    int went_on = 0;
    // A bake writes its pages in a moment that 20 kills may all miss: then there are more.
    int i = 0;
    for (; i < kills || (went_on == 0 && i < most_kills); ++i) {
        const bool replaces = i % 2 == 1;
        const Words how = replaces ? Words{"-q", "--json", "--overwrite"} : Words{"-q", "--json"};
        Circumstances broken_off;
        broken_off.signal = SIGKILL;
        broken_off.signal_after_s =
            duration_s_ * (i % kills + std::uniform_real_distribution<double>(0.0, 1.0)(random_)) / kills;
        const auto kill = [&] {
            fs::remove(out_);
            if (replaces) write_bytes(out_, old);
            return run(broken_off, how).exit_code;
        };
        int exit_code = kill();
        // Faster than it was: it has to be killed earlier.
        for (; exit_code == 0; exit_code = kill()) broken_off.signal_after_s *= 0.9;
        SCOPED_TRACE(testing::Message()
                     << "seed " << seed_ << ", killed after " << broken_off.signal_after_s << " s");
        ASSERT_EQ(exit_code, 128 + SIGKILL);
        const std::string found = fs::exists(out_) ? bytes_of(out_) : "";
        EXPECT_TRUE(found == (replaces ? old : "") || found == whole_);
        if (found == whole_) {
            EXPECT_EQ(run_orograph({"info", out_, "--check"}).exit_code, 0);
        } else {
            const Outcome second = run({}, how);
            ASSERT_EQ(second.exit_code, 0) << second.err;
            went_on += json::parse(second.out)["pages"]["of_a_bake_broken_off"] > 0 ? 1 : 0;
        }
        EXPECT_TRUE(bytes_of(out_) == whole_);
        EXPECT_EQ(names_in(folder), Words{"region.oro"});
    }
    std::printf("%d of %d had pages to go on from\n", went_on, i);
    EXPECT_GE(went_on, 1) << "seed " << seed_;
}

// One bake, broken off again and again, comes to its end all the same.
TEST_F(BrokenOffBake, InterruptedAgainAndAgain) {
    const std::vector<int> signals{SIGINT, SIGTERM, SIGHUP, SIGKILL};
    int interrupted = 0;
    for (int i = 0; i < 12 && !fs::exists(out_); ++i) {
        Circumstances broken_off;
        broken_off.signal = signals[static_cast<std::size_t>(i) % signals.size()];
        broken_off.signal_after_s = duration_s_ * std::uniform_real_distribution<double>(0.4, 0.8)(random_);
        SCOPED_TRACE(testing::Message() << "seed " << seed_ << ", signal " << broken_off.signal << " after "
                                        << broken_off.signal_after_s << " s");
        const Outcome outcome = run(broken_off);
        if (outcome.exit_code == 0 && interrupted == 0) {
            // Faster than it was: it has to be interrupted earlier.
            duration_s_ *= 0.7;
            fs::remove(out_);
            continue;
        }
        if (outcome.exit_code == 0) break;
        EXPECT_EQ(outcome.exit_code, 128 + broken_off.signal) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        ++interrupted;
        for (const std::string& name : names_in(folder))
            EXPECT_TRUE(name.rfind("region.oro", 0) == 0) << name << " was left behind";
    }
    EXPECT_GE(interrupted, 1) << "seed " << seed_;
    const bool had_pages = fs::exists(folder / "region.oro.partial") &&
                           fs::file_size(folder / "region.oro.partial") > whole_.size() / 4;
    if (!fs::exists(out_)) {
        const Outcome last = run({}, {});
        ASSERT_EQ(last.exit_code, 0) << last.err;
        if (had_pages) {
            EXPECT_NE(last.err.find("went on from page "), std::string::npos) << last.err;
        }
    }
    EXPECT_TRUE(bytes_of(out_) == whole_);
    EXPECT_EQ(names_in(folder), Words{"region.oro"});
}

}  // namespace

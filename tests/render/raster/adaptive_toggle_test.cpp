#include "render/raster/adaptive_toggle.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace oro {
namespace {

// Frames of a view: each takes a little more than it should, and one in eight twice as long, because of
// something else.
struct Frames {
    std::mt19937 random;
    double with, without;
    AdaptiveToggle way;

    // How many of so many frames went without it.
    int without_of(int count) {
        int went = 0;
        for (int i = 0; i < count; ++i) {
            const bool goes = way.disable_next();
            went += goes ? 1 : 0;
            const double held_up = random() % 8 == 0 ? 1.0 : 0.0;
            const double noise = 0.02 * std::uniform_real_distribution<double>()(random);
            way.report_time(!goes, (goes ? without : with) * (1.0 + noise + held_up));
        }
        return went;
    }
};

TEST(AdaptiveToggle, IsFoundAmongFramesThatAreHeldUp) {
    constexpr unsigned seed = 7;
    int slower_frames = 0, all = 0;
    for (unsigned view = 0; view < 200; ++view) {
        Frames frames{std::mt19937(seed + view), view % 2 == 0 ? 1.0 : 1.1, view % 2 == 0 ? 1.1 : 1.0, {}};
        const int without = frames.without_of(500);
        slower_frames += view % 2 == 0 ? without : 500 - without;
        all += 500;
    }
    std::printf("seed %u: %d of %d frames by the slower way\n", seed, slower_frames, all);
    // Six trials of three frames are 3.6 %; the rest are mistakes.
    EXPECT_LT(slower_frames, all / 20);
}

TEST(AdaptiveToggle, FollowsAViewThatChanges) {
    Frames frames{std::mt19937(3), 1.0, 2.0, {}};
    EXPECT_LT(frames.without_of(100), 15);
    frames.with = 3.0;
    frames.without_of(100);  // until the next trial
    EXPECT_GT(frames.without_of(100), 85);
}

TEST(AdaptiveToggle, BeginsWithItAndTriesBoth) {
    AdaptiveToggle way;
    for (const bool without : {false, false, false, true, true, true}) {
        EXPECT_EQ(way.disable_next(), without);
        way.report_time(!without, without ? 0.5 : 1.0);
    }
    EXPECT_TRUE(way.disable_next());
    way.forget();
    EXPECT_FALSE(way.disable_next());
}

}  // namespace
}  // namespace oro

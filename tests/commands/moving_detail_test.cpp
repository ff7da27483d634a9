// What of a picture's detail yields while the eye of a window moves.
#include <gtest/gtest.h>

#include "apps/window/detail.h"

namespace {
using oro::DetailStep;
using oro::MovingDetail;

// Frames of a machine that takes pixel_s for each pixel of the window and fixed_s for each frame, until their
// time has settled.
double settled_s(MovingDetail& detail, double fixed_s, double pixel_s) {
    double frame_s = 0.0;
    for (int i = 0; i < 300; ++i) {
        const DetailStep step = detail.now();
        frame_s = fixed_s + pixel_s * step.scale * step.scale;
        detail.took(step, frame_s);
    }
    return frame_s;
}

TEST(MovingDetail, IsWholeWhereTheMachineIsFastEnough) {
    MovingDetail detail;
    settled_s(detail, 0.005, 0.02);
    EXPECT_TRUE(detail.now().is_whole());
}

TEST(MovingDetail, YieldsAtOnceToTheBudget) {
    MovingDetail detail;
    // Whole frames take 0.35 s: three a second.
    detail.took(detail.now(), 0.35);
    const DetailStep next = detail.now();
    EXPECT_LE(0.02 + 0.33 * next.scale * next.scale, 1.5 * MovingDetail::budget_s);
    EXPECT_LE(settled_s(detail, 0.02, 0.33), MovingDetail::budget_s);
}

// Neither finer than the budget allows, nor to and fro for ever.
TEST(MovingDetail, StaysWhereItIsRight) {
    MovingDetail detail;
    settled_s(detail, 0.01, 0.2);
    const DetailStep step = detail.now();
    int changes = 0;
    double scale = step.scale;
    for (int i = 0; i < 200; ++i) {
        const DetailStep now = detail.now();
        changes += now.scale != scale ? 1 : 0;
        scale = now.scale;
        detail.took(now, 0.01 + 0.2 * now.scale * now.scale);
    }
    EXPECT_LE(changes, 4);
    EXPECT_LT(step.scale, 1.0);
}

TEST(MovingDetail, ComesBackOnceThereIsRoom) {
    MovingDetail detail;
    settled_s(detail, 0.02, 0.5);
    EXPECT_LT(detail.now().scale, 0.7);
    settled_s(detail, 0.004, 0.01);
    EXPECT_TRUE(detail.now().is_whole());
}

TEST(MovingDetail, HasAnEndWhereNothingHelps) {
    MovingDetail detail;
    settled_s(detail, 1.0, 1.0);
    EXPECT_EQ(detail.now().scale, oro::detail_steps.back().scale);
}

// Of far ground a frame with means of pixels takes three times one without, on the software driver, however
// few its pixels are.
TEST(MovingDetail, LeavesMeansOutWhereTheyTakeTooLong) {
    MovingDetail detail;
    const auto frame_s = [](const DetailStep& step) { return step.means ? 0.19 : 0.055; };
    for (int frame = 0; frame < 20; ++frame) detail.took(detail.now(), frame_s(detail.now()));
    for (int frame = 0; frame < 200; ++frame) {
        EXPECT_FALSE(detail.now().means) << "frame " << frame;
        detail.took(detail.now(), frame_s(detail.now()));
    }
}

TEST(MovingDetail, MayBeginWithLeast) {
    MovingDetail detail;
    detail.begin_with_least();
    EXPECT_EQ(detail.now().scale, oro::detail_steps.back().scale);
    // Quick frames bring it back, step by step.
    for (int frame = 0; frame < 200; ++frame) detail.took(detail.now(), 0.01);
    EXPECT_TRUE(detail.now().is_whole());
}

}  // namespace

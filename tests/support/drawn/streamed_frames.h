// Frames of a scene that does not wait for what they lack, as a window draws them.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "tests/support/drawn/drawn_scene.h"

namespace oro::test {

struct StreamedFrames {
    DrawnFrame last;
    int frames{};
    int coarser{};  // frames of clusters that lacked some
};

// Draws frames until one is settled, or nothing that is seen has come for a while. each: of every frame.
// tells: the scene is told what they show.
inline StreamedFrames stream_frames(DrawnScene& drawn, const Camera& camera, double tau_px,
                                    const std::function<void(const DrawnFrame& frame)>& each,
                                    const gpu::FrameStyle& style = {}, bool tells = true,
                                    int turns_without_news = 100) {
    constexpr int most_frames = 2000;
    StreamedFrames streamed;
    for (bool is_over = false; !is_over && streamed.frames < most_frames;) {
        streamed.last = drawn.draw_what_is_here(camera, tau_px, style);
        ++streamed.frames;
        streamed.coarser += streamed.last.plan.grids[0].clusters.missing > 0 ? 1 : 0;
        each(streamed.last);
        if (tells) drawn.scene().apply_feedback(streamed.last.report.feedback);
        is_over = streamed.last.plan.is_settled();
        for (int turn = 0; !is_over; ++turn) {
            const auto better = drawn.scene().advance();
            EXPECT_TRUE(better.ok()) << better.error().line();
            if (!better.ok() || turn == turns_without_news) is_over = true;
            if (better.ok() && *better) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    EXPECT_LT(streamed.frames, most_frames);
    return streamed;
}

}  // namespace oro::test

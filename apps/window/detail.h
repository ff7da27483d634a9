// What of a picture's detail yields while the eye moves: pure, tested without a window.
#pragma once

#include <array>
#include <cstddef>

namespace oro {

// How a frame is drawn: `scale` times as many pixels a side as the window has, and tau_factor times the
// view's tau, of these pixels; with shadows and trees, and with each pixel the mean of what it covers, where
// the view has it so.
struct DetailStep {
    double scale{1.0};
    double tau_factor{1.0};
    bool shadows{true};
    bool means{true};
    [[nodiscard]] bool is_whole() const { return scale == 1.0 && tau_factor == 1.0; }
};

// From all of it to the least. Every step takes about two thirds of the pixels of the one before it, and the
// last two leave shadows and trees out, and then means of pixels: where a processor draws, far ground takes
// most of a frame by them.
inline constexpr std::array<DetailStep, 9> detail_steps{{{1.0, 1.0},
                                                         {1.0, 2.0},
                                                         {0.8, 2.0},
                                                         {0.66, 2.0},
                                                         {0.54, 2.0},
                                                         {0.44, 2.0},
                                                         {0.36, 2.0},
                                                         {0.36, 2.0, false},
                                                         {0.36, 2.0, false, false}}};

// Holds frames of an eye that moves within a budget of time. An eye that rests has all detail.
class MovingDetail {
  public:
    static constexpr double budget_s = 0.066;

    // The step that the next frame of a moving eye is drawn at.
    [[nodiscard]] const DetailStep& now() const { return detail_steps[step_]; }
    // Where a processor draws: with the least detail, until frames are seen to leave room for more.
    void begin_with_least() { step_ = detail_steps.size() - 1; }
    // Told how long a frame took that was drawn at a step: a slower one than the budget makes the next ones
    // coarser at once, by as many steps as its time asks for; frames in less than half of it make them finer
    // by one step after a while, so that detail does not go to and fro.
    void took(const DetailStep& step, double frame_s);

  private:
    std::size_t step_{};
    int quick_{};  // frames in a row that left room
};

}  // namespace oro

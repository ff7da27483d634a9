// Which of two ways to the same picture took less time, found by trying both now and then.
#pragma once

#include <cstdint>

namespace oro {

// With or without something that saves work and costs some. Each way is tried for a few frames, and the
// shorter goes on; both are tried again after a while, each time after twice as long. A single frame that
// something else held up decides nothing: of each trial the least time counts.
class AdaptiveToggle {
  public:
    // For the next frame. A trial of both begins with the way that has it.
    [[nodiscard]] bool disable_next();
    // What a frame took, in any unit.
    void report_time(bool with, double time);
    // Another view, of which nothing is known.
    void forget() { *this = {}; }

  private:
    static constexpr int trial_frames = 3;
    // Frames until the next trial: at first, and at most.
    static constexpr std::uint32_t first_patience = 16, most_patience = 1024;
    struct Trial {
        int frames{};
        double least{};
    };
    Trial with_, without_;
    std::uint32_t wait_{first_patience}, patience_{first_patience};
};

}  // namespace oro

#include "render/raster/adaptive_toggle.h"

#include <algorithm>

namespace oro {

bool AdaptiveToggle::disable_next() {
    if (with_.frames < trial_frames) return false;
    if (without_.frames < trial_frames) return true;
    if (wait_ == 0) {
        wait_ = patience_ = std::min(2 * patience_, most_patience);
        with_ = without_ = {};
        return false;
    }
    --wait_;
    return without_.least < with_.least;
}

void AdaptiveToggle::report_time(bool with, double time) {
    Trial& trial = with ? with_ : without_;
    if (trial.frames == trial_frames) return;  // its trial is over
    trial.least = trial.frames == 0 ? time : std::min(trial.least, time);
    ++trial.frames;
}

}  // namespace oro

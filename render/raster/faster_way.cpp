#include "render/raster/faster_way.h"

#include <algorithm>

namespace oro {

bool FasterWay::goes_without() {
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

void FasterWay::took(bool with, double time) {
    Trial& trial = with ? with_ : without_;
    if (trial.frames == trial_frames) return;  // its trial is over
    trial.least = trial.frames == 0 ? time : std::min(trial.least, time);
    ++trial.frames;
}

}  // namespace oro

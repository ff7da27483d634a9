#include "apps/window/detail.h"

namespace oro {
namespace {

double share_of_pixels(const DetailStep& step) {
    return step.scale * step.scale;
}

bool has_all_effects(const DetailStep& step) {
    return step.shadows && step.means;
}

}  // namespace

void MovingDetail::took(const DetailStep& step, double frame_s) {
    constexpr int quick_enough = 8;
    // Effects come back where there is ample room alone, or they would come and go.
    const double room = has_all_effects(now()) ? 0.55 : 0.2;
    // What does not follow the number of pixels.
    constexpr double fixed_share = 0.15;
    if (frame_s > budget_s) {
        quick_ = 0;
        const auto expected_s = [&](std::size_t at) {
            const double pixels = share_of_pixels(detail_steps[at]) / share_of_pixels(step);
            return frame_s * (fixed_share + (1.0 - fixed_share) * pixels);
        };
        // Never finer for a frame that was too slow; the next one at least where it was drawn at this step.
        if (step_ + 1 < detail_steps.size() && share_of_pixels(step) <= share_of_pixels(now()) &&
            step.tau_factor >= now().tau_factor)
            ++step_;
        while (step_ + 1 < detail_steps.size() && expected_s(step_) > budget_s) ++step_;
        return;
    }
    quick_ = frame_s < room * budget_s ? quick_ + 1 : 0;
    if (quick_ < quick_enough || step_ == 0) return;
    quick_ = 0;
    --step_;
}

}  // namespace oro

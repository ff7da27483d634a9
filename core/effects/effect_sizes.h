// How an effect's sizes at many samples become one. Within core/effects.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/median.h"
#include "core/effects/effects.h"

namespace oro {

// What lies between the samples: bounds that come from samples are widened by this where the samples look
// through gaps between hills as well.
inline constexpr double between_samples = 1.5;
// The factor where what is drawn was not looked at itself, but what is truly seen.
inline constexpr double unlike_the_truth = 2.5;
// Ground between the samples may be somewhat nearer than at them.
inline constexpr double nearer = 1.3;
// Ground behind edges that is farther from them comes out only where it is moved farther.
inline constexpr double in_gaps_px = 1.5;

// Collects one effect's sizes at the samples.
class Sizes {
  public:
    // even: counts for the median.
    void add(double metres, double px, bool even) {
        worst_m_ = worse(worst_m_, metres);
        worst_px_ = worse(worst_px_, px);
        if (!even) return;
        metres_.push_back(metres);
        px_.push_back(px);
    }
    // The bound is the largest times `margin`. Uses the values up.
    EffectSize size(double margin) {
        EffectSize size{margin * worst_m_, 0.0, margin * worst_px_, 0.0, 0.0, worst_px_};
        if (px_.empty()) return size;
        const std::size_t p99 = (px_.size() - 1) * 99 / 100;
        std::nth_element(px_.begin(), px_.begin() + static_cast<std::ptrdiff_t>(p99), px_.end());
        size.p99_px = px_[p99];
        size.typical_m = median_of(std::move(metres_));
        size.typical_px = median_of(std::move(px_));
        return size;
    }

  private:
    // What is no number stays: a bound that leaves it out would hold nothing.
    static double worse(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

    double worst_m_{};
    double worst_px_{};
    std::vector<double> metres_;
    std::vector<double> px_;
};

}  // namespace oro

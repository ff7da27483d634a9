// A logarithmic axis that keeps what a logarithm drops: zeros, and values that are missing.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace oro {

struct AxisTick {
    double px{};
    std::string label;
};

class LogAxis {
  public:
    // Goes from `from_px`, the low end, to `to_px`; `to_px` may be the smaller. What is not finite, or below
    // 0, is missing.
    LogAxis(std::span<const double> values, double from_px, double to_px);
    // In the band of zeros, of missing values, or on the scale; always finite and between the two ends.
    [[nodiscard]] double at(double value) const;
    [[nodiscard]] const std::vector<AxisTick>& ticks() const { return ticks_; }

    struct Band {
        double from_px{}, to_px{};
        std::string label;
    };
    // "0" and "n/a", those that values lie in.
    [[nodiscard]] const std::vector<Band>& bands() const { return bands_; }

  private:
    void add_ticks();

    double from_px_, to_px_;  // of the scale: the bands lie before it
    double low_log_, high_log_;
    double zero_px_, missing_px_;
    std::vector<AxisTick> ticks_;
    std::vector<Band> bands_;
};

}  // namespace oro

#include "apps/film/monotone_cubic.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace oro {
namespace {

// At an end: widths and secants of the two intervals next to it, the outer one first.
double end_slope(double outer_width, double inner_width, double outer, double inner) {
    const double slope =
        ((2.0 * outer_width + inner_width) * outer - outer_width * inner) / (outer_width + inner_width);
    if (slope * outer <= 0.0) return 0.0;
    if (outer * inner <= 0.0 && std::abs(slope) > 3.0 * std::abs(outer)) return 3.0 * outer;
    return slope;
}

}  // namespace

MonotoneCubic::MonotoneCubic(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), slope_(x_.size(), 0.0) {
    assert(!x_.empty() && x_.size() == y_.size());
    const std::size_t last = x_.size() - 1;
    if (last == 0) return;
    std::vector<double> width(last), secant(last);
    for (std::size_t i = 0; i < last; ++i) {
        width[i] = x_[i + 1] - x_[i];
        assert(width[i] > 0.0);
        secant[i] = (y_[i + 1] - y_[i]) / width[i];
    }
    if (last == 1) {
        slope_ = {secant[0], secant[0]};
        return;
    }
    for (std::size_t i = 1; i < last; ++i) {
        if (secant[i - 1] * secant[i] <= 0.0) continue;
        const double before = 2.0 * width[i] + width[i - 1], behind = width[i] + 2.0 * width[i - 1];
        slope_[i] = (before + behind) / (before / secant[i - 1] + behind / secant[i]);
    }
    slope_[0] = end_slope(width[0], width[1], secant[0], secant[1]);
    slope_[last] = end_slope(width[last - 1], width[last - 2], secant[last - 1], secant[last - 2]);
}

double MonotoneCubic::at(double x) const {
    if (x <= x_.front()) return y_.front();
    if (x >= x_.back()) return y_.back();
    const auto i = static_cast<std::size_t>(std::ranges::upper_bound(x_, x) - x_.begin()) - 1;
    const double width = x_[i + 1] - x_[i], part = (x - x_[i]) / width, rest = 1.0 - part;
    const double value = rest * rest * ((1.0 + 2.0 * part) * y_[i] + part * width * slope_[i]) +
                         part * part * ((1.0 + 2.0 * rest) * y_[i + 1] - rest * width * slope_[i + 1]);
    // Rounding leads no further than the values do.
    return std::clamp(value, std::min(y_[i], y_[i + 1]), std::max(y_[i], y_[i + 1]));
}

}  // namespace oro

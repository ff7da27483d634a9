#include "apps/trade_axis.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace oro {
namespace {

constexpr double band_px = 34.0;
constexpr double least_decades = 0.35;
constexpr double margin = 0.06;  // of the scale, free beyond the outermost values

std::string tick_label(double value) {
    std::array<char, 400> text{};
    const auto format =
        value < 1e-4 || value >= 1e6 ? std::chars_format::scientific : std::chars_format::fixed;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format);
    std::string label(text.data(), end.ptr);
    if (const auto e = label.find("e-0"); e != std::string::npos) label.erase(e + 2, 1);
    if (const auto e = label.find("e+"); e != std::string::npos)
        label.erase(e + 1, label[e + 2] == '0' ? 2 : 1);
    return label;
}

// mantissa * 10^power as the nearest double.
double tick_value(double mantissa, int power) {
    return power < 0 ? mantissa / std::pow(10.0, -power) : mantissa * std::pow(10.0, power);
}

std::span<const double> mantissas_for(double decades) {
    static constexpr std::array close{1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0};
    static constexpr std::array middle{1.0, 1.5, 2.0, 3.0, 5.0, 7.0};
    static constexpr std::array wide{1.0, 2.0, 5.0};
    static constexpr std::array powers{1.0};
    if (decades < 0.6) return close;
    if (decades < 1.3) return middle;
    if (decades < 3.2) return wide;
    return powers;
}

}  // namespace

LogAxis::LogAxis(std::span<const double> values, double from_px, double to_px)
    : from_px_(from_px), to_px_(to_px), zero_px_(from_px), missing_px_(from_px) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    bool zeros = false;
    bool missing = false;
    for (const double value : values) {
        zeros = zeros || value == 0.0;
        if (!std::isfinite(value) || value < 0.0) {
            missing = true;
        } else if (value > 0.0) {
            least = std::min(least, value);
            most = std::max(most, value);
        }
    }
    const double direction = to_px > from_px ? 1.0 : -1.0;
    const auto band = [&](const char* label) {
        const double start = from_px_;
        from_px_ += direction * band_px;
        bands_.push_back({start, from_px_, label});
        return (start + from_px_) / 2.0;
    };
    if (missing) missing_px_ = band("n/a");
    if (zeros) zero_px_ = band("0");
    if (most == 0.0) least = most = 1.0;
    low_log_ = std::log10(least);
    high_log_ = std::log10(most);
    const double short_of = std::max(0.0, least_decades - (high_log_ - low_log_));
    const double free = short_of / 2.0 + margin * (high_log_ - low_log_ + short_of);
    low_log_ -= free;
    high_log_ += free;
    add_ticks();
}

double LogAxis::at(double value) const {
    if (value == 0.0) return zero_px_;
    if (!std::isfinite(value) || value < 0.0) return missing_px_;
    const double share = std::clamp((std::log10(value) - low_log_) / (high_log_ - low_log_), 0.0, 1.0);
    return from_px_ + share * (to_px_ - from_px_);
}

void LogAxis::add_ticks() {
    const double decades = high_log_ - low_log_;
    const std::span<const double> mantissas = mantissas_for(decades);
    const int step = std::max(1, static_cast<int>(std::ceil(decades / 9.0)));
    const int first = static_cast<int>(std::floor(low_log_));
    for (int power = first; power <= static_cast<int>(std::floor(high_log_)); ++power) {
        if (power % step != 0) continue;
        for (const double mantissa : mantissas) {
            const double value = tick_value(mantissa, power);
            const double place = std::log10(value);
            if (place < low_log_ || place > high_log_) continue;
            ticks_.push_back({at(value), tick_label(value)});
        }
    }
}

}  // namespace oro

#include "apps/report/figures.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace oro {
namespace {

std::string fixed(double value, int decimals) {
    std::array<char, 400> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
    return {text.data(), end.ptr};
}

// "4.2e-5": to_chars writes two digits of the power at least, and a plus.
std::string in_powers(double value) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 1);
    std::string power(text.data(), end.ptr);
    const std::size_t at = power.find('e') + 1;
    const bool small = power[at] == '-';
    power.erase(at, power[at + 1] == '0' ? 2 : 1);
    return small ? power.insert(at, "-") : power;
}

// "2.50" is "2.5", "2.0" is "2".
std::string without_last_zeros(std::string text) {
    if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

constexpr double finest = 0.001;

}  // namespace

std::string figure(double value) {
    if (std::isnan(value)) return "n/a";
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    if (value == 0.0) return "0";
    const double size = std::abs(value);
    if (size < 1e-3 || size >= 1e6) return in_powers(value);
    if (size >= 100.0) return fixed(value, 0);
    if (size >= 10.0) return fixed(value, 1);
    return fixed(value, 1 - static_cast<int>(std::floor(std::log10(size))));
}

std::string figure(const std::optional<double>& value) {
    return value ? figure(*value) : "n/a";
}

std::string about(double value) {
    if (value == 0.0 || !std::isfinite(value)) return figure(value);
    if (value < finest) return "less than 0.001";
    const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    // The fewest digits that read back the same: what rounding left behind is cut off before.
    return without_last_zeros(fixed(std::round(value / step) * step, step >= 1.0 ? 0 : 4));
}

std::string about_near(double limit, double value) {
    const auto is_on_its_side = [&](double shown) { return (shown > limit) == (value > limit); };
    if (!(value >= finest) || !std::isfinite(value)) return about(value);
    double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    if (is_on_its_side(std::round(value / step) * step)) return about(value);
    for (int decimals = 1; decimals < 12; ++decimals) {
        step = std::pow(10.0, -decimals);
        if (is_on_its_side(std::round(value / step) * step))
            return without_last_zeros(fixed(value, decimals));
    }
    return all_digits(value);
}

std::string metres(double value_m) {
    const double size = std::abs(value_m);
    if (!std::isfinite(value_m) || (size > 0.0 && size < 1.0)) return figure(value_m);
    if (size < 100.0) return without_last_zeros(fixed(value_m, 1));
    if (size < 9999.5) return fixed(value_m, 0);
    if (size >= 1e15) return figure(value_m);
    return (value_m < 0.0 ? "-" : "") + grouped(static_cast<std::uint64_t>(std::llround(size)));
}

std::string coarse_figure(double value) {
    return value > 0.0 && value < finest ? "<0.001" : figure(value);
}

std::string point_aligned(double value, int before) {
    std::string text;
    if (!std::isfinite(value) || value == 0.0)
        text = figure(value);
    else if (value < finest)
        text = "<0.001";
    else if (value >= 1e6)
        text = in_powers(value);
    else
        text = fixed(value, value >= 100.0 ? 0 : value >= 10.0 ? 1 : value >= 1.0 ? 2 : 3);
    constexpr std::size_t after = 4;
    const std::size_t point = value >= 1e6 ? text.size() : std::min(text.find('.'), text.size());
    const auto left = static_cast<std::size_t>(std::max(before, 0));
    if (point < left) text.insert(0, left - point, ' ');
    const std::size_t width = left + after;
    if (text.size() < width) text.append(width - text.size(), ' ');
    return text;
}

std::string all_digits(double value) {
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string grouped(std::uint64_t count) {
    std::string text = std::to_string(count);
    for (std::size_t i = text.size(); i > 3;) text.insert(i -= 3, ",");
    return text;
}

std::string counted(std::uint64_t count, const char* one, const char* many) {
    return grouped(count) + " " + (count == 1 ? one : many);
}

const char* compass_point(int sixteenth) {
    static constexpr std::array<const char*, 16> names{"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                                       "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
    return names[static_cast<std::size_t>(sixteenth & 15)];
}

}  // namespace oro

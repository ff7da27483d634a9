#include "apps/window/unit_words.h"

#include <cmath>
#include <cstdint>
#include <cstdio>

#include "apps/report/figures.h"

namespace oro {
namespace {

std::string whole(double value) {
    const auto count = static_cast<std::uint64_t>(std::llround(std::abs(value)));
    return (value < 0.0 && count > 0 ? "-" : "") + grouped(count);
}

std::string with_unit(double value, const char* unit) {
    char text[40];
    if (value >= 10.0) return whole(value) + " " + unit;
    std::snprintf(text, sizeof text, "%.1f %s", value, unit);
    return text;
}

// 1, 2 or 5 times a power of ten.
double round_number(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    for (const double digit : {5.0, 2.0})
        if (digit * power <= most) return digit * power;
    return power;
}

}  // namespace

std::string height_in_units(double height_m, UnitSystem units) {
    return units == UnitSystem::metric ? metres(height_m) + " m" : whole(height_m / foot_m) + " ft";
}

std::string distance_in_units(double distance_m, UnitSystem units) {
    if (units == UnitSystem::metric)
        return distance_m < 1000.0 ? whole(distance_m) + " m" : with_unit(distance_m / 1000.0, "km");
    return distance_m < mile_m ? whole(distance_m / foot_m) + " ft" : with_unit(distance_m / mile_m, "mi");
}

RoundLength round_length(double most_m, UnitSystem units) {
    const bool is_metric = units == UnitSystem::metric;
    const bool is_long = most_m >= (is_metric ? 1000.0 : mile_m);
    const double unit_m = is_metric ? (is_long ? 1000.0 : 1.0) : (is_long ? mile_m : foot_m);
    const char* const unit = is_metric ? (is_long ? "km" : "m") : (is_long ? "mi" : "ft");
    const double number = round_number(most_m / unit_m);
    char text[40];
    std::snprintf(text, sizeof text, number < 1.0 ? "%g %s" : "%.0f %s", number, unit);
    return {number * unit_m, text};
}

}  // namespace oro

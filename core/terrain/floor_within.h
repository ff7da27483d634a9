// Rounding to whole numbers without a call.
#pragma once

#include <algorithm>
#include <cstdint>

namespace oro {

// std::floor of a number that is then kept within -limit .. limit, a whole number below 2^31. NaN must not be
// asked.
[[nodiscard]] inline std::int32_t floor_within(double number, double limit) {
    const double kept = std::clamp(number, -limit, limit);
    const auto towards_zero = static_cast<std::int32_t>(kept);
    return towards_zero - (kept < static_cast<double>(towards_zero) ? 1 : 0);
}

}  // namespace oro

// Heights and distances in the units that a window's user likes.
#pragma once

#include <string>

#include "apps/settings/window_settings.h"

namespace oro {

// Source: international foot and mile of 1959, exactly.
inline constexpr double foot_m = 0.3048, mile_m = 1609.344;

// A height: "3967 m", "13,015 ft".
std::string height_in_units(double height_m, UnitSystem units);
// A distance: "850 m", "12.4 km", "2,788 ft", "7.7 mi"; 10 km and 10 mi or more without a decimal.
std::string distance_in_units(double distance_m, UnitSystem units);

// The longest round length (1, 2 or 5 times a power of ten, of metres, or of feet and miles) that is at most
// so long, and what it is called: "500 m", "20 km", "0.1 m", "5 mi".
struct RoundLength {
    double length_m{};
    std::string words;
};
RoundLength round_length(double most_m, UnitSystem units);

}  // namespace oro

// Units of length that heights count in, by their names.
#pragma once

#include <optional>
#include <string>

namespace oro {

// Metres in a unit of height, by any of its usual names ("m", "ft", "us-ft", "cm", "US survey foot", ...);
// nothing for other words. Source: international foot 0.3048 m and US survey foot 1200/3937 m, NIST Special
// Publication 811, 2008, B.6.
std::optional<double> metres_in(const std::string& unit);

// The words that --height-unit takes, for people: "m, ft, us-ft, cm, dm or mm".
std::string height_unit_words();

}  // namespace oro

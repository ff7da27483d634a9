// Numbers as people read them: few digits, points below each other.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace oro {

// Two digits or three: "0", "0.012", "1.3", "12.4", "316", "4.2e-5"; "n/a" for what is no number, "inf"
// beyond all.
std::string figure(double value);
// A figure() where there is a value, else "n/a".
std::string figure(const std::optional<double>& value);
// Two digits, as one says a size in a sentence: "0", "0.12", "2", "66", "3400"; below 0.001 "less than
// 0.001".
std::string about(double value);
// A size as about() has it, with as many digits more as keep it on its side of `limit`: 1.03 stays "1.03"
// where the limit is 1.
std::string about_near(double limit, double value);
// A distance or height in metres, as one says it in a sentence: "0.35", "2", "36.4", "2490", "297,974".
std::string metres(double value_m);
// As figure, but nothing finer than a thousandth: "<0.001".
std::string coarse_figure(double value);
// For tables: three digits, nothing finer than a thousandth, and the decimal point `before` characters from
// the left: "  362    ", "   13.3  ", "   <0.001". Needs before + 4 characters; larger numbers need more.
std::string point_aligned(double value, int before);
// The fewest digits that read back as the same number.
std::string all_digits(double value);
// "12,345,678"
std::string grouped(std::uint64_t count);
// "1 file", "12,345 files"
std::string counted(std::uint64_t count, const char* one, const char* many);
// The point of the compass that lies so many sixteenths of a turn clockwise from north: "N", "NNE", ...
const char* compass_point(int sixteenth);

}  // namespace oro

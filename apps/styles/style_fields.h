// Fields of styles: read, checked, refused by name. All throw a JsonFault (apps/report/json_fields.h).
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

#include "apps/styles/colours.h"

namespace oro {

inline constexpr double largest_in_style = 1e9;  // metres, or whatever else a style measures

// "#a0b1c2".
ColourCodes colour_of(const nlohmann::json& object, const char* name);
float style_number(const nlohmann::json& object, const char* name, double low, double high);
// Above 0.
float positive(const nlohmann::json& object, const char* name);

void refuse_unknown(const nlohmann::json& object, const char* what, std::span<const std::string_view> known);
inline void refuse_unknown(const nlohmann::json& object, const char* what,
                           std::initializer_list<std::string_view> known) {
    refuse_unknown(object, what, std::span(known.begin(), known.size()));
}

// One of some words, each with its number on the GPU; the first where nothing is said.
struct StyleChoice {
    const char* word;
    gpu::uint number;
};
gpu::uint choice(const nlohmann::json& object, const char* name, std::span<const StyleChoice> choices);

}  // namespace oro

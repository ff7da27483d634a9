#include "apps/styles/style_fields.h"

#include <algorithm>
#include <optional>
#include <string>

#include "apps/report/json_fields.h"
#include "apps/styles/colours.h"

namespace oro {

ColourCodes colour_of(const nlohmann::json& object, const char* name) {
    const std::string text = json_string(object, name);
    const std::optional<ColourCodes> colour = colour_from(text);
    if (!colour) throw JsonFault{"'" + text + "' is not a colour like #a0b1c2"};
    return *colour;
}

float style_number(const nlohmann::json& object, const char* name, double low, double high) {
    return static_cast<float>(json_number(object, name, low, high));
}

float positive(const nlohmann::json& object, const char* name) {
    const float value = style_number(object, name, 0.0, largest_in_style);
    if (!(value > 0.0F)) throw JsonFault{"'" + std::string(name) + "' must be above 0"};
    return value;
}

void refuse_unknown(const nlohmann::json& object, const char* what, std::span<const std::string_view> known) {
    for (const auto& [name, value] : object.items()) {
        if (std::ranges::find(known, std::string_view(name)) != known.end()) continue;
        std::string all;
        for (const std::string_view one : known) all += (all.empty() ? "" : ", ") + std::string(one);
        throw JsonFault{std::string(what) + " has no field '" + name + "'; there is: " + all};
    }
}

gpu::uint choice(const nlohmann::json& object, const char* name, std::span<const StyleChoice> choices) {
    if (!object.contains(name)) return choices[0].number;
    const std::string text = json_string(object, name);
    std::string all;
    for (const StyleChoice& one : choices) {
        if (text == one.word) return one.number;
        all += (all.empty() ? "" : ", ") + std::string(one.word);
    }
    throw JsonFault{"'" + std::string(name) + "' is '" + text + "'; there is: " + all};
}

}  // namespace oro

#include "apps/report/feature_words.h"

#include "apps/report/json_object.h"
#include "core/base/one_line.h"

namespace oro {

std::string words_of(const MeshFeature& feature) {
    std::string words = one_line(feature.type);
    if (!feature.name.empty()) words += (words.empty() ? "" : " ") + one_line(feature.name);
    return feature.part_of.empty() ? words : words + " of " + one_line(feature.part_of);
}

nlohmann::ordered_json feature_json(const MeshFeature& feature) {
    const auto or_null = [](const std::string& text) {
        return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
    };
    nlohmann::ordered_json attributes = nlohmann::ordered_json::object();
    for (const auto& [name, text] : feature.attributes) attributes[name] = text;
    return json_object("type", or_null(feature.type), "name", or_null(feature.name), "part_of",
                       or_null(feature.part_of), "attributes", std::move(attributes));
}

}  // namespace oro

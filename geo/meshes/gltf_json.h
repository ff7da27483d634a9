// Values of glTF's JSON, and what is wrong with them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "geo/meshes/mesh_words.h"
#include "geo/vectors/json_text.h"

namespace oro {

inline Error gltf_fault(const std::string& why) {
    return {ErrorKind::failed, "", why};
}

inline std::optional<JsonValue> gltf_member(const JsonValue& object, std::string_view name) {
    for (const auto& [its_name, value] : object.members())
        if (its_name == name) return value;
    return std::nullopt;
}
inline std::vector<JsonValue> gltf_list(const JsonValue& object, std::string_view name) {
    std::vector<JsonValue> list;
    if (const auto array = gltf_member(object, name))
        array->each([&](const JsonValue& one) { return list.push_back(one), true; });
    return list;
}
// A whole number, not negative; `otherwise` where there is none, and nothing where it is something else.
inline std::optional<std::size_t> gltf_count(const JsonValue& object, std::string_view name,
                                             std::optional<std::size_t> otherwise) {
    const auto value = gltf_member(object, name);
    if (!value) return otherwise;
    long long number = -1;
    if (!whole_number_in(value->source(), number) || number < 0) return std::nullopt;
    return static_cast<std::size_t>(number);
}

inline std::optional<JsonValue> extension_of(const JsonValue& object, std::string_view name) {
    const auto all = gltf_member(object, "extensions");
    return all ? gltf_member(*all, name) : std::nullopt;
}

// A list of as many numbers as `otherwise` has, which is taken where there is none. Errors: another list.
inline Result<std::vector<double>> gltf_reals(const JsonValue& object, std::string_view name,
                                              std::vector<double> otherwise) {
    const auto array = gltf_member(object, name);
    if (!array) return otherwise;
    std::vector<double> list;
    bool all = true;
    array->each([&](const JsonValue& one) {
        double number = 0.0;
        all = all && mesh_number(one.source(), number);
        list.push_back(number);
        return list.size() <= otherwise.size();
    });
    if (!all || list.size() != otherwise.size())
        return gltf_fault("its " + std::string(name) + " is no list of " + std::to_string(otherwise.size()) +
                          " numbers");
    return list;
}

}  // namespace oro

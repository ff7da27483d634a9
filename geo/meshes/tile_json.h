// JSON of 3D Tiles, and what is wrong with it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "geo/vectors/json_text.h"

namespace oro {

inline Error tileset_fault(const std::string& why) {
    return {ErrorKind::failed, "", why};
}

// The members of an object, found once: to look for each would go through all tiles below each time.
class TileMembers {
  public:
    explicit TileMembers(const JsonValue& object) : members_(object.members()) {}
    [[nodiscard]] std::optional<JsonValue> find(std::string_view name) const {
        for (const auto& [its_name, value] : members_)
            if (its_name == name) return value;
        return std::nullopt;
    }
    [[nodiscard]] std::vector<JsonValue> list(std::string_view name) const {
        std::vector<JsonValue> list;
        if (const auto array = find(name))
            array->each([&](const JsonValue& one) { return list.push_back(one), true; });
        return list;
    }

  private:
    std::vector<std::pair<std::string, JsonValue>> members_;
};

}  // namespace oro

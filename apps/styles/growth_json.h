// What grows on a picture's ground, as its JSON tells it.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/styles/style.h"

namespace oro {

// Fields trees and grass, each where the style draws such; none for a style without materials.
// `without_trees`: why trees of a style of materials are left out; "" where that need not be said.
nlohmann::ordered_json growth_json(const Style& style, const std::string& without_trees);

}  // namespace oro

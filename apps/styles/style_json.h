// Styles as JSON: data/README.md lists the fields.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/styles/style.h"

namespace oro {

// A style, with its own sun. Throws a JsonFault (apps/report/json_fields.h): a field that is missing, unknown
// or bad.
Style style_of_json(const nlohmann::json& json);

}  // namespace oro

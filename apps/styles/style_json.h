// Styles as JSON: data/README.md lists the fields.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/styles/style.h"
#include "core/base/result.h"

namespace oro {

// A style, with its own sun. Throws a JsonFault (apps/report/json_fields.h): a field that is missing, unknown
// or bad.
Style style_of_json(const nlohmann::json& json);
// The style of a file's text. Errors: as style_of_json(), or no JSON at all; they name `path`.
Result<Style> style_of_text(const std::string& text, const std::string& path);

}  // namespace oro

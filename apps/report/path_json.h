// Names of files in JSON: bytes, which need not be text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace oro {

// The name, or, of one that is no text or none that XML may hold, {"hex": "ff2e686774"}.
nlohmann::ordered_json path_json(const std::string& path);
// The path that a field holds as path_json() puts it. Throws JsonFault.
std::string path_from(const nlohmann::json& json, const char* name);

}  // namespace oro

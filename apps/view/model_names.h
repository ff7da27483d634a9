// The models of a view by the names that options and view files have for them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/view/view.h"

namespace oro {

// What a name stands for. Usage errors for unknown ones.
Result<Earth> earth_named(const std::string& name);            // "ellipsoid", "sphere", "flat"
Result<Precision> precision_named(const std::string& name);    // "relative", "naive"
Result<bool> geoid_named(const std::string& name);             // "egm96": true, "none"
Result<HeightStorage> heights_named(const std::string& name);  // "f32", "i16"

// The same words, as options list them.
std::vector<std::string> earth_words();
std::vector<std::string> precision_words();
std::vector<std::string> geoid_words();
std::vector<std::string> heights_words();
const char* name_of(HeightStorage heights);

// The models of a view: earth, geoid, refraction, precision, heights.
nlohmann::ordered_json models_json(const View& view);

}  // namespace oro

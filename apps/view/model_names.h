// The models and the surroundings of a view by the names that options and view files have for them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/view/view.h"

namespace oro {

// What a name stands for. Usage errors for unknown ones.
Result<Earth> earth_named(const std::string& name);               // "ellipsoid", "sphere", "flat"
Result<Precision> precision_named(const std::string& name);       // "relative", "naive"
Result<bool> geoid_named(const std::string& name);                // "egm96": true, "none"
Result<HeightStorage> heights_named(const std::string& name);     // "f32", "packed", "i16"
Result<Sea> sea_named(const std::string& name);                   // "level", "low", "voids"
Result<Rim> rim_named(const std::string& name);                   // "skirt", "none"
Result<Show> show_named(const std::string& name);                 // "visible", "levels", ...
Result<Edges> edges_named(const std::string& name);               // "smooth", "steps"
Result<ImageValues> drape_values_named(const std::string& name);  // "auto", "codes", "reflectance"
Result<std::optional<bool>> labels_named(
    const std::string& name);  // "on", "off", "style": as the style has it

// The same words, as options list them.
std::vector<std::string> earth_words();
std::vector<std::string> precision_words();
std::vector<std::string> geoid_words();
std::vector<std::string> heights_words();
std::vector<std::string> air_words();
std::vector<std::string> sea_words();
std::vector<std::string> rim_words();
std::vector<std::string> edges_words();
std::vector<std::string> drape_values_words();
std::vector<std::string> show_words();
const char* name_of(Sea sea);
const char* name_of(Rim rim);
const char* name_of(Edges edges);
const char* name_of(ImageValues values);
const char* name_of(Show show);
const char* name_of(HeightStorage heights);

// What asks for that air: "--air standard", "--refraction 0.13".
std::string air_option(const Air& air);
// What --air stands for. Usage errors for unknown names.
Result<Air> air_named(const std::string& name);  // "standard"
// As view files have laws: "constant", "standard".
Result<AirLaw> air_law_named(const std::string& name);
// How light goes to an eye: "k 0.091 at the eye's h of 3,000 m (standard air)".
std::string light_words(const Air& air, double eye_h_m);
nlohmann::ordered_json light_json(const Air& air, double eye_h_m);

// The models of a view: earth, geoid, refraction and air, precision, heights.
nlohmann::ordered_json models_json(const View& view);

}  // namespace oro

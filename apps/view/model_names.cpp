#include "apps/view/model_names.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/report/figures.h"

namespace oro {

std::string air_option(const Air& air) {
    if (air == standard_air) return "--air standard";
    char text[40];
    std::snprintf(text, sizeof text, "--refraction %g", air.k);
    return text;
}

std::string light_words(const Air& air, double eye_h_m) {
    if (air.k == 0.0) return "straight, without refraction";
    char k[40];
    std::snprintf(k, sizeof k, "%g", air.k);
    if (air.law == AirLaw::constant) return "k " + std::string(k) + " at all heights";
    const double here = air.k_at(eye_h_m);
    const std::string law =
        air == standard_air ? "standard air" : "by standard air, " + std::string(k) + " at sea level";
    return "k " + std::string(here < 0.0 ? "-" : "") + about(std::abs(here)) + " at the eye's h of " +
           metres(eye_h_m) + " m (" + law + ")";
}

nlohmann::ordered_json light_json(const Air& air, double eye_h_m) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    json["k"] = air.k_at(eye_h_m);
    json["refraction"] = air.k;
    json["air"] = name_in(air_law_names, air.law);
    json["eye_h_m"] = eye_h_m;
    return json;
}

}  // namespace oro

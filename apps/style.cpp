#include "apps/style.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/data_folder.h"

namespace oro {
namespace {

// A fault in a style file, on its way to the Error that load_style returns.
struct StyleFault {
    std::string what;
};

float linear_from_srgb(int value) {
    // Source: IEC 61966-2-1:1999, 5.2.
    const double encoded = value / 255.0;
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

gpu::vec3 colour_of(const nlohmann::json& json) {
    const std::string text = json.get<std::string>();
    if (text.size() != 7 || text[0] != '#' ||
        text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
        throw StyleFault{"'" + text + "' is not a colour like #a0b1c2"};
    const long value = std::strtol(text.c_str() + 1, nullptr, 16);
    return {linear_from_srgb(static_cast<int>(value >> 16 & 255)),
            linear_from_srgb(static_cast<int>(value >> 8 & 255)),
            linear_from_srgb(static_cast<int>(value & 255))};
}

float positive(const nlohmann::json& json, const char* name) {
    const float value = json.at(name).get<float>();
    if (!(value > 0.0F) || !std::isfinite(value)) throw StyleFault{std::string(name) + " must be above 0"};
    return value;
}

Style read_style(const nlohmann::json& json, const std::optional<SunDirection>& wanted_sun) {
    gpu::FrameStyle style{};
    const auto& tints = json.at("tints");
    if (tints.empty() || tints.size() > gpu::tint_stops_max)
        throw StyleFault{"tints must have 1 to " + std::to_string(gpu::tint_stops_max) + " entries"};
    for (const auto& stop : tints) {
        const float H_m = stop.at("H_m").get<float>();
        if (style.tint_count > 0 && !(H_m > style.tints[style.tint_count - 1].H_m))
            throw StyleFault{"tints must ascend in H_m"};
        style.tints[style.tint_count++] = {H_m, colour_of(stop.at("colour"))};
    }
    SunDirection sun{json.at("sun").at("azimuth_deg"), json.at("sun").at("elevation_deg")};
    if (wanted_sun) sun = *wanted_sun;
    const double azimuth = radians_from_deg(sun.azimuth_deg).rad,
                 elevation = radians_from_deg(sun.elevation_deg).rad;
    style.sun_enu = gpu::vec3(std::sin(azimuth) * std::cos(elevation),
                              std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
    style.ambient = json.at("ambient").get<float>();
    if (!(style.ambient >= 0.0F && style.ambient <= 1.0F))
        throw StyleFault{"ambient must be between 0 and 1"};
    style.relief = positive(json, "relief");
    style.haze_colour = colour_of(json.at("haze").at("colour"));
    style.haze_distance_m = positive(json.at("haze"), "distance_m");
    style.zenith_colour = colour_of(json.at("sky").at("zenith"));
    style.sky_scale_height_m = positive(json.at("sky"), "scale_height_m");
    style.no_data_colour = colour_of(json.at("no_data"));
    return {style, sun};
}

}  // namespace

Result<Style> load_style(const std::string& name, const std::optional<SunDirection>& sun) {
    const bool is_path = name.ends_with(".json") || name.find('/') != std::string::npos;
    const std::string path = is_path ? name : (data_folder() / "styles" / (name + ".json")).string();
    std::ifstream file(path);
    if (!file)
        return Error{is_path ? ErrorKind::failed : ErrorKind::usage, "--style " + name,
                     "no style at " + path};
    try {
        return read_style(nlohmann::json::parse(file), sun);
    } catch (const nlohmann::json::exception& e) {
        return Error{ErrorKind::failed, path, e.what()};
    } catch (const StyleFault& fault) {
        return Error{ErrorKind::failed, path, fault.what};
    }
}

}  // namespace oro

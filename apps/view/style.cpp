#include "apps/view/style.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "apps/output/data_folder.h"
#include "apps/report/json_fields.h"
#include "apps/view/view_limits.h"

namespace oro {
namespace {

float linear_from_srgb(int value) {
    // Source: IEC 61966-2-1:1999, 5.2.
    const double encoded = value / 255.0;
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

gpu::vec3 colour_of(const nlohmann::json& json, const char* name) {
    const std::string text = json_string(json, name);
    if (text.size() != 7 || text[0] != '#' ||
        text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
        throw JsonFault{"'" + text + "' is not a colour like #a0b1c2"};
    const long value = std::strtol(text.c_str() + 1, nullptr, 16);
    return {linear_from_srgb(static_cast<int>(value >> 16 & 255)),
            linear_from_srgb(static_cast<int>(value >> 8 & 255)),
            linear_from_srgb(static_cast<int>(value & 255))};
}

constexpr double largest = 1e9;  // metres, or whatever else a style measures

float number(const nlohmann::json& json, const char* name, double low, double high) {
    return static_cast<float>(json_number(json, name, low, high));
}

float positive(const nlohmann::json& json, const char* name) {
    const float value = number(json, name, 0.0, largest);
    if (!(value > 0.0F)) throw JsonFault{"'" + std::string(name) + "' must be above 0"};
    return value;
}

Style read_style(const nlohmann::json& json, const std::optional<SunDirection>& wanted_sun) {
    gpu::FrameStyle style{};
    const auto& tints = json_field(json, "tints");
    if (!tints.is_array() || tints.empty() || tints.size() > gpu::tint_stops_max)
        throw JsonFault{"'tints' must be a list of 1 to " + std::to_string(gpu::tint_stops_max)};
    for (const auto& stop : tints) {
        const float H_m = number(stop, "H_m", -largest, largest);
        if (style.tint_count > 0 && !(H_m > style.tints[style.tint_count - 1].H_m))
            throw JsonFault{"tints must ascend in H_m"};
        style.tints[style.tint_count++] = {H_m, colour_of(stop, "colour")};
    }
    const auto& own_sun = json_field(json, "sun");
    SunDirection sun{json_number(own_sun, "azimuth_deg", view_limits::sun_azimuth_deg.low,
                                 view_limits::sun_azimuth_deg.high),
                     json_number(own_sun, "elevation_deg", view_limits::sun_elevation_deg.low,
                                 view_limits::sun_elevation_deg.high)};
    if (wanted_sun) sun = *wanted_sun;
    light_by(sun, style);
    style.ambient = number(json, "ambient", 0.0, 1.0);
    style.relief = positive(json, "relief");
    style.haze_colour = colour_of(json_field(json, "haze"), "colour");
    style.haze_distance_m = positive(json_field(json, "haze"), "distance_m");
    style.zenith_colour = colour_of(json_field(json, "sky"), "zenith");
    style.sky_scale_height_m = positive(json_field(json, "sky"), "scale_height_m");
    style.no_data_colour = colour_of(json, "no_data");
    return {style, sun};
}

// "default, grey": of the styles that come with the program; "" where there are none.
std::string style_names() {
    std::vector<std::string> names;
    std::error_code failed;
    std::filesystem::directory_iterator entry(data_folder() / "styles", failed);
    for (; !failed && entry != std::filesystem::directory_iterator(); entry.increment(failed)) {
        if (entry->path().extension() == ".json") names.push_back(entry->path().stem().string());
    }
    std::ranges::sort(names);
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    return all;
}

}  // namespace

bool is_style_path(const std::string& style) {
    return style.ends_with(".json") || style.find('/') != std::string::npos;
}

void light_by(const SunDirection& sun, gpu::FrameStyle& style) {
    const double azimuth = radians_from_deg(sun.azimuth_deg).rad,
                 elevation = radians_from_deg(sun.elevation_deg).rad;
    style.sun_enu = gpu::vec3(std::sin(azimuth) * std::cos(elevation),
                              std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
    style.sun_hidden = static_cast<float>(1.0 - direct_light(sun));
}

Result<Style> load_style(const std::string& name, const std::optional<SunDirection>& sun) {
    const bool is_path = is_style_path(name);
    const std::string path = is_path ? name : (data_folder() / "styles" / (name + ".json")).string();
    const auto text = read_text_file(path);
    if (!text.ok()) {
        const bool no_such = access(path.c_str(), F_OK) != 0 && (errno == ENOENT || errno == ENAMETOOLONG);
        if (!is_path && no_such) {
            if (const std::string names = style_names(); !names.empty())
                return Error{ErrorKind::usage, "--style " + name,
                             "no style is called '" + name + "'; there is: " + names};
        }
        return Error{!is_path && no_such ? ErrorKind::usage : ErrorKind::failed, "--style " + name,
                     text.error().line()};
    }
    try {
        return read_style(parsed_json(*text), sun);
    } catch (const JsonFault& fault) {
        return Error{ErrorKind::failed, path, fault.what};
    } catch (const nlohmann::json::exception& e) {
        return Error{ErrorKind::failed, path, e.what()};
    }
}

}  // namespace oro

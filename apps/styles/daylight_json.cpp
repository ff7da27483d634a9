#include "apps/styles/style_json.h"

#include <string>

#include "apps/report/json_fields.h"
#include "apps/styles/style_fields.h"

namespace oro {
namespace {

using nlohmann::json;

constexpr double molecules_per_m = 13.558e-6;  // of green, at sea level

void read_snow_line(const json& object, gpu::GroundCover& cover) {
    const auto& stops = json_field(object, "snow_line");
    if (!stops.is_array() || stops.empty() || stops.size() > gpu::snow_line_stops_max)
        throw JsonFault{"'snow_line' must be a list of 1 to " + std::to_string(gpu::snow_line_stops_max)};
    for (const auto& stop : stops) {
        const gpu::SnowLineStop read{
            style_number(stop, "lat_deg", view_limits::lat_deg.low, view_limits::lat_deg.high),
            style_number(stop, "H_m", -largest_in_style, largest_in_style)};
        refuse_unknown(stop, "one of 'snow_line'", {"lat_deg", "H_m"});
        if (cover.snow_line_count > 0 && !(read.lat_deg > cover.snow_line[cover.snow_line_count - 1].lat_deg))
            throw JsonFault{"'snow_line' must ascend in lat_deg"};
        cover.snow_line[cover.snow_line_count++] = read;
    }
}

}  // namespace

// Source: S. Hillaire 2020, table 1 (clear air).
gpu::AirModel air_of(const json& object) {
    gpu::AirModel air{};
    air.on = 1;
    air.molecules_per_m = {5.802e-6F, static_cast<float>(molecules_per_m), 33.1e-6F};
    air.molecules_scale_m = 8000.0F;
    air.dust_scale_m = 1200.0F;
    air.dust_forward = 0.8F;
    air.ozone_per_m = {0.650e-6F, 1.881e-6F, 0.085e-6F};
    air.ground_albedo = style_number(object, "ground_albedo", 0.0, 1.0);
    air.exposure = positive(object, "exposure");
    set_visibility(
        json_number(object, "visibility_km", view_limits::visibility_km.low, view_limits::visibility_km.high),
        air);
    refuse_unknown(object, "'air'", {"visibility_km", "ground_albedo", "exposure"});
    return air;
}

// Source: H. Koschmieder, Theorie der horizontalen Sichtweite, Beiträge zur Physik der freien Atmosphäre 12,
// 1924: contrast falls to 2 % where extinction times distance is 3.912; here of green. What dust scatters of
// what it takes: Hillaire 2020, table 1.
void set_visibility(double visibility_km, gpu::AirModel& air) {
    constexpr double contrast = 3.912, scattered = 3.996 / 4.40;
    const double dust_per_m = contrast / (1000.0 * visibility_km) - molecules_per_m;
    air.dust_extinction_per_m = static_cast<float>(dust_per_m);
    air.dust_scattering_per_m = static_cast<float>(dust_per_m * scattered);
}

gpu::GroundCover cover_of(const json& object, bool as_codes) {
    gpu::GroundCover cover{};
    read_snow_line(object, cover);
    const ColourCodes rock = colour_of(object, "rock");
    cover.rock = as_codes ? unit_codes(rock) : linear_light(rock);
    cover.rock_from_deg = style_number(object, "rock_from_deg", 0.0, 90.0);
    cover.rock_to_deg = style_number(object, "rock_to_deg", 0.0, 90.0);
    if (!(cover.rock_to_deg > cover.rock_from_deg))
        throw JsonFault{"'rock_to_deg' must be above 'rock_from_deg'"};
    cover.forest_m = style_number(object, "forest_m", -largest_in_style, 0.0);
    cover.shade_m = style_number(object, "shade_m", 0.0, largest_in_style);
    cover.level_m = style_number(object, "level_m", 0.0, largest_in_style);
    refuse_unknown(object, "'cover'",
                   {"snow_line", "rock", "rock_from_deg", "rock_to_deg", "forest_m", "shade_m", "level_m"});
    return cover;
}

}  // namespace oro

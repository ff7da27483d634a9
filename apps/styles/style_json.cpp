#include "apps/styles/style_json.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "apps/options/view_limits.h"
#include "apps/report/json_fields.h"
#include "apps/styles/colours.h"
#include "apps/styles/style_fields.h"
#include "shaders/shared_growth.h"

namespace oro {
namespace {

using nlohmann::json;

// By FrameStyle.colour_by: what a stop says it holds at, and the range of it.
struct Measure {
    const char* name;
    double low;
    double high;
};
constexpr double smallest_labels_px = 6.0, largest_labels_px = 100.0;

constexpr std::array<Measure, 4> measures{{{"H_m", -largest_in_style, largest_in_style},
                                           {"slope_deg", 0.0, 90.0},
                                           {"aspect_deg", 0.0, 360.0},
                                           {"above_snow_line_m", -largest_in_style, largest_in_style}}};

void read_tints(const json& object, gpu::FrameStyle& style) {
    const auto& tints = json_field(object, "tints");
    if (!tints.is_array() || tints.empty() || tints.size() > gpu::tint_stops_max)
        throw JsonFault{"'tints' must be a list of 1 to " + std::to_string(gpu::tint_stops_max)};
    const Measure& measure = measures[style.colour_by];
    for (const auto& stop : tints) {
        const float at = style_number(stop, measure.name, measure.low, measure.high);
        if (style.tint_count > 0 && !(at > style.tints[style.tint_count - 1].at))
            throw JsonFault{"tints must ascend in " + std::string(measure.name)};
        const ColourCodes colour = colour_of(stop, "colour");
        refuse_unknown(stop, "one of 'tints'", {measure.name, "colour"});
        style.tints[style.tint_count++] = {
            at, style.tints_as_codes == 1 ? unit_codes(colour) : linear_light(colour)};
    }
}

void read_ground(const json& object, gpu::FrameStyle& style) {
    json_field(object, "tints");  // the first that is told missing
    style.colour_by = choice(object, "colour_by",
                             std::array<StyleChoice, 4>{{{"height", gpu::colour_by_height},
                                                         {"slope", gpu::colour_by_slope},
                                                         {"aspect", gpu::colour_by_aspect},
                                                         {"cover", gpu::colour_by_cover}}});
    style.light = choice(object, "light",
                         std::array<StyleChoice, 4>{{{"sun", gpu::light_sun},
                                                     {"none", gpu::light_none},
                                                     {"hillshade", gpu::light_hillshade},
                                                     {"relief", gpu::light_relief}}});
    style.tints_as_codes = style.light == gpu::light_sun ? 0 : 1;
    read_tints(object, style);
    if (style.colour_by == gpu::colour_by_aspect) {
        const ColourCodes flat = colour_of(object, "flat");
        style.flat_colour = style.tints_as_codes == 1 ? unit_codes(flat) : linear_light(flat);
    } else if (object.contains("flat")) {
        throw JsonFault{"'flat' is for 'colour_by': 'aspect'"};
    }
    if (style.colour_by == gpu::colour_by_cover) {
        style.cover = cover_of(json_field(object, "cover"), style.tints_as_codes == 1);
    } else if (object.contains("cover")) {
        throw JsonFault{"'cover' is for 'colour_by': 'cover'"};
    }
    if (!object.contains("materials")) {
        if (object.contains("growth")) throw JsonFault{"'growth' is for a style with 'materials'"};
        return;
    }
    if (style.colour_by != gpu::colour_by_cover || !object.contains("air"))
        throw JsonFault{"'materials' is for 'colour_by': 'cover', with 'air'"};
    style.materials = materials_of(json_field(object, "materials"));
    if (object.contains("growth")) style.materials.on |= growth_of(json_field(object, "growth"));
}

SunDirection read_light(const json& object, gpu::FrameStyle& style) {
    const bool dark = style.light == gpu::light_none;
    SunDirection sun{315.0, 45.0};
    if (!dark || object.contains("sun")) {
        const auto& own = json_field(object, "sun");
        sun = {json_number(own, "azimuth_deg", view_limits::sun_azimuth_deg.low,
                           view_limits::sun_azimuth_deg.high),
               json_number(own, "elevation_deg", view_limits::sun_elevation_deg.low,
                           view_limits::sun_elevation_deg.high)};
        sun.is_usual = own.contains("by_place") && json_flag(own, "by_place");
        refuse_unknown(own, "'sun'", {"azimuth_deg", "elevation_deg", "by_place"});
    }
    if (style.light == gpu::light_sun) style.ambient = style_number(object, "ambient", 0.0, 1.0);
    for (const auto& [name, on] :
         {std::pair{"shadows", &style.shadows}, std::pair{"sky_openness", &style.sky_openness}}) {
        if (!object.contains(name)) continue;
        if (style.light != gpu::light_sun)
            throw JsonFault{"'" + std::string(name) + "' is for 'light': 'sun'"};
        *on = json_flag(object, name) ? 1 : 0;
    }
    style.relief = dark ? 1.0F : positive(object, "relief");
    if (style.light != gpu::light_relief) return sun;
    const auto& light = json_field(object, "relief_light");
    gpu::ReliefLight& relief = style.relief_light;
    relief.lit = unit_codes(colour_of(light, "lit"));
    relief.lit_share = style_number(light, "lit_share", 0.0, 1.0);
    relief.shadow = unit_codes(colour_of(light, "shadow"));
    relief.veil = unit_codes(colour_of(light, "veil"));
    relief.low_H_m = style_number(light, "low_H_m", -largest_in_style, largest_in_style);
    relief.high_H_m = style_number(light, "high_H_m", -largest_in_style, largest_in_style);
    if (!(relief.high_H_m > relief.low_H_m)) throw JsonFault{"'high_H_m' must be above 'low_H_m'"};
    relief.low_contrast = style_number(light, "low_contrast", 0.0, 1.0);
    relief.low_veil = style_number(light, "low_veil", 0.0, 1.0);
    refuse_unknown(light, "'relief_light'",
                   {"lit", "lit_share", "shadow", "veil", "low_H_m", "high_H_m", "low_contrast", "low_veil"});
    return sun;
}

// Water by the steepness of its waves (root mean square of their slopes) and what comes out of its depth.
void read_water(const json& object, gpu::FrameStyle& style) {
    if (!object.contains("water")) return;
    const auto& water = json_field(object, "water");
    style.water.on = 1;
    style.water.sea_low_H_m = 0.0F;
    style.water.sea_high_H_m = -1.0F;
    style.water.deep = linear_light(colour_of(water, "colour"));
    const float waves = style_number(water, "waves", 0.01, 1.0);
    style.water.wave_variance = waves * waves;
    refuse_unknown(water, "'water'", {"colour", "waves"});
}

void read_voids(const json& object, gpu::FrameStyle& style) {
    if (!object.contains("voids")) return;
    const auto& voids = json_field(object, "voids");
    style.voids = {gpu::voids_hatched | gpu::voids_with_skirt, linear_light(colour_of(voids, "colour")),
                   linear_light(colour_of(voids, "lines"))};
    refuse_unknown(voids, "'voids'", {"colour", "lines"});
}

void read_air(const json& object, gpu::FrameStyle& style) {
    if (object.contains("air")) {
        for (const char* name : {"haze", "sky", "background", "contours"})
            if (object.contains(name))
                throw JsonFault{"with 'air' a style has no '" + std::string(name) + "'"};
        if (style.light != gpu::light_sun) throw JsonFault{"with 'air' a style is lit by the sun"};
        style.air = air_of(json_field(object, "air"));
        read_water(object, style);
        read_voids(object, style);
        style.no_data_colour = linear_light(colour_of(object, "no_data"));
        return;
    }
    for (const char* name : {"water", "voids"})
        if (object.contains(name)) throw JsonFault{"'" + std::string(name) + "' is for styles with 'air'"};
    if (object.contains("background")) {
        for (const char* name : {"haze", "sky", "no_data"}) {
            if (object.contains(name))
                throw JsonFault{"'background' is for maps; they have no '" + std::string(name) + "'"};
        }
        style.is_map = 1;
        style.no_data_colour = linear_light(colour_of(object, "background"));
        // Of no use to a map, and numbers all the same.
        style.haze_distance_m = static_cast<float>(largest_in_style);
        style.sky_scale_height_m = 8000.0F;
        return;
    }
    const auto& haze = json_field(object, "haze");
    style.haze_colour = linear_light(colour_of(haze, "colour"));
    style.haze_distance_m = positive(haze, "distance_m");
    refuse_unknown(haze, "'haze'", {"colour", "distance_m"});
    const auto& sky = json_field(object, "sky");
    style.zenith_colour = linear_light(colour_of(sky, "zenith"));
    style.sky_scale_height_m = positive(sky, "scale_height_m");
    refuse_unknown(sky, "'sky'", {"zenith", "scale_height_m"});
    style.no_data_colour = linear_light(colour_of(object, "no_data"));
}

void read_contours(const json& object, Style& style) {
    if (!object.contains("contours")) return;
    const auto& lines = json_field(object, "contours");
    style.frame.contours.colour = linear_light(colour_of(lines, "colour"));
    style.frame.contours.width_px = style_number(lines, "width_px", 0.1, 20.0);
    if (lines.contains("labels_px"))
        style.labels_px = json_number(lines, "labels_px", smallest_labels_px, largest_labels_px);
    refuse_unknown(lines, "'contours'", {"colour", "width_px", "interval_m", "labels_px"});
    style.contours_by_view = !lines.contains("interval_m");
    if (!style.contours_by_view)
        style.frame.contours.interval_m = style_number(lines, "interval_m", 0.1, 1e5);
}

}  // namespace

Style style_of_json(const json& object) {
    Style style{};
    read_ground(object, style.frame);
    style.sun = read_light(object, style.frame);
    style.sun_by_place = std::exchange(style.sun.is_usual, false);
    read_air(object, style.frame);
    read_contours(object, style);
    style.frame.footprint = choice(object, "footprint",
                                   std::array<StyleChoice, 3>{{{"point", gpu::footprint_point},
                                                               {"mean", gpu::footprint_mean},
                                                               {"finest", gpu::footprint_finest}}});
    const StyleChoice steps{"steps", 0}, smooth{"smooth", 1};
    const bool of_means = style.frame.footprint == gpu::footprint_mean;
    style.frame.smooth_edges =
        choice(object, "edges", std::array{of_means ? smooth : steps, of_means ? steps : smooth});
    refuse_unknown(object, "a style", {"name",    "licence",      "colour_by", "tints",      "flat",
                                       "light",   "sun",          "ambient",   "relief",     "relief_light",
                                       "shadows", "sky_openness", "contours",  "background", "haze",
                                       "sky",     "air",          "no_data",   "cover",      "materials",
                                       "growth",  "water",        "voids",     "footprint",  "edges"});
    return style;
}

Result<Style> style_of_text(const std::string& text, const std::string& path) {
    try {
        return style_of_json(parsed_json(text));
    } catch (const JsonFault& fault) {
        return Error{ErrorKind::failed, path, fault.what};
    } catch (const nlohmann::json::exception& e) {
        return Error{ErrorKind::failed, path, e.what()};
    }
}

}  // namespace oro

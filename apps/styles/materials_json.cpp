// The materials of a style: "materials" in its file.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "apps/report/json_fields.h"
#include "apps/styles/style_fields.h"
#include "apps/styles/style_json.h"
#include "core/drape/materials.h"
#include "shaders/shared_growth.h"

namespace oro {
namespace {

using nlohmann::json;

// Two colours as far apart as patches of a meadow are on average: what lies between them, and the way to one.
gpu::Material material_of(const json& object) {
    const auto& colours = json_array(object, "colours", 2);
    gpu::vec3 light[2];
    for (std::size_t i = 0; i < 2; ++i) {
        const auto codes = colours[i].is_string() ? colour_from(colours[i].get<std::string>()) : std::nullopt;
        if (!codes) throw JsonFault{"'colours' must be two of the form \"#a0b1c2\""};
        light[i] = linear_light(*codes);
    }
    const float grain = style_number(object, "grain", 0.0, 1.0);
    refuse_unknown(object, "a material", {"colours", "grain"});
    return {0.5F * (light[0] + light[1]), 0.5F * (light[1] - light[0]), grain};
}

gpu::vec2 from_to(const json& object, const char* name, double low, double high) {
    const auto& both = json_array(object, name, 2);
    for (const json& one : both) {
        if (!one.is_number() || one.get<double>() < low || one.get<double>() > high)
            throw JsonFault{"'" + std::string(name) + "' must be two numbers from " +
                            std::to_string(static_cast<int>(low)) + " to " +
                            std::to_string(static_cast<int>(high))};
    }
    if (!(both[1].get<double>() > both[0].get<double>()))
        throw JsonFault{"'" + std::string(name) + "' must ascend"};
    return {both[0].get<float>(), both[1].get<float>()};
}

// "needle_forest" of needle forest.
std::string field_of(const char* name) {
    std::string field = name;
    std::ranges::replace(field, ' ', '_');
    return field;
}

}  // namespace

gpu::MaterialTable materials_of(const json& object) {
    gpu::MaterialTable table{};
    table.on = 1;
    std::array<std::string, gpu::material_count> fields;
    std::ranges::transform(material_names, fields.begin(), field_of);
    for (std::size_t i = 0; i < fields.size(); ++i)
        table.of[i] = material_of(json_field(object, fields[i].c_str()));
    const auto& dry = json_field(object, "dry");
    table.dry_lat_deg = from_to(dry, "lat_deg", 0.0, 90.0);
    table.dry_H_m = from_to(dry, "H_m", -1e4, 1e4);
    refuse_unknown(dry, "'dry'", {"lat_deg", "H_m"});
    table.snow_to_deg = style_number(object, "snow_to_deg", 0.0, 90.0);
    std::vector<std::string_view> known(fields.begin(), fields.end());
    known.insert(known.end(), {"dry", "snow_to_deg"});
    refuse_unknown(object, "'materials'", known);
    return table;
}

gpu::uint growth_of(const json& object) {
    const bool trees = json_flag(object, "trees");
    const bool grass = object.contains("grass") && json_flag(object, "grass");
    refuse_unknown(object, "'growth'", {"trees", "grass"});
    return (trees ? gpu::materials_with_trees : 0) | (grass ? gpu::materials_with_grass : 0);
}

}  // namespace oro

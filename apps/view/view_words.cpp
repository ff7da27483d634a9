#include "apps/view/view_words.h"

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "apps/options/region_option_table.h"
#include "apps/report/figures.h"
#include "apps/styles/colours.h"
#include "apps/view/model_names.h"
#include "apps/view/view_option_table.h"

namespace oro {
namespace {

// What was given of a table's options, as words.
template <class Row, class Options>
std::vector<std::string> given_words(const std::vector<Row>& table, Options options) {
    std::vector<std::string> words;
    const auto add = [&](const std::string& name, const std::string& value) {
        words.push_back(name);
        words.push_back(value);
    };
    for (const Row& row : table) {
        if (!row.is_given(options)) continue;
        std::visit(
            [&](auto* value) {
                using Value = std::remove_pointer_t<decltype(value)>;
                if constexpr (std::is_same_v<Value, bool>) {
                    words.push_back(row.name);
                } else if constexpr (std::is_same_v<Value, std::string>) {
                    add(row.name, *value);
                } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
                    for (const std::string& one : *value) add(row.name, one);
                } else if constexpr (std::is_same_v<Value, std::optional<std::string>>) {
                    add(row.name, **value);
                } else if constexpr (std::is_same_v<Value, std::optional<int>>) {
                    add(row.name, std::to_string(**value));
                } else {
                    add(row.name, all_digits(**value));
                }
            },
            row.target(options));
    }
    return words;
}

std::optional<std::string> switch_word(const std::optional<bool>& on) {
    if (!on) return std::nullopt;
    return name_in(switch_names, *on);
}

// Gives what is another than a command takes by itself.
template <class Asked, class Value>
void give(const Value& value, const Value& usual, Asked& asked) {
    if (!(value == usual)) asked = value;
}
template <class Value, std::size_t count>
void give_name(const Value& value, const Value& usual, const Names<Value, count>& names,
               std::optional<std::string>& asked) {
    if (!(value == usual)) asked = name_in(names, value);
}

void give_light(const View& view, ViewOptions& options) {
    options.visibility_km = view.visibility_km;
    options.shadows = switch_word(view.shadows);
    options.sky_openness = switch_word(view.sky_openness);
    options.trees = switch_word(view.trees);
    options.contour_interval_m = view.contour_interval_m;
    options.labels = switch_word(view.labels);
    if (!view.sun || view.sun->is_usual) return;
    if (view.sun->time)
        options.sun_time = view.sun->time->text;
    else
        options.sun = all_digits(view.sun->azimuth_deg) + "," + all_digits(view.sun->elevation_deg);
}

void give_vectors(const VectorChoices& vectors, ViewOptions& options) {
    const VectorChoices usual{};
    options.names = vectors.names;
    options.overlay = vectors.overlay;
    if (vectors.any()) give(vectors.names_field, usual.names_field, options.names_field);
    if (vectors.overlay.empty()) return;
    if (vectors.overlay_colour != usual.overlay_colour)
        options.overlay_colour = colour_text(vectors.overlay_colour);
    give(vectors.overlay_width_px, usual.overlay_width_px, options.overlay_width_px);
    give(vectors.overlay_fill, usual.overlay_fill, options.overlay_fill);
}

void give_models(const View& view, ViewOptions& options) {
    const WorldModel usual{};
    give_name(view.model.earth, usual.earth, earth_names, options.earth);
    give_name(view.model.precision, usual.precision, precision_names, options.precision);
    give_name(view.has_geoid, true, geoid_names, options.geoid);
    if (view.model.air == usual.air) return;
    if (view.model.air == standard_air)
        options.air = name_in(air_names, standard_air);
    else
        options.refraction_k = view.model.air.k;
}

}  // namespace

std::string box_words(const BoundingBox& box) {
    return all_digits(box.west_deg) + "," + all_digits(box.south_deg) + "," + all_digits(box.east_deg) + "," +
           all_digits(box.north_deg);
}

ViewOptions look_options_of(const View& view) {
    const View usual{};
    ViewOptions options;
    options.size = std::to_string(view.camera.width_px) + "x" + std::to_string(view.camera.height_px);
    give(view.style, usual.style, options.style);
    give(view.samples, usual.samples, options.samples);
    give(view.exaggeration, usual.exaggeration, options.exaggeration);
    give(view.tau_px, usual.tau_px, options.tau_px);
    give_name(view.sea, usual.sea, sea_names, options.sea);
    give_name(view.rim, usual.rim, rim_names, options.rim);
    options.drape = view.drape;
    if (!view.drape.empty()) {
        give(view.drape_opacity, usual.drape_opacity, options.drape_opacity);
        give_name(view.drape_values, usual.drape_values, image_value_names, options.drape_values);
    }
    options.landcover = words_of(view.cover_choice);
    options.canopy = words_of(view.canopy_choice);
    options.canopy_held = view.canopy_choice.held;
    if (view.detail) options.detail = words_of(*view.detail);
    give_name(view.heights, usual.heights, height_storage_names, options.heights);
    if (view.edges) options.edges = name_in(edge_names, *view.edges);
    if (view.show) options.show = name_in(show_names, *view.show);
    give_light(view, options);
    give_vectors(view.vectors, options);
    give_models(view, options);
    return options;
}

RegionOptions region_options_of(const View& view) {
    const RegionRequest& request = view.region;
    RegionOptions options;
    options.paths = request.paths;
    if (request.box) options.bbox = box_words(*request.box);
    options.height_unit = request.height_unit;
    options.source_crs = request.source_crs;
    options.source_vertical = request.source_vertical;
    options.strict_datum = request.strict_datum;
    options.fill_voids = request.fill_voids;
    options.resample = request.resample;
    if (request.listed_first) options.order = "listed";
    if (request.feather_m > 0.0) options.feather_m = request.feather_m;
    options.mesh_files = request.meshes.files;
    options.mesh_crs = request.meshes.crs;
    options.mesh_unit = request.meshes.unit;
    options.mesh_lod = request.meshes.lod;
    options.building_height = request.meshes.building_height;
    options.building_base = request.meshes.building_base;
    options.mesh_look = request.meshes.look;
    options.cut_under = request.meshes.cut_under;
    options.crease_deg = request.meshes.crease_deg;
    return options;
}

std::vector<std::string> words_of(const ViewOptions& options) {
    return given_words(view_option_table(), options);
}

std::vector<std::string> words_of(const RegionOptions& options) {
    RegionOptions named = options;
    std::vector<std::string> words = std::exchange(named.paths, {});
    for (std::string& word : given_words(region_option_table(), named)) words.push_back(std::move(word));
    return words;
}

std::vector<std::string> look_words(const View& view) {
    return words_of(look_options_of(view));
}

std::vector<std::string> region_words(const View& view) {
    return words_of(region_options_of(view));
}

std::string shell_line(const std::vector<std::string>& words) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
    std::string line;
    for (const std::string& word : words) {
        if (!line.empty()) line += ' ';
        if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
            line += word;
            continue;
        }
        line += '\'';
        // In single quotes a shell takes everything but these as it is.
        for (const char c : word) line += c == '\'' ? "'\\''" : std::string(1, c);
        line += '\'';
    }
    return line;
}

}  // namespace oro

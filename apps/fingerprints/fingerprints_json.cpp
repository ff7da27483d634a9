#include "apps/fingerprints/fingerprints_json.h"

#include <charconv>
#include <cinttypes>
#include <cstdio>

#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/path_json.h"
#include "apps/report/region_json.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

// As text: other readers of JSON keep 53 bits of a number.
std::string digits_of(std::uint64_t print) {
    char digits[20];
    std::snprintf(digits, sizeof digits, "%016" PRIx64, print);
    return digits;
}

void put(ordered_json& json, const char* name, const std::optional<std::uint64_t>& print) {
    if (print) json[name] = digits_of(*print);
}

std::uint64_t print_from(const nlohmann::json& json, const char* name) {
    const std::string digits = json_string(json, name);
    std::uint64_t print = 0;
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, print, 16);
    if (digits.size() != 16 || read.ec != std::errc() || read.ptr != end)
        throw JsonFault{"'" + std::string(name) + "' is not 16 hexadecimal digits"};
    return print;
}

std::optional<std::uint64_t> print_if_any(const nlohmann::json& json, const char* name) {
    if (!json.contains(name)) return std::nullopt;
    return print_from(json, name);
}

ordered_json sources_json(const std::vector<Fingerprints::OfSource>& sources) {
    ordered_json json = ordered_json::array();
    for (const Fingerprints::OfSource& source : sources) {
        ordered_json one = ordered_json::object();
        if (!source.name.empty()) one["name"] = path_json(source.name);
        put(one, "posts", source.posts);
        json.push_back(std::move(one));
    }
    return json;
}

std::vector<Fingerprints::OfSource> sources_from(const nlohmann::json& json, const std::string& field) {
    const nlohmann::json& sources = json_field(json, field.c_str());
    if (!sources.is_array() || sources.size() > most_sources_with_prints)
        throw JsonFault{"'" + field + "' of 'fingerprints' must be a list of at most " +
                        std::to_string(most_sources_with_prints)};
    std::vector<Fingerprints::OfSource> all;
    for (const nlohmann::json& source : sources) {
        if (!source.is_object()) throw JsonFault{"'" + field + "' of 'fingerprints' must hold objects"};
        all.push_back(
            {source.contains("name") ? path_from(source, "name") : "", print_if_any(source, "posts")});
    }
    return all;
}

// Views of before it was measured have none, nor have those of regions whose posts are their sources' own.
std::optional<RegionResampling> resampling_from(const nlohmann::json& json) {
    if (!json.contains("resampling")) return std::nullopt;
    const nlohmann::json& told = json_field(json, "resampling");
    const auto count = [&](const char* name) {
        constexpr std::int64_t most = std::int64_t{1} << 53U;
        return static_cast<std::uint64_t>(json_whole(told, name, 0, most));
    };
    constexpr double most_m = 1e6;
    return RegionResampling{count("files"),
                            count("unknown"),
                            count("posts"),
                            count("compared"),
                            json_number(told, "worst_m", 0.0, most_m),
                            json_number(told, "rms_m", 0.0, most_m)};
}

}  // namespace

std::string pixels_field(std::uint64_t pixels) {
    return "\"pixels\":\"" + digits_of(pixels) + "\"";
}

ordered_json prints_json(const Fingerprints& prints) {
    ordered_json json = ordered_json::object();
    json["program"] = prints.program;
    json["grid"] = digits_of(prints.grid);
    put(json, "posts", prints.posts);
    json["sources"] = sources_json(prints.sources);
    if (prints.resampling) json["resampling"] = resampling_json(prints.resampling);
    json["geoid"] = json_object("name", prints.geoid, "undulation", digits_of(prints.undulation));
    if (!prints.images.empty()) json["images"] = sources_json(prints.images);
    if (!prints.vectors.empty()) json["vectors"] = sources_json(prints.vectors);
    put(json, "style", prints.style);
    put(json, "pixels", prints.pixels);
    if (prints.data_changed) json["data_changed"] = true;
    return json;
}

Fingerprints prints_from(const nlohmann::json& json) {
    Fingerprints prints;
    prints.program = json_string(json, "program");
    prints.grid = print_from(json, "grid");
    prints.posts = print_if_any(json, "posts");
    prints.sources = sources_from(json, "sources");
    if (json.contains("images")) prints.images = sources_from(json, "images");
    if (json.contains("vectors")) prints.vectors = sources_from(json, "vectors");
    const nlohmann::json& geoid = json_field(json, "geoid");
    prints.geoid = json_string(geoid, "name");
    prints.undulation = print_from(geoid, "undulation");
    prints.resampling = resampling_from(json);
    prints.style = print_if_any(json, "style");
    prints.pixels = print_if_any(json, "pixels");
    if (json.contains("data_changed")) prints.data_changed = json_flag(json, "data_changed");
    return prints;
}

}  // namespace oro

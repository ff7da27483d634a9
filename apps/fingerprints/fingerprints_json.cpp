#include "apps/fingerprints/fingerprints.h"

#include <charconv>
#include <cinttypes>
#include <cstdio>

#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/region_json.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

// As text: other readers of JSON keep 53 bits of a number.
std::string digits_of(std::uint64_t fingerprint) {
    char digits[20];
    std::snprintf(digits, sizeof digits, "%016" PRIx64, fingerprint);
    return digits;
}

void put(ordered_json& json, const char* name, const std::optional<std::uint64_t>& fingerprint) {
    if (fingerprint) json[name] = digits_of(*fingerprint);
}

std::uint64_t fingerprint_from(const nlohmann::json& json, const char* name) {
    const std::string digits = json_string(json, name);
    std::uint64_t fingerprint = 0;
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, fingerprint, 16);
    if (digits.size() != 16 || read.ec != std::errc() || read.ptr != end)
        throw JsonFault{"'" + std::string(name) + "' is not 16 hexadecimal digits"};
    return fingerprint;
}

std::optional<std::uint64_t> fingerprint_if_any(const nlohmann::json& json, const char* name) {
    if (!json.contains(name)) return std::nullopt;
    return fingerprint_from(json, name);
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
    if (!sources.is_array() || sources.size() > most_sources_with_fingerprints)
        throw JsonFault{"'" + field + "' of 'fingerprints' must be a list of at most " +
                        std::to_string(most_sources_with_fingerprints)};
    std::vector<Fingerprints::OfSource> all;
    for (const nlohmann::json& source : sources) {
        if (!source.is_object()) throw JsonFault{"'" + field + "' of 'fingerprints' must hold objects"};
        all.push_back(
            {source.contains("name") ? path_from(source, "name") : "", fingerprint_if_any(source, "posts")});
    }
    return all;
}

// Views of before it was measured have none, nor have those of regions whose posts are their sources' own.
std::optional<RegionResampling> resampling_from(const nlohmann::json& json) {
    if (!json.contains("resampling")) return std::nullopt;
    const nlohmann::json& recorded = json_field(json, "resampling");
    const auto count = [&](const char* name) {
        constexpr std::int64_t most = std::int64_t{1} << 53U;
        return static_cast<std::uint64_t>(json_whole(recorded, name, 0, most));
    };
    constexpr double most_m = 1e6;
    return RegionResampling{count("files"),
                            count("unknown"),
                            count("posts"),
                            count("compared"),
                            json_number(recorded, "worst_m", 0.0, most_m),
                            json_number(recorded, "rms_m", 0.0, most_m)};
}

}  // namespace

std::string pixels_field(std::uint64_t pixels) {
    return "\"pixels\":\"" + digits_of(pixels) + "\"";
}

ordered_json fingerprints_json(const Fingerprints& fingerprints) {
    ordered_json json = ordered_json::object();
    json["program"] = fingerprints.program;
    json["grid"] = digits_of(fingerprints.grid);
    put(json, "posts", fingerprints.posts);
    json["sources"] = sources_json(fingerprints.sources);
    if (fingerprints.resampling) json["resampling"] = resampling_json(fingerprints.resampling);
    json["geoid"] = json_object("name", fingerprints.geoid, "undulation", digits_of(fingerprints.undulation));
    if (!fingerprints.images.empty()) json["images"] = sources_json(fingerprints.images);
    if (!fingerprints.cover.empty()) json["landcover"] = sources_json(fingerprints.cover);
    if (!fingerprints.canopy.empty()) json["canopy"] = sources_json(fingerprints.canopy);
    if (!fingerprints.vectors.empty()) json["vectors"] = sources_json(fingerprints.vectors);
    put(json, "style", fingerprints.style);
    put(json, "pixels", fingerprints.pixels);
    if (fingerprints.data_changed) json["data_changed"] = true;
    return json;
}

Fingerprints fingerprints_from(const nlohmann::json& json) {
    Fingerprints fingerprints;
    fingerprints.program = json_string(json, "program");
    fingerprints.grid = fingerprint_from(json, "grid");
    fingerprints.posts = fingerprint_if_any(json, "posts");
    fingerprints.sources = sources_from(json, "sources");
    if (json.contains("images")) fingerprints.images = sources_from(json, "images");
    if (json.contains("landcover")) fingerprints.cover = sources_from(json, "landcover");
    if (json.contains("canopy")) fingerprints.canopy = sources_from(json, "canopy");
    if (json.contains("vectors")) fingerprints.vectors = sources_from(json, "vectors");
    const nlohmann::json& geoid = json_field(json, "geoid");
    fingerprints.geoid = json_string(geoid, "name");
    fingerprints.undulation = fingerprint_from(geoid, "undulation");
    fingerprints.resampling = resampling_from(json);
    fingerprints.style = fingerprint_if_any(json, "style");
    fingerprints.pixels = fingerprint_if_any(json, "pixels");
    if (json.contains("data_changed")) fingerprints.data_changed = json_flag(json, "data_changed");
    return fingerprints;
}

}  // namespace oro

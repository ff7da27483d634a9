// What 3D Tiles 1.1 (OGC 22-025r4) demands of a tileset and of the glTF in it, and what Orograph promises
// beyond that. Read from the specification alone: none of the project's own code is used. Each rule names its
// section.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/support/metadata_rules.h"

namespace oro::test {

inline std::string content_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// JSON encoding: UTF-8 without a byte order mark; no object has a name twice. Nothing where it is no JSON.
inline std::optional<nlohmann::json> strict_json(const std::string& text, const std::string& where,
                                                 BrokenRules& rules) {
    rules.expect(!text.starts_with("\xEF\xBB\xBF"), where, "no byte order mark (JSON encoding)");
    std::vector<std::set<std::string>> names;
    const auto watch = [&](int, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
        if (event == nlohmann::json::parse_event_t::object_start) names.emplace_back();
        if (event == nlohmann::json::parse_event_t::object_end) names.pop_back();
        if (event == nlohmann::json::parse_event_t::key)
            rules.expect(names.back().insert(parsed.get<std::string>()).second, where,
                         "a name is in an object once (JSON encoding): " + parsed.get<std::string>());
        return true;
    };
    const auto json = nlohmann::json::parse(text, watch, false);
    if (!rules.expect(!json.is_discarded(), where, "it is JSON in UTF-8 (JSON encoding)"))
        return std::nullopt;
    return json;
}

// A region: west, south, east, north in radians, lowest and highest h in metres.
struct RuledRegion {
    double west{}, south{}, east{}, north{}, lowest{}, highest{};

    // Across 180 degrees west is more than east.
    [[nodiscard]] double width() const {
        return east >= west ? east - west : east - west + 2.0 * std::numbers::pi;
    }
    [[nodiscard]] bool holds(const RuledRegion& other) const {
        constexpr double whole_turn = 2.0 * std::numbers::pi, rounding = 1.0e-12;
        double beyond = std::fmod(other.west - west, whole_turn);
        if (beyond < -rounding) beyond += whole_turn;
        const bool is_across =
            width() >= whole_turn - rounding || beyond + other.width() <= width() + rounding;
        return is_across && other.south >= south && other.north <= north && other.lowest >= lowest &&
               other.highest <= highest;
    }
};

// Bounding volumes, Region: six numbers in the order west, south, east, north, lowest, highest; EPSG 4979 in
// radians, so that longitudes are within half a turn and latitudes within a quarter.
inline std::optional<RuledRegion> region_of(const nlohmann::json& tile, const std::string& where,
                                            BrokenRules& rules) {
    if (!rules.expect(tile.contains("boundingVolume") && tile["boundingVolume"].contains("region"), where,
                      "a tile has a bounding volume, here a region (Tile JSON)"))
        return std::nullopt;
    const auto& list = tile["boundingVolume"]["region"];
    bool is_list = list.is_array() && list.size() == 6;
    for (std::size_t i = 0; is_list && i < 6; ++i) is_list = list[i].is_number();
    if (!rules.expect(is_list, where, "a region has six numbers (Bounding volumes, Region)"))
        return std::nullopt;
    const RuledRegion region{list[0], list[1], list[2], list[3], list[4], list[5]};
    constexpr double half_turn = std::numbers::pi;
    const bool is_in_range = std::abs(region.west) <= half_turn && std::abs(region.east) <= half_turn &&
                             region.south >= -0.5 * half_turn && region.north <= 0.5 * half_turn;
    rules.expect(is_in_range, where,
                 "longitudes and latitudes are radians in range (Bounding volumes, Region)");
    rules.expect(
        region.south <= region.north && region.lowest <= region.highest, where,
        "south is before north, and the lowest height before the highest (Bounding volumes, Region)");
    // A height that no place on the Earth has: below its centre, or above 100 km.
    rules.expect(region.lowest >= -6378137.0 && region.highest <= 1.0e5, where, "heights are metres (Units)");
    return region;
}

// Names that objects of the specification have; it defines no others (Tile JSON; Tileset JSON; Tile Content).
inline void check_names(const nlohmann::json& object, const std::set<std::string>& known,
                        const std::string& where, BrokenRules& rules) {
    for (const auto& [name, value] : object.items())
        rules.expect(known.contains(name) || name == "extensions" || name == "extras", where,
                     "no name but those of the specification: " + name);
}

inline double number_or_less(const nlohmann::json& object, const char* name) {
    return object.contains(name) && object[name].is_number() ? object[name].get<double>() : -1.0;
}

// The JSON and the buffer of a binary glTF. Tile format specifications, glTF; glTF 2.0, 4.4: the magic, the
// version, and lengths that add up.
inline void check_glb(const std::string& bytes, const std::string& where, BrokenRules& rules) {
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        if (at + sizeof(value) <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof(value));
        return std::size_t{value};
    };
    const std::size_t json_bytes = word(12), at_buffer = 28 + json_bytes;
    if (!rules.expect(bytes.starts_with("glTF") && word(4) == 2 && word(8) == bytes.size() &&
                          at_buffer <= bytes.size() && at_buffer + word(20 + json_bytes) == bytes.size() &&
                          bytes.substr(16, 4) == "JSON" && json_bytes % 4 == 0,
                      where, "it is binary glTF 2.0 whose lengths add up (glTF 2.0, 4.4)"))
        return;
    const std::optional<nlohmann::json> gltf = strict_json(bytes.substr(20, json_bytes), where, rules);
    if (!gltf) return;
    const std::string buffer = bytes.substr(at_buffer);
    std::set<std::string> used;
    for (const auto& name : gltf->value("extensionsUsed", nlohmann::json::array())) used.insert(name);
    const auto extensions = gltf->value("extensions", nlohmann::json::object());
    for (const auto& [name, value] : extensions.items())
        rules.expect(used.contains(name), where, "extensions are listed (glTF 2.0, 3.12): " + name);
    auto tables = nlohmann::json::array();
    if (extensions.contains("EXT_structural_metadata")) {
        const auto& metadata = extensions["EXT_structural_metadata"];
        if (!rules.expect(metadata.contains("schema"), where,
                          "there is a schema (Schema Definitions, Schema)"))
            return;
        check_schema(metadata["schema"], where, rules);
        tables = metadata.value("propertyTables", nlohmann::json::array());
        for (const auto& table : tables)
            check_table(table, metadata["schema"], {*gltf, buffer}, where, rules);
    }
    for (const auto& mesh : (*gltf)["meshes"])
        for (const auto& primitive : mesh["primitives"]) {
            if (!primitive.contains("extensions")) continue;
            for (const auto& [name, value] : primitive["extensions"].items())
                rules.expect(used.contains(name), where, "extensions are listed (glTF 2.0, 3.12): " + name);
            if (primitive["extensions"].contains("EXT_mesh_features"))
                check_features(primitive, *gltf, tables, where, rules);
        }
}

// Concepts, Tile Content: one content, or a list of some, each with a URI; URIs: relative to the tileset, and
// resolvable.
inline void check_content(const nlohmann::json& tile, const std::filesystem::path& folder,
                          const std::string& where, BrokenRules& rules) {
    rules.expect(!tile.contains("content") || !tile.contains("contents"), where,
                 "content and contents exclude each other (Tile JSON)");
    if (!tile.contains("content")) {
        rules.expect(tile.contains("contents") || !tile.value("children", nlohmann::json::array()).empty(),
                     where, "a tile without content has children (Spatial data structures, Grids)");
        return;
    }
    const auto& content = tile["content"];
    check_names(content, {"boundingVolume", "uri", "metadata", "group"}, where, rules);
    if (!rules.expect(content.contains("uri") && content["uri"].is_string(), where,
                      "content has a URI (Tile Content)"))
        return;
    const std::string uri = content["uri"];
    const std::filesystem::path file = folder / uri;
    if (rules.expect(std::filesystem::path(uri).is_relative() && std::filesystem::is_regular_file(file),
                     where, "the URI is that of a file (URIs): " + uri))
        check_glb(content_of(file), uri, rules);
}

struct RuledParent {
    std::optional<RuledRegion> region;
    double error_m{};
};

inline void check_tile(const nlohmann::json& tile, const std::filesystem::path& folder,
                       const RuledParent* parent, const std::string& where, BrokenRules& rules) {
    check_names(tile,
                {"boundingVolume", "viewerRequestVolume", "geometricError", "refine", "transform", "content",
                 "contents", "metadata", "implicitTiling", "children"},
                where, rules);
    const std::optional<RuledRegion> region = region_of(tile, where, rules);
    const double error_m = number_or_less(tile, "geometricError");
    rules.expect(error_m >= 0.0, where, "geometricError is 0 or more (Tile JSON)");
    // "Generally" less than the parent's in the specification: here never more.
    if (parent != nullptr)
        rules.expect(error_m <= parent->error_m, where, "geometricError falls (Concepts, Geometric error)");
    // Spatial coherence is of content; that of regions is more, and is what Orograph promises.
    if (parent != nullptr && parent->region && region)
        rules.expect(parent->region->holds(*region), where,
                     "a child lies in its parent (Bounding volume spatial coherence)");
    if (tile.contains("refine"))
        rules.expect(tile["refine"] == "REPLACE" || tile["refine"] == "ADD", where,
                     "refine is REPLACE or ADD (Concepts, Refinement)");
    else
        rules.expect(parent != nullptr, where, "the root says how it is refined (Concepts, Refinement)");
    check_content(tile, folder, where, rules);
    const auto children = tile.value("children", nlohmann::json::array());
    rules.expect(children.is_array(), where, "children are a list (Tile JSON)");
    const RuledParent own{region, error_m};
    for (std::size_t i = 0; i < children.size(); ++i)
        check_tile(children[i], folder, &own, where + "/" + std::to_string(i), rules);
}

// All rules that the tileset of a folder breaks.
inline std::vector<std::string> broken_rules(const std::filesystem::path& folder) {
    BrokenRules rules;
    const std::string where = "tileset";
    const std::optional<nlohmann::json> read = strict_json(content_of(folder / "tileset.json"), where, rules);
    if (!read) return rules.list();
    const nlohmann::json& json = *read;
    check_names(json,
                {"asset", "properties", "schema", "schemaUri", "statistics", "groups", "metadata",
                 "geometricError", "root", "extensionsUsed", "extensionsRequired"},
                where, rules);
    rules.expect(json.contains("asset") && json["asset"].value("version", "") == "1.1", where,
                 "asset.version is \"1.1\" (Tileset JSON)");
    const double error_m = number_or_less(json, "geometricError");
    rules.expect(error_m >= 0.0, where, "geometricError is 0 or more (Tileset JSON)");
    rules.expect(!json.contains("schema") || !json.contains("schemaUri"), where,
                 "a schema is here or elsewhere (Metadata, Metadata Schema)");
    if (json.contains("schema")) check_schema(json["schema"], where, rules);
    if (json.contains("metadata"))
        check_entity(json["metadata"], json.value("schema", nlohmann::json::object()), where, rules);
    if (!rules.expect(json.contains("root") && json["root"].is_object(), where,
                      "there is a root (Tileset JSON)"))
        return rules.list();
    check_tile(json["root"], folder, nullptr, "root", rules);
    // Before the root is drawn all of it is missing.
    rules.expect(error_m >= number_or_less(json["root"], "geometricError"), where,
                 "geometricError is no less than the root's (Concepts, Geometric error)");
    return rules.list();
}

}  // namespace oro::test

#include "apps/cover/cover_tables.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>

#include "apps/command_line/refusals.h"
#include "apps/report/json_fields.h"
#include "apps/styles/data_folder.h"
#include "apps/styles/style_fields.h"
#include "core/base/checksum.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_cover_classes = 256;

std::vector<int> codes_from(const nlohmann::json& json, const char* name) {
    const nlohmann::json& list = json_field(json, name);
    if (!list.is_array() || list.size() > most_cover_classes)
        throw JsonFault{"'" + std::string(name) + "' must be a list of at most 256 codes"};
    std::vector<int> codes;
    for (const nlohmann::json& one : list) {
        const nlohmann::json field{{name, one}};
        codes.push_back(static_cast<int>(json_whole(field, name, -(1 << 24), 1 << 24)));
    }
    return codes;
}

std::vector<Material> materials_from(const nlohmann::json& json) {
    std::vector<Material> materials;
    for (const std::string& word : json_strings(json, "materials")) {
        const auto* const found = std::ranges::find(material_names, std::string_view(word));
        if (found == material_names.end()) throw JsonFault{"there is no material '" + word + "'"};
        materials.push_back(static_cast<Material>(found - material_names.begin()));
    }
    if (materials.empty() || materials.size() > 2) throw JsonFault{"'materials' must be one or two"};
    return materials;
}

CoverClass class_from(const nlohmann::json& json) {
    refuse_unknown(json, "a class",
                   {"codes", "name", "colour", "materials", "canopy_m", "canopy_spread_m", "stems_per_ha",
                    "steepest_deg", "lowest_H_m", "highest_H_m"});
    CoverClass one;
    one.codes = codes_from(json, "codes");
    if (one.codes.empty()) throw JsonFault{"a class has no code"};
    one.name = json_string(json, "name");
    const ColourCodes colour = colour_of(json, "colour");
    const auto code = [](int value) { return static_cast<std::uint8_t>(value); };
    one.colour = {code(colour.red), code(colour.green), code(colour.blue)};
    one.materials = materials_from(json);
    const auto take = [&](const char* name, double low, double high, double& value) {
        if (json.contains(name)) value = json_number(json, name, low, high);
    };
    take("canopy_m", 0.0, 150.0, one.canopy_m);
    take("canopy_spread_m", 0.0, 150.0, one.canopy_spread_m);
    take("stems_per_ha", 0.0, 1.0e6, one.stems_per_ha);
    take("steepest_deg", 0.0, 90.0, one.steepest_deg);
    take("lowest_H_m", -12000.0, 9000.0, one.lowest_H_m);
    take("highest_H_m", -12000.0, 9000.0, one.highest_H_m);
    return one;
}

CoverTable table_from(const nlohmann::json& json) {
    refuse_unknown(json, "a table of land cover", {"title", "licence", "sources", "none", "classes"});
    CoverTable table;
    table.title = json_string(json, "title");
    if (json.contains("none")) table.none = codes_from(json, "none");
    const nlohmann::json& classes = json_field(json, "classes");
    if (!classes.is_array() || classes.empty() || classes.size() > most_cover_classes)
        throw JsonFault{"'classes' must be a list of 1 to 256"};
    for (const nlohmann::json& one : classes) {
        CoverClass next = class_from(one);
        for (const int code : next.codes)
            if (table.class_of(code) != nullptr || table.is_none(code))
                throw JsonFault{"code " + std::to_string(code) + " is there twice"};
        table.classes.push_back(std::move(next));
    }
    if (grounds_of(table).size() > most_grounds)
        throw JsonFault{"its classes have more than 15 different colours and materials together"};
    return table;
}

fs::path file_of_table(const std::string& table) {
    return is_table_path(table) ? fs::path(table) : data_folder() / "cover" / (table + ".json");
}

}  // namespace

std::vector<std::string> cover_table_names() {
    std::vector<std::string> names;
    std::error_code ignored;
    for (fs::directory_iterator at(data_folder() / "cover", ignored), end; !ignored && at != end;
         at.increment(ignored))
        if (at->path().extension() == ".json") names.push_back(at->path().stem().string());
    std::ranges::sort(names);
    return names;
}

bool is_table_path(const std::string& table) {
    return table.ends_with(".json");
}

Result<CoverChoice> cover_choice_from(const std::vector<std::string>& words) {
    CoverChoice choice;
    const std::vector<std::string> names = cover_table_names();
    for (const std::string& word : words) {
        const std::size_t comma = word.rfind(',');
        const std::string table = comma == std::string::npos ? "" : word.substr(comma + 1);
        const bool is_named = is_table_path(table) || std::ranges::find(names, table) != names.end();
        choice.files.push_back(is_named ? word.substr(0, comma) : word);
        if (!is_named) continue;
        if (!choice.table.empty() && choice.table != table)
            return refused("--landcover", word,
                           "all files have one table, and an earlier one has " + choice.table);
        choice.table = table;
    }
    return choice;
}

std::vector<std::string> words_of(const CoverChoice& choice) {
    std::vector<std::string> words = choice.files;
    if (!choice.table.empty())
        for (std::string& word : words) word += "," + choice.table;
    return words;
}

Result<CoverTable> cover_table_from(const std::string& text, const std::string& where) {
    try {
        return table_from(parsed_json(text));
    } catch (const JsonFault& fault) {
        return Error{ErrorKind::failed, where, "is no table of land cover: " + fault.what};
    } catch (const nlohmann::json::exception& fault) {
        return Error{ErrorKind::failed, where, std::string("is no table of land cover: ") + fault.what()};
    }
}

Result<CoverTableRead> read_cover_table(const std::string& table) {
    const std::string file = file_of_table(table).string();
    ORO_TRY(const std::string text, read_text_file(file));
    CoverTableRead read;
    ORO_TRY(read.table, cover_table_from(text, file));
    read.table.name = table;
    RunningChecksum sum;
    sum.add(std::as_bytes(std::span(text)));
    read.fingerprint = sum.sum();
    return read;
}

}  // namespace oro

#include "apps/fetch/tile_layouts.h"

#include <algorithm>
#include <filesystem>

#include "apps/report/json_fields.h"
#include "apps/settings/user_folders.h"
#include "apps/styles/data_folder.h"
#include "apps/styles/style_fields.h"
#include "core/base/file_there.h"

namespace oro {
namespace {

constexpr double most_tile_bytes = 8.0 * 1024 * 1024 * 1024;

std::string text_or_none(const nlohmann::json& json, const char* name) {
    return json.contains(name) ? json_string(json, name) : "";
}

// One of two words.
bool is_first_word(const nlohmann::json& json, const char* name, const char* first, const char* second) {
    const std::string word = json_string(json, name);
    if (word != first && word != second)
        throw JsonFault{"'" + std::string(name) + "' must be \"" + first + "\" or \"" + second + "\""};
    return word == first;
}

TileLayout layout_from(const std::string& name, const nlohmann::json& json) {
    refuse_unknown(json, ("source '" + name + "'").c_str(),
                   {"title", "url", "file", "side_deg", "format", "holds", "missing", "missing_words",
                    "most_bytes", "licence", "attribution", "page"});
    TileLayout layout;
    layout.name = name;
    layout.title = json_string(json, "title");
    layout.url = json_string(json, "url");
    layout.file = json_string(json, "file");
    layout.side_deg = static_cast<int>(json_whole(json, "side_deg", 1, 180));
    layout.format =
        is_first_word(json, "format", "hgt.gz", "geotiff") ? TileFormat::hgt_gz : TileFormat::geotiff;
    layout.holds =
        is_first_word(json, "holds", "heights", "land cover") ? TileHolds::heights : TileHolds::land_cover;
    layout.missing = is_first_word(json, "missing", "sea", "error") ? MissingTile::sea : MissingTile::error;
    layout.missing_words = text_or_none(json, "missing_words");
    layout.most_bytes = static_cast<std::uint64_t>(
        json_whole(json, "most_bytes", 1, static_cast<std::int64_t>(most_tile_bytes)));
    layout.licence = json_string(json, "licence");
    layout.attribution = json_string(json, "attribution");
    layout.page = text_or_none(json, "page");
    if (const std::string fault = fault_of(layout); !fault.empty())
        throw JsonFault{"of source '" + name + "', " + fault};
    return layout;
}

Result<void> add_layouts(const std::string& file, std::vector<TileLayout>& all) {
    ORO_TRY(const std::string text, read_text_file(file));
    ORO_TRY(const std::vector<TileLayout> layouts, tile_layouts_from(text, file));
    for (const TileLayout& layout : layouts) {
        std::erase_if(all, [&](const TileLayout& one) { return one.name == layout.name; });
        all.push_back(layout);
    }
    return {};
}

}  // namespace

Result<std::vector<TileLayout>> tile_layouts_from(const std::string& text, const std::string& where) {
    const auto wrong = [&](const std::string& what) {
        return Error{ErrorKind::failed, where, "is no table of sources: " + what};
    };
    try {
        const nlohmann::json json = parsed_json(text);
        refuse_unknown(json, "a table of sources", {"licence", "sources"});
        const nlohmann::json& sources = json_field(json, "sources");
        if (!sources.is_object()) return wrong("'sources' must be an object of sources by their names");
        std::vector<TileLayout> layouts;
        for (const auto& [name, source] : sources.items()) layouts.push_back(layout_from(name, source));
        return layouts;
    } catch (const JsonFault& fault) {
        return wrong(fault.what);
    } catch (const nlohmann::json::exception& fault) {
        return wrong(fault.what());
    }
}

Result<std::vector<TileLayout>> read_tile_layouts(const std::string& file) {
    std::vector<TileLayout> all;
    ORO_CHECK(add_layouts((data_folder() / "sources" / "sources.json").string(), all));
    // Without a folder for settings there is no table of the user's.
    if (const auto folder = user_config_folder(); folder.ok()) {
        const std::string own = (*folder / "sources.json").string();
        ORO_TRY(const bool is_own_there, is_there(own));
        if (is_own_there) ORO_CHECK(add_layouts(own, all));
    }
    if (!file.empty()) ORO_CHECK(add_layouts(file, all));
    std::ranges::sort(all, {}, &TileLayout::name);
    return all;
}

}  // namespace oro

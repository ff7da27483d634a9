#include "apps/fetch/public_sources.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/report/json_fields.h"
#include "apps/settings/user_folders.h"
#include "apps/styles/data_folder.h"
#include "apps/styles/style_fields.h"
#include "core/base/file_there.h"

namespace oro {
namespace {

constexpr std::int64_t most_tile_bytes = std::int64_t{8} << 30;
// A tile of one degree has some 8,500 pictures of it at the equator.
constexpr int most_terrarium_zoom = 15;
constexpr double most_cache_gb = 1e6;
// As much as is read of any JSON.
constexpr std::int64_t most_answer_bytes = std::int64_t{16} << 20;

// Folders of the cache and files of keys are called so.
bool is_name(const std::string& name) {
    return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_';
    });
}

std::string text_or_none(const nlohmann::json& json, const char* name) {
    return json.contains(name) ? json_string(json, name) : "";
}

// The value of one of some words.
template <class Value>
Value choice_in(const nlohmann::json& json, const char* name,
                const std::vector<std::pair<std::string, Value>>& choices) {
    const std::string word = json_string(json, name);
    std::string words;
    for (const auto& [one, value] : choices) {
        if (one == word) return value;
        words += (words.empty() ? "\"" : ", \"") + one + "\"";
    }
    throw JsonFault{"'" + std::string(name) + "' must be one of " + words};
}

// Of names that an object has twice the parser takes the second.
void refuse_names_given_twice(const std::string& text) {
    std::vector<std::set<std::string>> names;
    std::string twice;
    const auto look = [&](int, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
        if (event == nlohmann::json::parse_event_t::object_start) names.emplace_back();
        if (event == nlohmann::json::parse_event_t::object_end) names.pop_back();
        if (event == nlohmann::json::parse_event_t::key &&
            !names.back().insert(parsed.get<std::string>()).second)
            twice = parsed.get<std::string>();
        return true;
    };
    const nlohmann::json parsed_again = nlohmann::json::parse(text, look);
    if (!parsed_again.is_null() && !twice.empty()) throw JsonFault{"'" + twice + "' is there twice"};
}

std::string url_in(const nlohmann::json& json) {
    std::string url = json_string(json, "url");
    if (std::ranges::any_of(url, [](unsigned char c) { return c <= 0x20U || c == 0x7FU; }))
        throw JsonFault{"'url' holds a space or a control character"};
    return url;
}

TileLayout layout_from(const std::string& name, const nlohmann::json& json) {
    refuse_unknown(json, ("source '" + name + "'").c_str(),
                   {"title", "url", "file", "side_deg", "format", "holds", "missing", "missing_words",
                    "key_variable", "zoom", "most_bytes", "licence", "attribution", "page"});
    TileLayout layout;
    layout.name = name;
    layout.title = json_string(json, "title");
    layout.url = url_in(json);
    layout.file = json_string(json, "file");
    layout.side_deg = static_cast<int>(json_whole(json, "side_deg", 1, 180));
    layout.format = choice_in<TileFormat>(json, "format",
                                          {{"hgt.gz", TileFormat::hgt_gz},
                                           {"geotiff", TileFormat::geotiff},
                                           {"terrarium", TileFormat::terrarium}});
    layout.holds = choice_in<TileHolds>(json, "holds",
                                        {{"heights", TileHolds::heights},
                                         {"land cover", TileHolds::land_cover},
                                         {"canopy", TileHolds::canopy}});
    layout.missing =
        choice_in<MissingTile>(json, "missing", {{"sea", MissingTile::sea}, {"error", MissingTile::error}});
    layout.key_variable = text_or_none(json, "key_variable");
    if (layout.format == TileFormat::terrarium)
        layout.zoom = static_cast<int>(json_whole(json, "zoom", 0, most_terrarium_zoom));
    layout.missing_words = text_or_none(json, "missing_words");
    layout.most_bytes = static_cast<std::uint64_t>(json_whole(json, "most_bytes", 1, most_tile_bytes));
    layout.licence = json_string(json, "licence");
    layout.attribution = json_string(json, "attribution");
    layout.page = text_or_none(json, "page");
    if (const std::string fault = fault_of(layout); !fault.empty())
        throw JsonFault{"of source '" + name + "', " + fault};
    return layout;
}

PlacesSource places_from(const std::string& name, const nlohmann::json& json) {
    refuse_unknown(json, ("source '" + name + "'").c_str(),
                   {"title", "url", "format", "query", "most_bytes", "licence", "attribution", "page"});
    PlacesSource source;
    source.name = name;
    source.title = json_string(json, "title");
    source.url = url_in(json);
    source.query = json_string(json, "query");
    source.most_bytes = static_cast<std::uint64_t>(json_whole(json, "most_bytes", 1, most_answer_bytes));
    source.licence = json_string(json, "licence");
    source.attribution = json_string(json, "attribution");
    source.page = text_or_none(json, "page");
    if (const std::string fault = fault_of(source); !fault.empty())
        throw JsonFault{"of source '" + name + "', " + fault};
    return source;
}

// Adds the sources of a table, which count before those of the same names.
void add_sources(PublicSources more, PublicSources& all) {
    const auto remove = [&](const std::string& name) {
        std::erase_if(all.tiles, [&](const TileLayout& one) { return one.name == name; });
        std::erase_if(all.places, [&](const PlacesSource& one) { return one.name == name; });
    };
    if (more.cache_limit_gb) all.cache_limit_gb = more.cache_limit_gb;
    for (TileLayout& layout : more.tiles) {
        remove(layout.name);
        all.tiles.push_back(std::move(layout));
    }
    for (PlacesSource& source : more.places) {
        remove(source.name);
        all.places.push_back(std::move(source));
    }
}

Result<void> add_table(const std::string& file, PublicSources& all) {
    ORO_TRY(const std::string text, read_text_file(file));
    ORO_TRY(PublicSources sources, public_sources_from(text, file));
    add_sources(std::move(sources), all);
    return {};
}

}  // namespace

Result<PublicSources> public_sources_from(const std::string& text, const std::string& where) {
    const auto wrong = [&](const std::string& what) {
        return Error{ErrorKind::failed, where, "is no table of sources: " + what};
    };
    try {
        // The parser would take it for the end.
        if (text.find('\0') != std::string::npos) return wrong("it is no text");
        const nlohmann::json json = parsed_json(text);
        if (!json.is_object()) return wrong("an object with 'sources' was expected");
        refuse_names_given_twice(text);
        refuse_unknown(json, "a table of sources", {"licence", "sources", "cache_limit_gb"});
        const nlohmann::json& sources = json_field(json, "sources");
        if (!sources.is_object()) return wrong("'sources' must be an object of sources by their names");
        PublicSources all;
        if (json.contains("cache_limit_gb"))
            all.cache_limit_gb = json_number(json, "cache_limit_gb", 0.0, most_cache_gb);
        for (const auto& [name, source] : sources.items()) {
            if (!is_name(name))
                return wrong("'" + name + "' is no name of a source: letters, figures, '-' and '_' are");
            if (!source.is_object()) return wrong("source '" + name + "' must be an object");
            if (text_or_none(source, "format") == "overpass")
                all.places.push_back(places_from(name, source));
            else
                all.tiles.push_back(layout_from(name, source));
        }
        return all;
    } catch (const JsonFault& fault) {
        return wrong(fault.what);
    } catch (const nlohmann::json::exception& fault) {
        return wrong(fault.what());
    }
}

Result<PublicSources> read_public_sources(const std::string& file) {
    PublicSources all;
    ORO_CHECK(add_table((data_folder() / "sources" / "sources.json").string(), all));
    // Without a folder for settings there is no table of the user's.
    if (const auto folder = user_config_folder(); folder.ok()) {
        const std::string own = (*folder / "sources.json").string();
        ORO_TRY(const bool is_own_there, is_there(own));
        if (is_own_there) ORO_CHECK(add_table(own, all));
    }
    if (!file.empty()) ORO_CHECK(add_table(file, all));
    std::ranges::sort(all.tiles, {}, &TileLayout::name);
    std::ranges::sort(all.places, {}, &PlacesSource::name);
    return all;
}

}  // namespace oro

#include "geo/tilesets/feature_table.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "geo/tilesets/property_columns.h"

namespace oro {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_attributes = 100;

// The class and the table grow together, column by column.
struct FeatureColumns {
    std::span<const GlbFeature> features;
    std::vector<std::uint8_t>& bytes;
    Json& views;
    Json properties = Json::object(), columns = Json::object();
    std::set<std::string> names{};

    // No two properties have one name.
    template <class TextOf>
    void add(const std::string& id, std::string name, const TextOf& text_of) {
        while (!names.insert(name).second) name += " (attribute)";
        std::vector<std::string> texts;
        for (const GlbFeature& feature : features) texts.push_back(text_of(feature));
        properties[id]["name"] = name;
        properties[id]["type"] = "STRING";
        properties[id]["noData"] = "";
        columns[id] = texts_column(texts, bytes, views);
    }
};

// Names of properties have letters, digits and underscores alone.
std::string identifier_of(const std::string& name, std::set<std::string>& taken) {
    std::string id = "attribute_";
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        id += plain ? c : '_';
    }
    while (!taken.insert(id).second) id += '_';
    return id;
}

std::set<std::string> attribute_names(std::span<const GlbFeature> features) {
    std::set<std::string> names;
    for (const GlbFeature& feature : features)
        for (const auto& [name, text] : feature.attributes)
            if (names.size() < most_attributes) names.insert(name);
    return names;
}

std::string attribute_of(const GlbFeature& feature, const std::string& name) {
    const auto found =
        std::ranges::find_if(feature.attributes, [&](const auto& one) { return one.first == name; });
    return found == feature.attributes.end() ? "" : found->second;
}

}  // namespace

Json feature_table_json(std::span<const GlbFeature> features, std::vector<std::uint8_t>& bytes, Json& views) {
    FeatureColumns columns{features, bytes, views};
    columns.add("name", "Name", [](const GlbFeature& one) { return one.name; });
    columns.properties["name"]["semantic"] = "NAME";
    columns.add("type", "Type", [](const GlbFeature& one) { return one.type; });
    columns.add("part_of", "Part of", [](const GlbFeature& one) { return one.part_of; });
    columns.add("file", "File", [](const GlbFeature& one) { return one.file; });
    std::set<std::string> taken;
    for (const std::string& name : attribute_names(features))
        columns.add(identifier_of(name, taken), name,
                    [&](const GlbFeature& one) { return attribute_of(one, name); });
    Json table = Json::object();
    table["class"] = "feature";
    table["count"] = features.size();
    table["properties"] = std::move(columns.columns);
    Json json = Json::object();
    json["schema"]["id"] = "orograph_features";
    json["schema"]["classes"]["feature"]["properties"] = std::move(columns.properties);
    json["propertyTables"] = Json::array();
    json["propertyTables"].push_back(std::move(table));
    return json;
}

}  // namespace oro

#include "geo/tilesets/source_table.h"

#include <string>

#include "geo/tilesets/property_columns.h"

namespace oro {
namespace {

using Json = nlohmann::ordered_json;

constexpr double unknown = -1.0;  // as the class declares it

Json property_json(const char* type, const char* component, const char* description) {
    Json property = Json::object();
    property["type"] = type;
    if (component != nullptr) property["componentType"] = component;
    property["description"] = description;
    return property;
}

std::vector<std::string> texts_of(std::span<const GroundSource> sources, std::string GroundSource::*text) {
    std::vector<std::string> texts;
    for (const GroundSource& source : sources) texts.push_back(source.*text);
    return texts;
}

std::vector<float> numbers_of(std::span<const GroundSource> sources, double GroundSource::*number) {
    std::vector<float> numbers;
    for (const GroundSource& source : sources) numbers.push_back(static_cast<float>(source.*number));
    return numbers;
}

}  // namespace

Json source_class_json() {
    Json properties = Json::object();
    properties["name"] = property_json("STRING", nullptr, "The file of elevation data");
    properties["name"]["semantic"] = "NAME";
    properties["attribution"] = property_json("STRING", nullptr, "Whose data they are");
    properties["heights"] = property_json("STRING", nullptr, "What their heights refer to");
    properties["spacing_m"] = property_json("SCALAR", "FLOAT32", "Metres from post to post");
    properties["vertical_le90_m"] = property_json(
        "SCALAR", "FLOAT32", "Metres that nine heights in ten are off at most, as their makers state it");
    properties["vertical_le90_m"]["noData"] = unknown;
    Json json = Json::object();
    json["properties"] = std::move(properties);
    return json;
}

Json source_table_json(std::span<const GroundSource> sources, std::vector<std::uint8_t>& bytes, Json& views) {
    Json properties = Json::object();
    properties["name"] = texts_column(texts_of(sources, &GroundSource::name), bytes, views);
    properties["attribution"] = texts_column(texts_of(sources, &GroundSource::attribution), bytes, views);
    properties["heights"] = texts_column(texts_of(sources, &GroundSource::heights), bytes, views);
    properties["spacing_m"] = numbers_column(numbers_of(sources, &GroundSource::spacing_m), bytes, views);
    properties["vertical_le90_m"] =
        numbers_column(numbers_of(sources, &GroundSource::vertical_le90_m), bytes, views);
    Json table = Json::object();
    table["class"] = "source";
    table["count"] = sources.size();
    table["properties"] = std::move(properties);
    Json json = Json::object();
    json["schema"]["id"] = "orograph_sources";
    json["schema"]["classes"]["source"] = source_class_json();
    json["propertyTables"] = Json::array();
    json["propertyTables"].push_back(std::move(table));
    return json;
}

}  // namespace oro

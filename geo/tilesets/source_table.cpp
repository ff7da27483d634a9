#include "geo/tilesets/source_table.h"

#include <array>
#include <cstring>
#include <string>

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

template <class Value>
void append_value(std::vector<std::uint8_t>& bytes, Value value) {
    std::array<std::uint8_t, sizeof(Value)> raw;
    std::memcpy(raw.data(), &value, sizeof(Value));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

// Begins a view where 8 bytes begin, which suits any type.
class ViewBegun {
  public:
    ViewBegun(std::vector<std::uint8_t>& bytes, Json& views) : bytes_(bytes), views_(views) {
        constexpr std::size_t aligned = 8;
        while (bytes.size() % aligned != 0) bytes.push_back(0);
        at_ = bytes.size();
    }
    // Ends it; its number.
    std::size_t end() {
        Json view = Json::object();
        view["buffer"] = 0;
        view["byteOffset"] = at_;
        view["byteLength"] = bytes_.size() - at_;
        views_.push_back(std::move(view));
        return views_.size() - 1;
    }

  private:
    std::vector<std::uint8_t>& bytes_;
    Json& views_;
    std::size_t at_{};
};

Json texts_json(std::span<const GroundSource> sources, std::string GroundSource::*text,
                std::vector<std::uint8_t>& bytes, Json& views) {
    ViewBegun values(bytes, views);
    // An empty view is none.
    std::vector<std::uint32_t> ends{0};
    for (const GroundSource& source : sources) {
        const std::string& one = source.*text;
        bytes.insert(bytes.end(), one.begin(), one.end());
        ends.push_back(ends.back() + static_cast<std::uint32_t>(one.size()));
    }
    if (ends.back() == 0) bytes.push_back(0);
    Json json = Json::object();
    json["values"] = values.end();
    ViewBegun offsets(bytes, views);
    for (const std::uint32_t end : ends) append_value(bytes, end);
    json["stringOffsets"] = offsets.end();
    return json;
}

Json numbers_json(std::span<const GroundSource> sources, double GroundSource::*number,
                  std::vector<std::uint8_t>& bytes, Json& views) {
    ViewBegun values(bytes, views);
    for (const GroundSource& source : sources) append_value(bytes, static_cast<float>(source.*number));
    Json json = Json::object();
    json["values"] = values.end();
    return json;
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
    properties["name"] = texts_json(sources, &GroundSource::name, bytes, views);
    properties["attribution"] = texts_json(sources, &GroundSource::attribution, bytes, views);
    properties["heights"] = texts_json(sources, &GroundSource::heights, bytes, views);
    properties["spacing_m"] = numbers_json(sources, &GroundSource::spacing_m, bytes, views);
    properties["vertical_le90_m"] = numbers_json(sources, &GroundSource::vertical_le90_m, bytes, views);
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

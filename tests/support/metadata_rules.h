// What the 3D Metadata Specification (OGC 22-025r4, "3D Metadata Specification") demands of classes, entities
// and property tables, and EXT_structural_metadata and EXT_mesh_features (Cesium) of glTF. Read from the
// specifications alone: none of the project's own code is used. Each rule names its section.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace oro::test {

// Which rules do not hold, and where.
class BrokenRules {
  public:
    bool expect(bool holds, const std::string& where, const std::string& rule) {
        if (!holds) list_.push_back(where + ": " + rule);
        return holds;
    }
    [[nodiscard]] const std::vector<std::string>& list() const { return list_; }

  private:
    std::vector<std::string> list_;
};

// Concepts, Identifiers: letters, digits and underscores, not first a digit.
inline bool is_identifier(const std::string& text) {
    const auto is_letter = [](char c) {
        return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    return !text.empty() && is_letter(text.front()) &&
           std::ranges::all_of(text, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

// Schemas, Property, Component Type: the bytes of each.
inline const std::map<std::string, std::size_t>& component_bytes() {
    static const std::map<std::string, std::size_t> bytes{
        {"INT8", 1},   {"UINT8", 1}, {"INT16", 2},  {"UINT16", 2},  {"INT32", 4},
        {"UINT32", 4}, {"INT64", 8}, {"UINT64", 8}, {"FLOAT32", 4}, {"FLOAT64", 8}};
    return bytes;
}

// Schemas, Property, Type: the types of numbers, and how many components each has.
inline const std::map<std::string, std::size_t>& number_types() {
    static const std::map<std::string, std::size_t> types{
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    return types;
}

// Storage Formats, JSON Format: a number, a string, a boolean, or an array of numbers; of arrays an array of
// these.
inline bool is_of_type(const nlohmann::json& value, const nlohmann::json& property, bool is_element = false) {
    if (property.value("array", false) && !is_element) {
        if (!value.is_array()) return false;
        for (const auto& element : value)
            if (!is_of_type(element, property, true)) return false;
        return !property.contains("count") || property["count"] == value.size();
    }
    const std::string type = property.value("type", "");
    if (type == "SCALAR") return value.is_number();
    if (type == "STRING" || type == "ENUM") return value.is_string();
    if (type == "BOOLEAN") return value.is_boolean();
    const auto known = number_types().find(type);
    return known != number_types().end() && value.is_array() && value.size() == known->second;
}

inline void check_property(const nlohmann::json& property, const nlohmann::json& schema,
                           const std::string& where, BrokenRules& rules) {
    if (!rules.expect(property.is_object() && property.contains("type") && property["type"].is_string(),
                      where, "a property has a type (Property, Type)"))
        return;
    const std::string type = property["type"];
    const bool is_number = number_types().contains(type);
    rules.expect(is_number || type == "STRING" || type == "BOOLEAN" || type == "ENUM", where,
                 "the type is one of ten (Property, Type)");
    const std::string component = property.value("componentType", "");
    rules.expect(is_number ? component_bytes().contains(component) : component.empty(), where,
                 "numbers have a component type, and nothing else has one (Property, Component Type)");
    if (type == "ENUM")
        rules.expect(schema.contains("enums") && schema["enums"].contains(property.value("enumType", "")),
                     where, "an enum is one of the schema (Property, Enum Type)");
    if (property.contains("count"))
        rules.expect(
            property.value("array", false) && property["count"].is_number_integer() && property["count"] >= 2,
            where, "a count is that of an array, and 2 at least (Property, Arrays)");
    if (property.contains("noData"))
        rules.expect(type != "BOOLEAN" && is_of_type(property["noData"], property), where,
                     "noData is of the type, which is not boolean (Property, Required Properties, No Data "
                     "Values, and Default Values)");
}

inline void check_schema(const nlohmann::json& schema, const std::string& where, BrokenRules& rules) {
    rules.expect(schema.contains("id") && schema["id"].is_string() && is_identifier(schema["id"]), where,
                 "a schema has an identifier (Schemas, Schema, ID)");
    if (!rules.expect(schema.contains("classes") && schema["classes"].is_object(), where,
                      "a schema has classes (Schemas, Schema, Classes)"))
        return;
    for (const auto& [id, of] : schema["classes"].items()) {
        const std::string in_class = where + ", class " + id;
        rules.expect(is_identifier(id), in_class, "its name is an identifier (Schemas, Class, ID)");
        if (!rules.expect(
                of.contains("properties") && of["properties"].is_object() && !of["properties"].empty(),
                in_class, "a class has one property or more (Schemas, Class)"))
            continue;
        std::set<std::string> names;
        for (const auto& [property_id, property] : of["properties"].items()) {
            const std::string at = in_class + ", property " + property_id;
            rules.expect(is_identifier(property_id), at, "its name is an identifier (Schemas, Property, ID)");
            check_property(property, schema, at, rules);
            if (property.is_object() && property.contains("name"))
                rules.expect(names.insert(property["name"]).second, at,
                             "no other property of the class has its name (Schemas, Property, Name)");
        }
    }
}

// Concepts: an entity has no values but those that its class defines, and all that are required; Storage
// Formats, JSON Format: each of its type.
inline void check_entity(const nlohmann::json& entity, const nlohmann::json& schema, const std::string& where,
                         BrokenRules& rules) {
    const std::string name = entity.value("class", "");
    if (!rules.expect(schema.contains("classes") && schema["classes"].contains(name), where,
                      "an entity's class is in the schema (3D Tiles, Metadata, Assigning Metadata)"))
        return;
    const auto& properties = schema["classes"][name]["properties"];
    const auto values = entity.value("properties", nlohmann::json::object());
    for (const auto& [id, value] : values.items()) {
        const std::string at = where + ", property " + id;
        if (rules.expect(properties.contains(id), at, "the class has each property (Concepts)"))
            rules.expect(is_of_type(value, properties[id]), at,
                         "a value is of its property's type (Storage Formats, JSON Format)");
    }
    for (const auto& [id, property] : properties.items())
        rules.expect(!property.value("required", false) || values.contains(id), where + ", property " + id,
                     "what is required is there (Concepts)");
}

// The views and the buffer that the columns of a table are in.
struct TableBytes {
    const nlohmann::json& gltf;
    const std::string& buffer;  // number 0

    // Nothing where there is no such view. glTF 2.0, 3.6.1: a view lies in its buffer.
    [[nodiscard]] std::string view(const nlohmann::json& number, std::size_t aligned,
                                   const std::string& where, BrokenRules& rules) const {
        if (!rules.expect(number.is_number_unsigned() && number < gltf["bufferViews"].size(), where,
                          "a column is in a view (EXT_structural_metadata, Property Tables)"))
            return {};
        const auto& of = gltf["bufferViews"][number.get<std::size_t>()];
        const std::size_t first = of.value("byteOffset", std::size_t{0}), bytes = of["byteLength"];
        rules.expect(first % aligned == 0, where,
                     "a view begins at a multiple of its component's size (EXT_structural_metadata, Property "
                     "Tables)");
        if (!rules.expect(of["buffer"] == 0 && bytes > 0 && first + bytes <= buffer.size(), where,
                          "a view lies in its buffer and has a byte (glTF 2.0, 3.6.1)"))
            return {};
        return buffer.substr(first, bytes);
    }
};

inline bool is_utf8(const std::string& text) {
    try {
        return !nlohmann::json(text).dump().empty();
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

// Storage Formats, Binary Table Format, Strings: offsets one more than rows; they ascend, and lie in the
// values, which are UTF-8. Offsets are UINT32 where no type is given (EXT_structural_metadata).
inline void check_texts(const nlohmann::json& column, std::size_t rows, const TableBytes& bytes,
                        const std::string& where, BrokenRules& rules) {
    const std::string offset_type = column.value("stringOffsetType", "UINT32");
    if (!rules.expect(column.contains("stringOffsets") && offset_type == "UINT32", where,
                      "texts have offsets (Binary Table Format, Strings)"))
        return;
    const std::string values = bytes.view(column["values"], 1, where, rules),
                      offsets = bytes.view(column["stringOffsets"], 4, where, rules);
    if (!rules.expect(offsets.size() == 4 * (rows + 1), where,
                      "there is an offset more than rows (Binary Table Format, Strings)"))
        return;
    const auto offset = [&](std::size_t row) {
        std::uint32_t at = 0;
        std::memcpy(&at, offsets.data() + 4 * row, sizeof(at));
        return std::size_t{at};
    };
    for (std::size_t row = 0; row < rows; ++row) {
        if (!rules.expect(offset(row) <= offset(row + 1) && offset(row + 1) <= values.size(), where,
                          "offsets ascend and lie in the values (Binary Table Format, Strings)"))
            return;
        rules.expect(is_utf8(values.substr(offset(row), offset(row + 1) - offset(row))), where,
                     "texts are UTF-8 (Binary Table Format, Strings)");
    }
}

// Storage Formats, Binary Table Format, Scalars: packed without gaps; Property, Component Type: finite.
inline void check_numbers(const nlohmann::json& column, const nlohmann::json& property, std::size_t rows,
                          const TableBytes& bytes, const std::string& where, BrokenRules& rules) {
    const std::string component = property["componentType"];
    const std::size_t size = component_bytes().at(component);
    const std::string values = bytes.view(column["values"], size, where, rules);
    if (!rules.expect(values.size() == rows * number_types().at(property["type"]) * size, where,
                      "values are packed, one for each row (Binary Table Format, Scalars)"))
        return;
    for (std::size_t at = 0; component == "FLOAT32" && at < values.size(); at += size) {
        float value = 0.0F;
        std::memcpy(&value, values.data() + at, sizeof(value));
        rules.expect(std::isfinite(value), where, "numbers are finite (Property, Component Type)");
    }
}

// EXT_structural_metadata, Property Tables. Columns of texts and of numbers, without arrays, are known.
inline void check_table(const nlohmann::json& table, const nlohmann::json& schema, const TableBytes& bytes,
                        const std::string& where, BrokenRules& rules) {
    const std::string name = table.value("class", "");
    if (!rules.expect(schema.contains("classes") && schema["classes"].contains(name), where,
                      "a table's class is in the schema (Property Tables)"))
        return;
    if (!rules.expect(table.contains("count") && table["count"].is_number_unsigned() && table["count"] > 0,
                      where, "a table has a row or more (Property Tables)"))
        return;
    const auto& properties = schema["classes"][name]["properties"];
    const auto columns = table.value("properties", nlohmann::json::object());
    for (const auto& [id, column] : columns.items()) {
        const std::string at = where + ", column " + id;
        if (!rules.expect(properties.contains(id), at, "the class has each column (Property Tables)"))
            continue;
        if (!rules.expect(column.contains("values") && !properties[id].value("array", false), at,
                          "a column has values (Property Tables)"))
            continue;
        if (properties[id]["type"] == "STRING")
            check_texts(column, table["count"], bytes, at, rules);
        else if (rules.expect(number_types().contains(properties[id]["type"]), at,
                              "this check knows its type"))
            check_numbers(column, properties[id], table["count"], bytes, at, rules);
    }
    for (const auto& [id, property] : properties.items())
        rules.expect(!property.value("required", false) || columns.contains(id), where + ", column " + id,
                     "what is required is there (Property Tables)");
}

// EXT_mesh_features, Feature IDs: each set of them has a count, an attribute of whole numbers that are not
// normalized, and a table that is there and has a row for each.
inline void check_features(const nlohmann::json& primitive, const nlohmann::json& gltf,
                           const nlohmann::json& tables, const std::string& where, BrokenRules& rules) {
    const auto& sets = primitive["extensions"]["EXT_mesh_features"]["featureIds"];
    rules.expect(sets.is_array() && !sets.empty(), where,
                 "there is a set of ids (EXT_mesh_features, Overview)");
    for (const auto& set : sets) {
        if (!rules.expect(set.contains("featureCount") && set["featureCount"].is_number_unsigned() &&
                              set["featureCount"] > 0,
                          where, "a set has a count (Feature IDs)"))
            continue;
        if (set.contains("attribute")) {
            const std::string attribute = "_FEATURE_ID_" + set["attribute"].dump();
            if (rules.expect(primitive["attributes"].contains(attribute), where,
                             "the attribute is there (Feature ID by Vertex)")) {
                const auto& accessor =
                    gltf["accessors"][primitive["attributes"][attribute].get<std::size_t>()];
                const int component = accessor["componentType"];
                // Unsigned bytes, unsigned shorts, floats.
                rules.expect(accessor["type"] == "SCALAR" && !accessor.value("normalized", false) &&
                                 (component == 5121 || component == 5123 || component == 5126),
                             where, "ids are whole numbers (Feature ID by Vertex)");
            }
        }
        if (!set.contains("propertyTable")) continue;
        const auto& number = set["propertyTable"];
        if (rules.expect(number.is_number_unsigned() && number < tables.size(), where,
                         "the table is there (Referencing property tables)"))
            rules.expect(tables[number.get<std::size_t>()]["count"] >= set["featureCount"], where,
                         "the table has a row for each id (Referencing property tables)");
    }
}

}  // namespace oro::test

// Objects of JSON, made field by field. Of nested initializer lists whose making fails half-way (no memory),
// GCC 12 destroys what was never made. And [] on a value that is null makes it an object before there is one.
#pragma once

#include <nlohmann/json.hpp>
#include <utility>

namespace oro {

template <class Json>
void put_fields(Json&) {}
template <class Json, class Value, class... Rest>
void put_fields(Json& object, const char* name, Value&& value, Rest&&... rest) {
    object[name] = std::forward<Value>(value);
    put_fields(object, std::forward<Rest>(rest)...);
}

// An object with these fields, in this order: name, value, name, value. Throws std::bad_alloc.
template <class Json = nlohmann::ordered_json, class... NamesAndValues>
Json json_object(NamesAndValues&&... fields) {
    Json object = Json::object();
    put_fields(object, std::forward<NamesAndValues>(fields)...);
    return object;
}

// A list of these values. Throws std::bad_alloc.
template <class... Values>
nlohmann::ordered_json json_list(Values&&... values) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    (list.push_back(std::forward<Values>(values)), ...);
    return list;
}

}  // namespace oro

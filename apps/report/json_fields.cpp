#include "apps/report/json_fields.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>

#include "core/base/json_bounds.h"
#include "core/base/open_file.h"

namespace oro {
namespace {

using nlohmann::json;

std::string quoted(const char* name) {
    return "'" + std::string(name) + "'";
}

std::string text_of(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", number);
    return text.data();
}

JsonFault out_of_range(const char* name, const std::string& value, const std::string& low,
                       const std::string& high) {
    return {quoted(name) + " is " + value + ", not between " + low + " and " + high};
}

std::string string_of(const json& value, const char* name) {
    if (!value.is_string()) throw JsonFault{quoted(name) + " must be text, and is " + value.type_name()};
    auto text = value.get<std::string>();
    if (text.find('\0') != std::string::npos) throw JsonFault{quoted(name) + " holds a zero byte"};
    return text;
}

}  // namespace

const json& json_field(const json& object, const char* name) {
    if (!object.is_object()) throw JsonFault{"an object with " + quoted(name) + " was expected"};
    const auto found = object.find(name);
    if (found == object.end()) throw JsonFault{quoted(name) + " is missing"};
    return *found;
}

double json_number(const json& object, const char* name, double low, double high) {
    const json& value = json_field(object, name);
    if (!value.is_number()) throw JsonFault{quoted(name) + " must be a number, and is " + value.type_name()};
    const auto number = value.get<double>();
    if (!(number >= low && number <= high))
        throw out_of_range(name, text_of(number), text_of(low), text_of(high));
    return number;
}

std::int64_t json_whole(const json& object, const char* name, std::int64_t low, std::int64_t high) {
    const json& value = json_field(object, name);
    if (!value.is_number_integer())
        throw JsonFault{quoted(name) + " must be a whole number, and is " +
                        (value.is_number() ? text_of(value.get<double>()) : value.type_name())};
    const bool too_large =
        value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t{INT64_MAX};
    if (too_large || value.get<std::int64_t>() < low || value.get<std::int64_t>() > high)
        throw out_of_range(name, value.dump(), std::to_string(low), std::to_string(high));
    return value.get<std::int64_t>();
}

bool json_flag(const json& object, const char* name) {
    const json& value = json_field(object, name);
    if (!value.is_boolean())
        throw JsonFault{quoted(name) + " must be true or false, and is " + value.type_name()};
    return value.get<bool>();
}

std::string json_string(const json& object, const char* name) {
    return string_of(json_field(object, name), name);
}

std::vector<std::string> json_strings(const json& object, const char* name) {
    const json& value = json_field(object, name);
    if (!value.is_array()) throw JsonFault{quoted(name) + " must be a list, and is " + value.type_name()};
    std::vector<std::string> texts;
    for (const json& element : value) texts.push_back(string_of(element, name));
    return texts;
}

const json& json_array(const json& object, const char* name, std::size_t count) {
    const json& value = json_field(object, name);
    if (!value.is_array() || value.size() != count)
        throw JsonFault{quoted(name) + " must be a list of " + std::to_string(count)};
    return value;
}

namespace {

// The library repeats what it stumbled over, however long that is.
std::string in_brief(std::string what) {
    constexpr std::size_t most = 240;
    if (what.size() <= most) return what;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(what[end]) & 0xC0U) == 0x80U) --end;
    what.resize(end);
    return what + " ...";
}

}  // namespace

json parsed_json(const std::string& text) {
    if (auto much = beyond_json_bounds(text)) throw JsonFault{std::move(*much)};
    try {
        return json::parse(text);
    } catch (const json::exception& fault) {
        // Less the library's own numbering: "[json.exception.parse_error.101] parse error at line 1, ...".
        const std::string what = fault.what();
        const std::size_t bracket = what.find("] ");
        throw JsonFault{"is no JSON: " +
                        in_brief(bracket == std::string::npos ? what : what.substr(bracket + 2))};
    }
}

namespace {

Result<std::string> text_in(const std::string& path, OpenFile::Use use) {
    ORO_TRY(const OpenFile file, OpenFile::open(path, use));
    ORO_TRY(const std::uint64_t size, file.size());
    if (constexpr std::size_t most = JsonBounds{}.most_bytes; size > most)
        return Error{ErrorKind::failed, path,
                     "has " + std::to_string(size) + " bytes, more than the " + std::to_string(most) +
                         " that are read"};
    std::string text(size, '\0');
    ORO_CHECK(file.read(0, std::as_writable_bytes(std::span(text))));
    return text;
}

}  // namespace

Result<std::string> read_text_file(const std::string& path) {
    return text_in(path, OpenFile::Use::read);
}

Result<std::string> read_own_text_file(const std::string& path) {
    return text_in(path, OpenFile::Use::read_own);
}

}  // namespace oro

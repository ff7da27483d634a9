// Fields of JSON from a file, read as exactly what they must be: what a library would bend into shape (2^32 +
// 64 into 64, true into 1, 64.5 into 64) is a fault. Faults are thrown within apps and caught where the file
// is read.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// What is wrong in a JSON text, for people.
struct JsonFault {
    std::string what;
};

// The field of that name; a fault when `json` is no object or has none.
const nlohmann::json& json_field(const nlohmann::json& json, const char* name);
// A finite number, within the bounds.
double json_number(const nlohmann::json& json, const char* name, double low, double high);
// A whole number, within the bounds.
std::int64_t json_whole(const nlohmann::json& json, const char* name, std::int64_t low, std::int64_t high);
bool json_flag(const nlohmann::json& json, const char* name);
// Text without zero bytes.
std::string json_string(const nlohmann::json& json, const char* name);
std::vector<std::string> json_strings(const nlohmann::json& json, const char* name);
// An array of so many elements.
const nlohmann::json& json_array(const nlohmann::json& json, const char* name, std::size_t count);

// Parses a text within the bounds of core/base/json_bounds.h; the fault says where it goes wrong.
nlohmann::json parsed_json(const std::string& text);

// All of a file. Never waits: a pipe is refused. Errors: the file and the system's reason; no plain file;
// more bytes than any JSON may have.
Result<std::string> read_text_file(const std::string& path);
// Reads a file that the program keeps for itself, which is not remembered as read
// (core/base/files_read.h).
Result<std::string> read_own_text_file(const std::string& path);

// The name, or, of one that is no text or none that XML may hold, {"hex": "ff2e686774"}.
nlohmann::ordered_json path_json(const std::string& path);
// The path that a field holds as path_json() puts it. Throws JsonFault.
std::string path_from(const nlohmann::json& json, const char* name);

}  // namespace oro

#include "apps/report/json_fields.h"

#include <charconv>

#include "apps/report/json_object.h"

namespace oro {

nlohmann::ordered_json path_json(const std::string& path) {
    bool is_text =
        path.find("\xEF\xBF\xBE") == std::string::npos && path.find("\xEF\xBF\xBF") == std::string::npos;
    try {
        (void)nlohmann::json(path).dump();
    } catch (const nlohmann::json::exception&) {
        is_text = false;
    }
    if (is_text) return path;
    constexpr const char* digits = "0123456789abcdef";
    std::string hex;
    for (const char c : path) {
        hex += digits[static_cast<unsigned char>(c) >> 4U];
        hex += digits[static_cast<unsigned char>(c) & 15U];
    }
    return json_object("hex", hex);
}

std::string path_from(const nlohmann::json& json, const char* name) {
    if (!json_field(json, name).is_object()) return json_string(json, name);
    const std::string hex = json_string(json_field(json, name), "hex");
    std::string path;
    for (std::size_t at = 0; at + 1 < hex.size(); at += 2) {
        unsigned byte = 0;
        const auto [end, error] = std::from_chars(&hex[at], &hex[at] + 2, byte, 16);
        if (error != std::errc() || end != &hex[at] + 2 || byte == 0) break;
        path += static_cast<char>(static_cast<unsigned char>(byte));
    }
    if (path.empty() || path.size() * 2 != hex.size())
        throw JsonFault{"'" + std::string(name) + "' is no path in hexadecimal digits"};
    return path;
}

}  // namespace oro

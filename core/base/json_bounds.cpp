#include "core/base/json_bounds.h"

namespace oro {
namespace {

// Where the string that begins at `at` ends: its last quote, or the text's end.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    for (++at; at < text.size() && text[at] != '"'; ++at) {
        if (text[at] == '\\') ++at;
    }
    return at;
}

}  // namespace

std::optional<std::string> beyond_json_bounds(std::string_view text, const JsonBounds& bounds) {
    if (text.size() > bounds.most_bytes)
        return "has " + std::to_string(text.size()) + " bytes, more than the " +
               std::to_string(bounds.most_bytes) + " that are read";
    int depth = 0;
    std::size_t values = 1;  // a comma or a bracket before each but the first
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '"') {
            at = end_of_string(text, at);
            continue;
        }
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (depth > bounds.deepest)
            return "values are nested deeper than " + std::to_string(bounds.deepest) + " at byte " +
                   std::to_string(at);
        if ((c == '[' || c == '{' || c == ',') && ++values > bounds.most_values)
            return "holds more values than the " + std::to_string(bounds.most_values) + " that are read";
    }
    return std::nullopt;
}

}  // namespace oro

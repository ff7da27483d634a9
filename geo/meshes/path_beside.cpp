#include "geo/meshes/path_beside.h"

#include <charconv>
#include <cstddef>
#include <vector>

namespace oro {
namespace {

std::string without_codes(std::string_view uri) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned code = 0;
        const char* const digits = uri.data() + i + 1;
        const bool is_code = uri[i] == '%' && i + 2 < uri.size() &&
                             std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        path.push_back(is_code ? static_cast<char>(code) : uri[i]);
        if (is_code) i += 2;
    }
    return path;
}

}  // namespace

std::string_view folder_of_path(std::string_view path) {
    return path.substr(0, path.rfind('/') + 1);
}

std::optional<std::string> path_beside(std::string_view folder, std::string_view uri) {
    const std::string own = without_codes(uri.substr(0, uri.find_first_of("?#")));
    if (own.empty() || own.starts_with('/') || own.find(':') != std::string::npos ||
        own.find('\\') != std::string::npos || own.find('\0') != std::string::npos)
        return std::nullopt;
    const std::string all = std::string(folder) + own;
    std::vector<std::string_view> steps;
    for (std::string_view rest = all; !rest.empty();) {
        const std::size_t end = rest.find('/');
        const std::string_view step = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        if (step == "..") {
            if (steps.empty()) return std::nullopt;
            steps.pop_back();
        } else if (!step.empty() && step != ".") {
            steps.push_back(step);
        }
    }
    std::string path;
    for (const std::string_view step : steps) path.append(path.empty() ? "" : "/").append(step);
    if (path.empty() || all.ends_with('/')) return std::nullopt;
    return path;
}

}  // namespace oro

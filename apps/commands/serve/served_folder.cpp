#include "apps/commands/serve/served_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/report/xml_escape.h"
#include "geo/files/letter_case.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// A name as a part of an address (RFC 3986).
std::string address_part(const std::string& name) {
    constexpr const char* digits = "0123456789ABCDEF";
    std::string part;
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        const bool is_plain =
            (code < 128 && std::isalnum(code) != 0) || c == '-' || c == '.' || c == '_' || c == '~';
        if (is_plain)
            part += c;
        else
            part += {'%', digits[code >> 4U], digits[code & 15U]};
    }
    return part;
}

bool is_inside(const fs::path& root, const fs::path& path) {
    const auto [end_of_root, rest] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
    return end_of_root == root.end();
}

}  // namespace

Result<ServedFolder> ServedFolder::of(const std::string& path) {
    std::error_code problem;
    ServedFolder folder;
    folder.root_ = fs::canonical(path, problem);
    if (problem) return Error{ErrorKind::failed, path, problem.message()};
    if (!fs::is_directory(folder.root_, problem)) return Error{ErrorKind::failed, path, "is no folder"};
    return folder;
}

std::optional<fs::path> ServedFolder::inside(const std::string& address) const {
    if (address.empty() || address.front() != '/' || address.find('\0') != std::string::npos)
        return std::nullopt;
    const fs::path named(address.substr(1));
    if (named.is_absolute()) return std::nullopt;
    for (const fs::path& part : named)
        if (part.native().starts_with('.')) return std::nullopt;
    std::error_code problem;
    const fs::path real = fs::canonical(root_ / named, problem);
    if (problem || !is_inside(root_, real)) return std::nullopt;
    return real;
}

std::optional<fs::path> ServedFolder::file_of(const std::string& address) const {
    std::optional<fs::path> path = inside(address);
    std::error_code problem;
    if (path && fs::is_directory(*path, problem))
        path = inside(address + (address.ends_with('/') ? "index.html" : "/index.html"));
    if (!path || !fs::is_regular_file(*path, problem)) return std::nullopt;
    return path;
}

std::optional<std::string> ServedFolder::listing_of(const std::string& address) const {
    const std::optional<fs::path> path = inside(address);
    std::error_code problem;
    if (!path || !fs::is_directory(*path, problem)) return std::nullopt;
    std::vector<std::string> names;
    for (fs::directory_iterator entry(*path, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        std::error_code unreadable;
        if (!name.starts_with('.')) names.push_back(name + (entry->is_directory(unreadable) ? "/" : ""));
    }
    std::ranges::sort(names);
    const std::string base = address.ends_with('/') ? "" : address_part(path->filename().string()) + "/";
    std::string page =
        "<!doctype html><meta charset=\"utf-8\"><title>" + xml_escaped(address) + "</title>\n<ul>\n";
    for (const std::string& name : names) {
        const bool is_folder = name.ends_with('/');
        const std::string part = address_part(is_folder ? name.substr(0, name.size() - 1) : name);
        page +=
            "<li><a href=\"./" + base + part + (is_folder ? "/" : "") + "\">" + xml_escaped(name) + "</a>\n";
    }
    return page + "</ul>\n";
}

std::string media_type_of(const fs::path& file) {
    static constexpr std::array<std::pair<const char*, const char*>, 18> types{{
        {".html", "text/html; charset=utf-8"},
        {".css", "text/css"},
        {".js", "text/javascript"},
        {".mjs", "text/javascript"},
        {".json", "application/json"},
        {".geojson", "application/geo+json"},
        {".png", "image/png"},
        {".jpg", "image/jpeg"},
        {".webp", "image/webp"},
        {".svg", "image/svg+xml"},
        {".tif", "image/tiff"},
        {".glb", "model/gltf-binary"},
        {".gltf", "model/gltf+json"},
        {".terrain", "application/vnd.quantized-mesh"},
        {".wasm", "application/wasm"},
        {".xml", "application/xml"},
        {".txt", "text/plain; charset=utf-8"},
        {".ico", "image/x-icon"},
    }};
    const std::string ending = lower_case(file.extension().string());
    const auto* const found =
        std::ranges::find_if(types, [&](const auto& type) { return ending == type.first; });
    return found == types.end() ? "application/octet-stream" : found->second;
}

}  // namespace oro

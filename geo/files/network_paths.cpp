#include "geo/files/network_paths.h"

#include <algorithm>
#include <array>

namespace oro {
namespace {

bool is_allowed = false;

}  // namespace

bool is_network_path(std::string_view path) {
    constexpr std::array<std::string_view, 7> systems{"/vsicurl", "/vsis3",  "/vsigs",   "/vsiaz",
                                                      "/vsiadls", "/vsioss", "/vsiswift"};
    return std::ranges::any_of(systems, [&](std::string_view system) {
        if (!path.starts_with(system)) return false;
        const std::string_view rest = path.substr(system.size());
        return rest.starts_with('/') || rest.starts_with('?') || rest.starts_with("_streaming/");
    });
}

void allow_network_paths() {
    is_allowed = true;
}

bool are_network_paths_allowed() {
    return is_allowed;
}

}  // namespace oro

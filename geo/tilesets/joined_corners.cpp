#include "geo/tilesets/joined_corners.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace oro {
namespace {

// Three bytes, as a file has them.
int colour_code(const std::array<double, 3>& light) {
    int code = 0;
    for (const double part : light)
        code = 256 * code + static_cast<int>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
    return code;
}

}  // namespace

void JoinedCorners::add(const glm::ivec3& at, const glm::vec3& normal, std::uint16_t feature,
                        const std::array<double, 3>& colour) {
    constexpr float fineness = 127.0F;
    const glm::ivec3 rounded(glm::round(fineness * normal));
    const auto [vertex, is_new] =
        known_.try_emplace({at.x, at.y, at.z, rounded.x, rounded.y, rounded.z, feature, colour_code(colour)},
                           static_cast<std::uint32_t>(mesh_.positions.size()));
    mesh_.indices.push_back(vertex->second);
    mesh_.ground_triangles = mesh_.indices.size() / 3;
    if (!is_new) return;
    mesh_.positions.push_back(at);
    if (has_normals_)
        mesh_.normals.push_back(normal == glm::vec3(0.0F) ? glm::vec3(0.0F, 0.0F, 1.0F) : normal);
    facts_.features.push_back(feature);
    facts_.colours.push_back(colour);
}

}  // namespace oro

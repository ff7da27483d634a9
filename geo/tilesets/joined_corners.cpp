#include "geo/tilesets/joined_corners.h"

#include <glm/common.hpp>

namespace oro {

void JoinedCorners::add(const glm::ivec3& at, const glm::vec3& normal, std::uint16_t feature,
                        const std::array<double, 3>& colour) {
    constexpr float fineness = 127.0F;
    const glm::ivec3 rounded(glm::round(fineness * normal));
    const std::array<std::uint8_t, 4> bytes = colour_bytes(colour);
    const auto [vertex, is_new] = known_.try_emplace({at.x, at.y, at.z, rounded.x, rounded.y, rounded.z,
                                                      feature, bytes[0] << 16 | bytes[1] << 8 | bytes[2]},
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

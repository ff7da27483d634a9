// Vertices of files that write each corner again.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>

#include "geo/meshes/source_mesh.h"

namespace oro {

// Numbers the vertices of a mesh, which outlives it: corners that are equal to the bit are one vertex, and
// both zeros are equal.
class EqualCorners {
  public:
    explicit EqualCorners(SourceMesh& mesh) : mesh_(mesh) {}

    std::uint32_t vertex(const glm::dvec3& place) {
        // Adding 0 makes one of both zeros.
        const Key key{std::bit_cast<std::uint64_t>(place.x + 0.0),
                      std::bit_cast<std::uint64_t>(place.y + 0.0),
                      std::bit_cast<std::uint64_t>(place.z + 0.0)};
        const auto [found, is_new] =
            numbers_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
        if (is_new) mesh_.vertices.push_back(place);
        return found->second;
    }

  private:
    using Key = std::array<std::uint64_t, 3>;
    struct Hash {
        std::size_t operator()(const Key& key) const {
            std::uint64_t mixed = 0;
            for (const std::uint64_t part : key) mixed = std::rotl((mixed ^ part) * 0x9E3779B97F4A7C15U, 31);
            return mixed;
        }
    };
    SourceMesh& mesh_;
    std::unordered_map<Key, std::uint32_t, Hash> numbers_;
};

}  // namespace oro

// Triangles of meshes as nodes of up to 128, for the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/seam/seam.h"
#include "shaders/shared_mesh_pages.h"

namespace oro {

// A node as it lies in a page's words (shared_mesh_pages.h), but that its places are counted from a point of
// its own: from_origin() counts them from the page's.
struct MeshNode {
    std::vector<std::uint32_t> words;
    std::array<std::int64_t, 3> first_steps{};  // the least of its vertices along x, y and z of ECEF, steps
    bool has_last_half{};
    std::vector<glm::dvec3> places_m;  // of its vertices, ECEF
    double lowest_h_m{}, highest_h_m{};
    std::uint32_t triangles{};
};

// The pieces, in their order, as nodes. Each has the places that a page of posts would give it, to the bit.
// Takes some 0.5 us a triangle. Errors: a triangle of more than 1,048 km.
Result<std::vector<MeshNode>> mesh_nodes(std::span<const SeamPiece> pieces);

// Counts a node's places from the origin of its page, steps. Errors: it reaches more than 1,048 km from it.
Result<void> from_origin(const std::array<std::int64_t, 3>& origin_steps, MeshNode& node);

}  // namespace oro

// What is known of a placed mesh besides its triangles, as bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geo/meshes/placed_mesh.h"

namespace oro {

// Its name without folders, CRS, heights, features with their attributes, look, and counts. The same mesh
// gives the same bytes.
[[nodiscard]] std::vector<std::byte> facts_to_bytes(const PlacedMesh& mesh);
// The inverse, for a mesh without triangles. Nothing where the bytes are none that facts_to_bytes() gives.
[[nodiscard]] std::optional<PlacedMesh> facts_from_bytes(std::span<const std::byte> bytes);

}  // namespace oro

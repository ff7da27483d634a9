// What is known of a placed mesh besides its triangles, as bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geo/meshes/placed_mesh.h"

namespace oro {

// Its name without folders, CRS, heights, features with their attributes, look, crease, and counts. colours:
// of its vertices as the stored mesh numbers them; or none. The same mesh gives the same bytes.
[[nodiscard]] std::vector<std::byte> facts_to_bytes(const PlacedMesh& mesh,
                                                    ScratchVector<VertexColour> colours = {});
// The inverse, for a mesh without triangles; its colours are those. Nothing where the bytes are none that
// facts_to_bytes() gives.
[[nodiscard]] std::optional<PlacedMesh> facts_from_bytes(std::span<const std::byte> bytes);

}  // namespace oro

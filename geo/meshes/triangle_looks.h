// What each triangle of a placed mesh is coloured as.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geo/meshes/placed_mesh.h"

namespace oro {

struct TriangleLook {
    std::uint32_t look{};  // gpu::mesh_look_...
    float tone{};          // 0 to 1, what tells features apart (tone_of())
};

// Those of a mesh's features, which it is asked for once. The mesh outlives it.
class TriangleLooks {
  public:
    explicit TriangleLooks(const PlacedMesh& mesh);
    // By the number of the triangle. gpu::mesh_look_coloured where the file states colours of its corners, or
    // a part's colour is shown.
    [[nodiscard]] TriangleLook of(std::size_t triangle) const;

  private:
    const PlacedMesh& mesh_;
    std::vector<TriangleLook> features_;
};

}  // namespace oro

// The triangles of a mesh out of the payloads of its leaves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mesh_file/mesh_leaves.h"
#include "core/streamed_mesh/mesh_payload.h"

namespace oro {

// Vertices at one place are one.
class JoinedLeaves {
  public:
    // leaves: how many there are.
    JoinedLeaves(std::size_t leaves, bool has_labels);
    // The triangles of the leaf of that number: so many of a payload, from that one on.
    void add(std::uint32_t leaf, const MeshPayload& payload, std::size_t first, std::size_t count);
    // After all of them: leaf by leaf, with vertices numbered as the triangles meet them. It is then of no
    // use.
    [[nodiscard]] MeshLeaves take();

  private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    std::uint32_t vertex(const LatticeSteps& at);
    void grow();

    struct Leaf {
        std::vector<VertexTriangle> triangles;
        std::vector<std::uint32_t> labels;
    };
    std::vector<Leaf> leaves_;
    bool has_labels_;
    std::vector<LatticeSteps> places_;  // in the order in which leaves were added
    // Numbers of vertices, each where its place's hash leads to or behind that. A power of two of them.
    std::vector<std::uint32_t> table_;
};

}  // namespace oro

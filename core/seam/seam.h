// What is drawn beside grids: between those that lie over each other the ground that is left of cut
// triangles, and what closes gaps along rims; and triangles of meshes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/seam/vertex_colour.h"

namespace oro {

struct SeamCorner {
    Ecef at;
    double h_m{};         // above the ellipsoid, as drawn
    glm::dvec3 normal{};  // unit, of the smooth ground there, ECEF
};

// Anticlockwise, seen from above; of a mesh either way round.
struct SeamPiece {
    std::array<SeamCorner, 3> corners;
    bool two_sided{};      // of a mesh, whose sides may both be seen: light is that of the eye's side
    std::uint32_t look{};  // of a mesh: gpu::mesh_look_...
    float tone{};          // of a mesh: 0 to 1, what tells its features apart
    std::array<VertexColour, 3> colours{};  // of the corners, where the look is gpu::mesh_look_coloured
};

// Upright ground along a piece of a rim, from one surface to the other; no higher than a line where the two
// meet. Where it is drawn it reaches out by as many pixels as the levels of both sides may be off
// (FrameConstants.tau_px): upwards at its top, and at its foot downwards and sidewards, under what lies
// there.
struct SeamSkirt {
    std::array<SeamCorner, 2> top;
    std::array<SeamCorner, 2> foot;
    glm::dvec3 up{};    // unit, ECEF
    glm::dvec3 side{};  // unit, level
    bool of_mesh{};     // beside a mesh that terrain is cut out under: it casts the mesh's shadow
};

struct Seam {
    std::vector<SeamPiece> pieces;
    std::vector<SeamSkirt> skirts;
    [[nodiscard]] bool empty() const { return pieces.empty() && skirts.empty(); }
};

}  // namespace oro

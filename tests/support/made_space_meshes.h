// Meshes in space that tests make: closed ones, a town, a folded sheet.
#pragma once

#include <cstdint>

#include "tests/support/mesh_cuts.h"

namespace oro::test {

// On the lattice of 2^-11 m, as meshes are.
glm::dvec3 on_lattice(const glm::dvec3& at);
// A ball with hills: closed, 4 n (n - 1) triangles.
SpaceMesh hilly_ball(std::uint32_t n, double radius_m);
// Boxes that touch nothing, 12 triangles each: closed.
SpaceMesh box_town(std::uint32_t rows);
// A sheet that is folded over itself like a letter, layers half a metre apart: open, no height field.
SpaceMesh folded_sheet(std::uint32_t n);
// Hills with walls upright on each third row: where a wall stands edges have three triangles. 2 n n triangles
// of hills, 4 n a wall.
SpaceMesh walled_hills(std::uint32_t n);

// Hills of a metre below and around box_town(rows), in triangles of 12 m: houses stand in them.
MeshGround hills_below_town(std::uint32_t rows);

// Boxes of many sizes anywhere on hills of 40 m, and the hills: in triangles of 90 m, beyond the middle of 30
// m.
struct TownOnHills {
    SpaceMesh houses;
    MeshGround ground;
};
TownOnHills town_on_hills(int houses, unsigned seed);

}  // namespace oro::test

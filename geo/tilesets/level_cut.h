// The triangles of one level of a tileset, and which of them each tile has.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "geo/tilesets/clustered_ground.h"
#include "geo/tilesets/tileset_layout.h"

namespace oro {

// The cut of the cluster graph for an error: whole clusters, so without gaps. Neighbouring tiles of a level
// have what a triangle over their border is divided into.
struct LevelCut {
    double step_m{};  // that positions are rounded to
    std::vector<VertexTriangle> triangles;
    // Of each triangle: bound of the distance, metres, between a place of the surface and what the triangle
    // has in its stead; 0 where it is one of the surface itself. Rounded up.
    std::vector<float> errors_m;
    std::vector<std::vector<std::uint32_t>> tiles;  // triangles that reach into each tile, by its number
};

// error_m: what no triangle of the cut is above.
LevelCut level_cut(const ClusteredGround& ground, const TilesetLayout& layout, int level, double error_m,
                   double step_m);

// Of each vertex of the surface that is in the cut: the unit normal, ECEF, of the triangles around it, each
// weighed by its area; 0 of others. 12 bytes a post.
std::vector<glm::vec3> normals_of(const ClusteredGround& ground, const LevelCut& cut);

}  // namespace oro

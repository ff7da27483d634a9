// How triangles of meshes lie on the GPU: nodes of up to 128 triangles, in as few bits as each needs.
// Compiled as C++ and as GLSL, as shared.h is. core/seam/mesh_node.h packs them, place/mesh.glsl reads them.
#ifndef OROGRAPH_SHADERS_SHARED_MESH_PAGES_H
#define OROGRAPH_SHADERS_SHARED_MESH_PAGES_H

#include "shaders/shared.h"

#ifdef __cplusplus
namespace oro::gpu {
#endif

// A page has words in the place of PageBlock.heights: for each of its 256 nodes the first of its words, 0
// where there is none; then the nodes. A node is two halves (shared_halves.h), each of which has vertices of
// its own.
ORO_CONST uint mesh_half_vertices = 40u;    // at most, of a half
ORO_CONST uint mesh_last_vertex = 41u;      // number of the last half's first vertex in its meshlet
ORO_CONST uint mesh_attributes_max = 255u;  // of a node

// A node: a word of counts, mesh_widths words of widths, mesh_columns words of what is added to each column's
// numbers; then the rows of four tables, bit by bit: vertices, triangles, looks (2^n of them, n the bits of a
// look's number), attributes.
ORO_CONST uint mesh_widths = 3u;
ORO_CONST uint mesh_columns = 10u;
ORO_CONST uint mesh_head_words = 14u;
// Bits of the first word: vertices of both halves, 6 each, triangles of both, 7 each, mesh_by_vertex.
ORO_CONST uint mesh_by_vertex_bit = 26u;  // each vertex has one attribute, that of its own number
// Columns, 6 bits a width, 4 of them a word; the last word has two, then how many bits an attribute's and a
// look's number have, 6 each.
ORO_CONST uint mesh_column_x =
    0u;  // steps of height_step_m from the page's origin, along x, y and z of ECEF,
ORO_CONST uint mesh_column_h = 3u;       // ... and of the height above the ellipsoid
ORO_CONST uint mesh_column_normal = 4u;  // along x, y and z, in parts of seam_unit
ORO_CONST uint mesh_column_code = 7u;    // three codes of sRGB, 8 bits each
ORO_CONST uint mesh_column_look = 8u;    // mesh_look_...
ORO_CONST uint mesh_column_tone = 9u;    // in parts of seam_unit
// A triangle: three vertices of its half, 6 bits each, three attributes where vertices do not say them, a
// look.
ORO_CONST uint mesh_vertex_bits = 6u;

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

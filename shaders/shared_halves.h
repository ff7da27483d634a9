// Part of shared.h, which includes it: halves of meshlets, which the mesh path may draw one by one. Not for
// anybody else.
#ifndef OROGRAPH_SHADERS_SHARED_HALVES_H
#define OROGRAPH_SHADERS_SHARED_HALVES_H

// 4 of a meshlet's rows of quads, or 4 of its columns.
ORO_CONST uint half_quads = 4u;
ORO_CONST uint half_vertices = 45u;
ORO_CONST uint half_triangles = 64u;
// What of a meshlet has triangles: both halves, or one alone. Columns count where both halves by rows have
// some. There are two bits for it: a meshlet whose last columns alone have triangles is one with both halves.
ORO_CONST uint both_halves = 0u;
ORO_CONST uint first_rows = 1u;
ORO_CONST uint last_rows = 2u;
ORO_CONST uint first_columns = 3u;
ORO_CONST uint halves_bit = 30u;  // of PageBlock.boxes, from where on it says which

#endif

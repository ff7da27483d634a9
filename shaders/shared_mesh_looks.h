// How triangles of meshes are coloured where ground is coloured by materials. Part of shared.h, which includes it; and
// where no trees are planted because of them.
#ifndef OROGRAPH_SHADERS_SHARED_MESH_LOOKS_H
#define OROGRAPH_SHADERS_SHARED_MESH_LOOKS_H

ORO_CONST uint mesh_look_ground = 0u;  // as the ground of grids: a survey
ORO_CONST uint mesh_look_built = 1u;   // walls of plaster and roofs, of a hue by the feature's tone
ORO_CONST uint mesh_look_plain = 2u;   // one grey
ORO_CONST uint mesh_look_paved = 3u;
ORO_CONST uint mesh_look_water = 4u;
ORO_CONST uint mesh_look_coloured = 5u;  // by the colours of its corners, which the file states
ORO_CONST uint mesh_looks = 8u;  // there are fewer

// Ground near meshes, from above: a map in a plane that touches the ellipsoid, of square cells. Each has two bytes,
// the lowest of a uint: 255 where triangles lie over it, less with the distance of the nearest to 0 at
// cleared_reach_m and beyond; then the same of built triangles alone.
struct ClearedGround {
    uvec2 cells;   // device address of uint[side.x * side.y], row by row; 0: there is none
    uvec2 side;    // columns, rows
    vec2 eye;      // (column, row) of the eye, in cells; cells' middles lie at halves
    vec3 along_x;  // columns a metre of view coordinates
    vec3 along_y;  // rows a metre
};
ORO_CONST float cleared_reach_m = 64.0f;

#endif

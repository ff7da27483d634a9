// Grass on a grid's ground near the eye, as a frame has it on the GPU. Compiled as C++ and as GLSL.
#ifndef OROGRAPH_SHADERS_SHARED_MEADOW_H
#define OROGRAPH_SHADERS_SHARED_MEADOW_H

#include "shaders/shared_growth.h"
#ifdef __cplusplus
namespace oro::gpu {
#endif

// Clumps of grass stand on a lattice that divides that of trees: a tile of trees' sites has 32 x 32 tiles of
// grass, some 8 m a side, and these 32 x 32 clumps. A GrowthTile tells where one lies, `row` and `column`
// being those of the finer lattice.
ORO_CONST uint meadow_tiles_per_side = 32u;  // of a tile of trees' sites
ORO_CONST uint clumps_per_side = 32u;        // of a tile of grass
ORO_CONST uint clumps_per_tile = 1024u;
ORO_CONST uint blades_per_clump = 32u;  // 512 a square metre; a tile takes as many triangle ids as a page
ORO_CONST uint clump_group = 128u;      // clumps that a workgroup goes through
ORO_CONST uint clump_groups_per_tile = 8u;
ORO_CONST uint meadow_tiles_max = 1024u;  // of a grid in a frame
ORO_CONST float meadow_reach_m = 60.0f;   // no grass is farther from the eye

// A clump as a frame has it: none where it keeps no blade.
struct MeadowClump {
    vec3 foot;       // metres, view coordinates
    uint slope;      // two half floats: what the ground rises for a metre east, and north
    uint red_green;  // half floats: the light that the ground there sends back
    uint blue_kept;  // half float; then how many blades it keeps, of blades_per_clump, in 1/1024
    float size;      // of its blades, 1 being the usual one
};

// The grass of a grid in a frame. `growth` is as for trees, with tiles of grass, and no lists; `sites` are
// MeadowClump[clumps_per_tile * tile_count].
struct MeadowTable {
    GrowthTable growth;
    uvec2 pieces;  // device address of MeadowPieces, then their words
    uint piece_max;
};
// A quarter of a clump's blades that has some to draw: its tile, clump and quarter, of 10, 10 and 2 bits.
ORO_CONST uint blades_per_piece = 8u;
ORO_CONST uint pieces_per_group = 16u;
struct MeadowPieces {
    uint groups[3];  // of an indirect dispatch: their number, 1, 1
    uint count;
};

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

// What the CPU and the GPU both know of patches of fixed size: as shaders/shared.h, for shaders/patches and render/patches alone.
#ifndef OROGRAPH_SHADERS_SHARED_PATCHES_H
#define OROGRAPH_SHADERS_SHARED_PATCHES_H
#include "shaders/shared.h"
#ifdef __cplusplus
namespace oro::gpu {
using glm::ivec3;
#endif

// A patch covers 8 x 8 quads of posts whatever it is drawn with: 2^level squares along a side, level 0 to 3.
ORO_CONST uint patch_quads = 8u;
ORO_CONST uint patch_finest = 3u;
ORO_CONST uint patch_vertices_most = 81u;
ORO_CONST uint patch_triangles_most = 128u;
ORO_CONST uint patches_per_choice = 64u;  // of a workgroup that chooses levels
ORO_CONST uint patch_group_size = 64u;    // of one that draws a patch by compute
ORO_CONST float patch_near_m = 0.1f;
ORO_CONST uint patch_by_distance = 4u;  // in place of a level that all have

// What a border does where the neighbour is coarser.
ORO_CONST uint patch_borders_open = 0u;     // nothing: there are gaps
ORO_CONST uint patch_borders_mean = 1u;     // its vertices get the mean height of the neighbour's beside them, as published
ORO_CONST uint patch_borders_shared = 2u;   // it has the neighbour's vertices alone

// All that the programs of a frame of patches are told; pushed, so at most 128 bytes.
struct PatchFrame {
    vec3 right, up, forward;  // of the eye, unit vectors of ECEF
    vec2 scale;               // one over the tangent of half the field of view, across and down
    ivec3 eye;                // 2^-6 m of ECEF
    uvec2 heights;            // device address: int[side * side], 2^-11 m, row by row from the north; side = 8 * patches + 1
    uvec2 rows;               // ... MadeRow[side]
    uvec2 columns;            // ... MadeColumn[side]
    uvec2 levels;             // ... uint[patches * patches]
    uvec2 visibility;         // ... of the compute way: a word of 64 bits a pixel
    uint patches;             // along a side
    uint size_px;             // width, height << 16
    float middle_m;           // H of a patch's middle, as far as its distance goes
    float nearest_m;          // up to nearest_m + band_m level 3, one band farther level 2, and so on
    float band_m;
    uint level;               // of all patches, or patch_by_distance
    uint borders;             // patch_borders_...
};

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

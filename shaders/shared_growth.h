// Trees over a grid's ground as a frame has them on the GPU. Compiled as C++ and as GLSL; not a part of shared.h, for
// only what draws trees needs it.
#ifndef OROGRAPH_SHADERS_SHARED_GROWTH_H
#define OROGRAPH_SHADERS_SHARED_GROWTH_H

#ifdef __cplusplus
#include "shaders/shared.h"
namespace oro::gpu {
#endif

// A bit of MaterialTable.on: trees stand where the materials are forest.
ORO_CONST uint materials_with_trees = 2u;
// ... and grass near the eye where they are meadow (shared_meadow.h).
ORO_CONST uint materials_with_grass = 4u;

// Sites where a tree may stand: rows of latitude from the south pole on, and in each tile of 64 rows a whole number of
// columns round the Earth from 180 degrees west on. So a site has the same numbers in every dataset, and there is no
// seam.
ORO_CONST uint sites_per_side = 64u;      // of a tile
ORO_CONST uint sites_per_tile = 4096u;
ORO_CONST uint site_tile_rows = 78144u;   // from pole to pole: rows of sites are 3.9998 m apart at 45 degrees
ORO_CONST uint site_group = 128u;         // sites that a workgroup goes through
ORO_CONST uint site_groups_per_tile = 32u;
ORO_CONST uint growth_tiles_max = 8192u;  // of a grid in a frame
ORO_CONST uint ids_per_site = 8u;         // a tile takes as many triangle ids as a page

// A tile of sites as a frame has it.
struct GrowthTile {
    uint row;  // of the lattice's tiles
    uint column;
    uint page;    // number in the frame of the finest page that covers all of it
    int post[2];  // (row, column) of a post of the region near its south-west corner
    // From there to its corners, rows and columns: south-west, south-east, north-west, north-east. Linear between.
    vec2 corners[4];
};

// How many pixels a forest without drawn trees rises above its ground at most; no more are looked through.
ORO_CONST uint canopy_search_px = 32u;

// The trees of a grid in a frame.
struct GrowthTable {
    uvec2 tiles;  // device address of GrowthTile[tile_count]
    uvec2 sites;  // ... of uint[sites_per_tile * tile_count]: what stands on each site
    uint tile_count;
    uint first_page;   // triangle ids of its tiles begin with those of that page of the frame
    float reach_m;     // no tree is farther from the eye
    // uint[shade_map_side^2]: how far towards the sun the first leaves are, seen from there; 0: no shadows of trees.
    uvec2 shade_map;
    // float: the farthest depth of the ground in each block of 8 x 8 pixels, row by row; 0: what the ground hides is not left out.
    uvec2 farthest;
    uvec2 lists;  // ... of CrownLists
    // uint[sites_per_tile * tile_count]: sites where a tree, or its shadow, may be in the picture; as many as CrownLists has asked for.
    uvec2 asked;
    uvec2 canopy;  // uvec2 for each pixel, row by row: what it shows (growth/pixels_kept.glsl)
};

// A crown that covers many pixels, as all its pieces have it.
struct LargeCrown {
    vec3 foot;  // ... and so on, as Crown of growth.glsl
    vec3 axes[3];
    float low_m;
    float high_m;
    float radius_m;
    float shell;
    uint kind;
    uint hash;
    uint id;
    uint first_px;  // of its box: x | y << 16
    uint last_px;
    float begins_m;  // metres before the eye, its nearest leaves
};
// Work that is spread over more invocations than one a tree: pieces of crowns that cover many pixels, of 32 x 32, and trees whose shadow may
// be seen. A site here is its number in its tile and 4096 times that of the tile. A piece is its number in its crown's box of pixels, and
// 2^15 times that of the crown; pieces of near crowns come first.
ORO_CONST uint crown_piece_px = 32u;
ORO_CONST uint crown_piece_bits = 15u;
ORO_CONST uint crown_piece_max = 524288u;
ORO_CONST uint large_crown_max = 131072u;
ORO_CONST uint crown_list_max = 65535u;
ORO_CONST uint crown_step_count = 64u;  // steps of distance (crown_steps.glsl)
ORO_CONST uint sorted_by_group = 2048u;  // pieces that a workgroup of sort_pieces.comp takes
struct CrownLists {
    uint piece_groups[3];  // of an indirect dispatch: pieces, folded into rows
    uint shade_groups[3];
    uint site_groups[3];  // of site_group sites that are asked for, folded into rows
    uint sort_groups[3];
    uint asked_count;
    uint piece_count;  // of those that were asked for: more than the list has room for, perhaps
    uint crown_count;  // ... the same
    uint pieces_at[64];  // each step of distance
    uint sorted_at[64];  // ... of these, so far
    LargeCrown crowns[131072];
    uint found[524288];   // pieces
    uint pieces[524288];  // ... in their order
    uint shades[65535];   // site
};
ORO_CONST uint depth_block_px = 8u;

// The shadows of trees around the eye: a map in a plane across the sun's direction, whose middle is the eye.
ORO_CONST uint shade_map_side = 2048u;
ORO_CONST float shade_map_cell_m = 0.36f;
ORO_CONST float shade_map_reach_m = 360.0f;  // to a cell less than its rim
ORO_CONST float shade_map_base_m = 4096.0f;  // added to what it holds, which is positive so

// What stands on a site: 0 for nothing, or kind and shares in 255ths.
ORO_CONST uint site_needle = 1u;    // kind: the lowest two bits
ORO_CONST uint site_broad = 2u;
ORO_CONST uint site_in_forest = 4u;  // among others
ORO_CONST uint site_sun_bit = 8u;   // eight bits: the sun's light on a stand, of most_sun
ORO_CONST float most_sun = 1.5f;    // times that on level ground
ORO_CONST uint site_size_bit = 16u; // eight bits: the share of a grown tree's height
ORO_CONST uint site_patch_bit = 24u; // eight bits: the noise of the forest's colour there, of -most_patch to most_patch
ORO_CONST float most_patch = 2.0f;

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

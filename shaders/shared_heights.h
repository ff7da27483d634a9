// How a page's heights lie on the GPU when they are packed: in the place of PageBlock::heights, in as few bits as
// each 8 x 8 posts need. Compiled as C++ and as GLSL, as shared.h is. core/packed/packed_heights.h packs them.
#ifndef OROGRAPH_SHADERS_SHARED_HEIGHTS_H
#define OROGRAPH_SHADERS_SHARED_HEIGHTS_H

#include "shaders/shared.h"

#ifdef __cplusplus
namespace oro::gpu {
#endif

ORO_CONST uint height_bits_packed = 0u;  // FrameConstants.height_bits: heights are packed
// Blocks of 8 x 8 posts, the first of them at post (-1, -1) of the page; the last row and column of blocks have 3.
ORO_CONST uint packed_side = 8u;
ORO_CONST uint packed_blocks_per_side = 17u;
ORO_CONST uint packed_blocks = 289u;
// Parts of a step that slopes and the unit count in: 2^8 and 2^12 of them.
ORO_CONST uint packed_slope_bits = 8u;
ORO_CONST uint packed_unit_bits = 12u;
// Bits of PackedBlock.codes.
ORO_CONST uint packed_word_bits = 15u;   // the first word of its codes,
ORO_CONST uint packed_count_bits = 6u;   // ... then how many bits a code has of steps, and how many of units,
ORO_CONST uint packed_void_bit = 27u;    // ... then whether a code of ones alone is a void post

ORO_CONST uint packed_words_before = 3335u;  // of a PageBlock, before its heights

// The height of the post in row i and column j of a block, whose code is (units << steps' bits) + steps, is
//     base + floor((i along_rows + j along_columns) / 2^8) + floor(units * unit / 2^12) + steps
struct PackedBlock {
    int base;  // steps of height_step_m
    int along_rows;
    int along_columns;
    uint codes;
};

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

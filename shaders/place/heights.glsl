// Heights of a page's posts, however they are kept (FrameConstants.height_bits). Needs frame.glsl.
#include "shaders/shared_heights.h"
#include "shaders/place/mesh.glsl"

// A page whose heights are packed: what lies in the place of PageBlock.heights.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer PackedPages {
    uint before[packed_words_before];
    uint unit;
    PackedBlock blocks[packed_blocks];
    uint codes[];
};

// Whether the frame's pages may have packed heights: programs without the code for them take fewer registers.
layout(constant_id = 100) const bool heights_packed = false;  // render/pipelines/pipeline_parts.cpp

// As unpacked_height of core/packed/packed_heights.cpp.
int packed_height(PackedPages page, uvec2 place) {
    uvec2 at = place / packed_side, within = place % packed_side;
    PackedBlock block = page.blocks[at.x * packed_blocks_per_side + at.y];
    uint step_bits = bitfieldExtract(block.codes, int(packed_word_bits), int(packed_count_bits));
    uint unit_bits = bitfieldExtract(block.codes, int(packed_word_bits + packed_count_bits), int(packed_count_bits));
    uint bits = step_bits + unit_bits, columns = at.y + 1u < packed_blocks_per_side ? packed_side : height_stride % packed_side;
    uint bit = (within.x * columns + within.y) * bits;
    uint word = bitfieldExtract(block.codes, 0, int(packed_word_bits)) + bit / 32u, first = bit % 32u;
    uint code = page.codes[word] >> first;
    if (first + bits > 32u) code |= page.codes[word + 1u] << (32u - first);
    uint ones = bitfieldExtract(0xffffffffu, 0, int(bits));
    code &= ones;
    if (code == ones && (block.codes >> packed_void_bit & 1u) != 0u) return void_height;
    uint high, low;
    umulExtended(bitfieldExtract(code, int(step_bits), int(unit_bits)), page.unit, high, low);
    int plane = (int(within.x) * block.along_rows + int(within.y) * block.along_columns) >> packed_slope_bits;
    return block.base + plane + int(high << (32u - packed_unit_bits) | low >> packed_unit_bits) +
           int(bitfieldExtract(code, 0, int(step_bits)));
}

// A height of a page by its row and column among its 131 x 131, in steps of height_step_m; void_height where there is none.
int stored_height(PageBlocks block, uvec2 place) {
    if (draws_meshes()) return void_height;  // its words are no heights
    if (heights_packed && FRAME.height_bits == height_bits_packed) return packed_height(PackedPages(block), place);
    uint number = place.x * height_stride + place.y;
    if (FRAME.height_bits == 32u) return block.at[0].heights[number];
    int code = bitfieldExtract(block.at[0].heights[number >> 1u], int(number & 1u) * 16, 16);
    if (code == void_code) return void_height;
    return (code << FRAME.height_shift) + FRAME.height_offset;
}

int post_height(PageBlocks block, uvec2 post) {
    if (draws_meshes()) return mesh_height(MeshWords(block), post);
    return stored_height(block, post + 1u);
}

// The buffers of a frame as shaders see them: its constants are a uniform buffer, all else is reached by device address from there.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/shared.h"

#define ORO_FUNCTION
#define ORO_PRECISE precise

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer PageBlocks { PageBlock at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer PlacesOfPages { PagePlaces at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer FramePages { FramePage at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer RowTable { RowTerms at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer ColumnTable { ColumnTerms at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Words { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Floats { float at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Counts { FrameCounts at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Recorded { vec3 at[]; };
// The compute rasteriser's visibility buffer as words: x all bits of the triangle id turned round (0: none), y those of the depth.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer VisibilityWords { uvec2 at[]; };

// The id in a pixel of it.
uint id_of(uvec2 word) { return word.x == 0u ? 0u : ~word.x; }

// The frame's constants, read where they are used: a copy would drag the tint table into every invocation.
layout(binding = 3, scalar) uniform Frame { FrameConstants frame; };
#define FRAME frame
// Whether posts lie on a net. A program that is made for one kind of region says so itself: the other kind's code costs registers.
#ifndef HAS_NET
#define HAS_NET (FRAME.has_net != 0u)
#endif

// What has no posts lies on a net.
bool has_posts() { return !HAS_NET || FRAME.contents == contents_posts; }
FramePages frame_pages() { return FramePages(FRAME.pages); }

// Triangle ids: page of this frame, meshlet of the page, triangle of the meshlet; 0 is the background. Where a frame draws several
// grids, pages are counted on from one to the next.
uint triangle_id(uint frame_page, uint meshlet, uint triangle) {
    return (((FRAME.first_page + frame_page) * meshlets_per_page + meshlet) * meshlet_triangles + triangle) + 1u;
}
// The inverse, of this grid: its triangle, whose page is number / 32768 and so on.
uint triangle_of_id(uint id) { return id - 1u - FRAME.first_page * (meshlets_per_page * meshlet_triangles); }
// Whether an id is a triangle of this grid.
bool is_of_grid(uint id) {
    return id != 0u && (FRAME.other_grids == 0u || triangle_of_id(id) < FRAME.page_count * (meshlets_per_page * meshlet_triangles));
}
// Whether a pixel is left to another grid of the frame: what shows no ground at all is the first's to colour.
bool is_left_to_others(uint id) { return id == 0u ? FRAME.first_page != 0u : !is_of_grid(id); }

// The edges (levels.glsl) of a drawn node, by its number in the frame: page * 256 + meshlet.
uint edges_of(uint node) { return Words(FRAME.edges).at[node / 8u] >> (node % 8u * 4u) & 15u; }

// A float that is a whole number, at most 2^22 and not negative, as an integer. A driver that compiles for processors converts other floats
// one by one, and GPUs at a quarter of their speed.
uint whole_number(float whole) { return floatBitsToUint(whole + 8388608.0) - 0x4b000000u; }
uvec2 whole_numbers(vec2 whole) { return floatBitsToUint(whole + 8388608.0) - 0x4b000000u; }
// ... -2^22 to 2^22.
int whole_signed(float whole) { return floatBitsToInt(whole + 12582912.0) - 0x4b400000; }
ivec2 whole_signed(vec2 whole) { return floatBitsToInt(whole + 12582912.0) - 0x4b400000; }

// The other way: integers below 2^23, and of -2^22 to 2^22, as floats.
float as_float(uint number) { return uintBitsToFloat(number | 0x4b000000u) - 8388608.0; }
vec2 as_floats(uvec2 numbers) { return uintBitsToFloat(numbers | 0x4b000000u) - 8388608.0; }
vec2 as_floats(ivec2 numbers) { return intBitsToFloat(numbers + 0x4b400000) - 12582912.0; }
float power_of_two(uint exponent) { return uintBitsToFloat((127u + exponent) << 23u); }

// The number of this workgroup in a dispatch that was folded into rows.
uint folded(uvec3 group) { return group.y * groups_per_row + group.x; }

// The corner of a meshlet in its page.
uvec2 first_post(uint meshlet) {
    return uvec2(meshlet / meshlets_per_side, meshlet % meshlets_per_side) * meshlet_quads;
}

// Whether a quad is split from its south-west to its north-east post, by its number in a meshlet of a page, row by row; by its row and
// column in the page. What is drawn asks triangle_posts().
bool sw_ne_in_meshlet(PageBlocks block, uint meshlet, uint quad) {
    return (block.at[0].sw_ne[meshlet * 2u + quad / 32u] >> (quad % 32u) & 1u) != 0u;
}
bool sw_ne_at(PageBlocks block, uvec2 quad) {
    uint meshlet = quad.x / meshlet_quads * meshlets_per_side + quad.y / meshlet_quads;
    return sw_ne_in_meshlet(block, meshlet, quad.x % meshlet_quads * meshlet_quads + quad.y % meshlet_quads);
}

// The posts of one of a quad's two triangles (0: that with its western edge) as (row, column), counter-clockwise seen from above;
// as core/terrain/cell_diagonal.h has them.
void quad_posts(uvec2 nw, bool sw_ne, uint odd, out uvec2 a, out uvec2 b, out uvec2 c) {
    uvec2 sw = nw + uvec2(1u, 0u), se = nw + uvec2(1u, 1u), ne = nw + uvec2(0u, 1u);
    a = sw_ne && odd != 0u ? sw : nw;
    b = odd == 0u ? sw : se;
    c = sw_ne || odd != 0u ? ne : se;
}

// Posts of a page as row << 8 | column: are they on both sides of the meridian where the flat Earth is cut? Between them it would
// be drawn from one end to the other.
bool is_cut(uint frame_page, uint a, uint b, uint c) {
    if (FRAME.cut_column == no_column) return false;
    FramePage page = frame_pages().at[frame_page];
    uvec3 columns = min(page.first_column + ((uvec3(a, b, c) & 255u) << page.level), uvec3(FRAME.last_column));
    return min(columns.x, min(columns.y, columns.z)) <= FRAME.cut_column && FRAME.cut_column < max(columns.x, max(columns.y, columns.z));
}

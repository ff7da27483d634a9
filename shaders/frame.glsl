// The buffers of a frame as shaders see them: everything is reached from one device address.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "shared.h"

#define ORO_FUNCTION

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer PageBlocks { PageBlock at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer FramePages { FramePage at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Counts { FrameCounts at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Recorded { vec3 at[]; };
// The compute rasteriser's visibility buffer as words: x the triangle id, y the bits of the depth.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer VisibilityWords { uvec2 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Frame { FrameConstants at; };

layout(push_constant, scalar) uniform Push {
    uvec2 frame_address;
    uint first_page;  // of this draw, in the frame's list
};

// The frame's constants, read where they are used: a copy would drag the tint table into every invocation.
#define FRAME (Frame(frame_address).at)
FramePages frame_pages() { return FramePages(Frame(frame_address).at.pages); }

// Triangle ids: page of this frame, meshlet of the page, triangle of the meshlet; 0 is the background.
uint triangle_id(uint frame_page, uint meshlet, uint triangle) {
    return ((frame_page * meshlets_per_page + meshlet) * meshlet_triangles + triangle) + 1u;
}

// The three posts of a meshlet's triangle as (row, column) within the meshlet. Cells are split from their north-west to their
// south-east post; both triangles run counter-clockwise seen from above.
void triangle_posts(uint triangle, out uvec2 a, out uvec2 b, out uvec2 c) {
    uint cell = triangle >> 1u;
    uvec2 nw = uvec2(cell / meshlet_quads, cell % meshlet_quads);
    a = nw;
    if ((triangle & 1u) == 0u) {
        b = nw + uvec2(1u, 0u);
        c = nw + uvec2(1u, 1u);
    } else {
        b = nw + uvec2(1u, 1u);
        c = nw + uvec2(0u, 1u);
    }
}

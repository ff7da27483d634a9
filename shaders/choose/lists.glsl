// The lists that the compute rasteriser's steps hand on. Needs frame.glsl.

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Lists { RasterLists at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Live { LivePages at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTriangles { LargeTriangle at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTasks { LargeTask at[]; };

// How many find room in the lists: all that the buffers hold, but in tests of full lists (render/pipelines/pipeline_parts.cpp).
layout(constant_id = 101) const uint boxes_room = boxes_max;
layout(constant_id = 102) const uint large_room = large_max;
layout(constant_id = 103) const uint tasks_room = tasks_max;
layout(constant_id = 104) const uint clips_room = clips_max;

layout(push_constant, scalar) uniform Round { FrameRound round; };

Lists lists_at(uint number) {
    uint carry, low = uaddCarry(FRAME.lists.x, number * raster_lists_bytes, carry);
    return Lists(uvec2(low, FRAME.lists.y + carry));
}
// Those of this grid and round.
Lists lists() { return lists_at(round.lists); }

// The lists that the compute rasteriser's steps hand on. Needs frame.glsl.

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Lists { RasterLists at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Live { LivePages at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTriangles { LargeTriangle at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTasks { LargeTask at[]; };

layout(push_constant, scalar) uniform Round { FrameRound round; };

Lists lists_at(uint number) {
    uint carry, low = uaddCarry(FRAME.lists.x, number * raster_lists_bytes, carry);
    return Lists(uvec2(low, FRAME.lists.y + carry));
}
// Those of this grid and round.
Lists lists() { return lists_at(round.lists); }

// The lists that the compute rasteriser's steps hand on. Needs frame.glsl.

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Lists { RasterLists at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Live { LivePages at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTriangles { LargeTriangle at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTasks { LargeTask at[]; };

layout(push_constant, scalar) uniform Round { FrameRound round; };

// Those of this grid and round.
Lists lists() {
    uint carry, low = uaddCarry(FRAME.lists.x, round.lists * raster_lists_bytes, carry);
    return Lists(uvec2(low, FRAME.lists.y + carry));
}

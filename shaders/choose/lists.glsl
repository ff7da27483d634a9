// The lists that the compute rasteriser's steps hand on. Needs frame.glsl.

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Lists { RasterLists at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Live { LivePages at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTriangles { LargeTriangle at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTasks { LargeTask at[]; };

Lists lists() { return Lists(FRAME.lists); }

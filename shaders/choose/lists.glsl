// The lists that the compute rasteriser's steps hand on. Needs frame.glsl.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Lists { RasterLists at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Live { LivePages at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTriangles { LargeTriangle at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTasks { LargeTask at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Visibility { uint64_t at[]; };

Lists lists() { return Lists(FRAME.lists); }

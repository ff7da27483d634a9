#version 460
// Writes the blade's id; depth goes the fixed way.
#ifdef PER_PRIMITIVE
#extension GL_EXT_mesh_shader : require
layout(location = 0) perprimitiveEXT flat in uint in_id;
#else
layout(location = 0) flat in uint in_id;
#endif
layout(location = 0) out uint out_id;

void main() { out_id = in_id; }

#version 460
// Writes the triangle's id; depth goes the fixed way.
#extension GL_EXT_mesh_shader : require
layout(location = 0) perprimitiveEXT flat in uint in_id;
layout(location = 0) out uint out_id;

void main() { out_id = in_id; }

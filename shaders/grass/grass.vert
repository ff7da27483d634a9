#version 460
// The vertex way: an instance is a blade of a list, drawn as a strip. Control points are reckoned again for each vertex, as published.
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/grass.glsl"

layout(location = 0) flat out uint out_id;

void main() {
    uint number = listed_clump(grass.list, uint(gl_InstanceIndex) / blades_per_clump), blade = uint(gl_InstanceIndex) % blades_per_clump;
    uint vertices = grass.list == 0u ? blade_vertices_most : blade_vertices_least;
    out_id = blade_id(number, blade);
    gl_Position = grass_clip(grass.view, blade_vertex(blade_of_clump(clump_numbered(number), blade), uint(gl_VertexIndex), vertices));
}

// Triangles of meshes that cast shadows: a tree of boxes, as both sides know it.
#ifndef OROGRAPH_SHADERS_SHARED_MESH_CASTERS_H
#define OROGRAPH_SHADERS_SHARED_MESH_CASTERS_H
#include "shaders/shared.h"

#ifdef __cplusplus
namespace oro::gpu {
#endif

// Axes are those of ECEF, places are from the tree's origin; metres.
struct MeshNode {
    vec3 low;
    uint first;  // of its triangles; of two nodes below, the first
    vec3 high;
    uint count;  // of its triangles; 0: it has two nodes
};
struct MeshTriangle {
    vec3 corner;
    vec3 one;    // the second corner less the first
    vec3 other;  // ... the third
};
ORO_CONST uint mesh_tree_depth = 40u;
ORO_CONST uint mesh_sun_lines = 8u;  // over the sun's disc, each for as much of it
// What a frame is told of them.
struct MeshShadows {
    uvec2 nodes;      // device addresses
    uvec2 triangles;
    vec3 eye_m;       // from the origin
    vec2 meridian;    // the eye's longitude: cosine, sine
};

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

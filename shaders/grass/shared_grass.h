// What the CPU and the GPU both know of grass: sizes, and the structs that lie in GPU memory or are pushed. As shaders/shared.h, for
// shaders/grass and render/grass alone.
#ifndef OROGRAPH_SHADERS_SHARED_GRASS_H
#define OROGRAPH_SHADERS_SHARED_GRASS_H
#include "shaders/shared.h"
#ifdef __cplusplus
namespace oro::gpu {
#endif

// A clump is four blades around a site of a lattice; a blade is a strip of triangles along a quadratic Bezier curve, of an even number of
// vertices: two for each step along it.
ORO_CONST uint blades_per_clump = 4u;
ORO_CONST uint blade_vertices_most = 32u;
ORO_CONST uint blade_vertices_least = 6u;
ORO_CONST uint blade_level_count = 14u;  // of even numbers of vertices, from the least to the most
// Mesh shaders: a workgroup's vertices; clumps that a task workgroup sorts by their blades' vertices.
ORO_CONST uint grass_group_vertices = 128u;
ORO_CONST uint grass_group_triangles = 120u;  // of the most that 128 vertices make: four blades of 32
ORO_CONST uint grass_group_blades = 21u;      // likewise: 21 blades of six
ORO_CONST uint grass_group_size = 32u;
ORO_CONST uint clumps_per_task = 128u;
// Compute: workgroups of the pass that chooses clumps, and clumps of a workgroup that draws.
ORO_CONST uint clumps_per_cull = 128u;
ORO_CONST uint clumps_per_raster = 64u;

// A field of clumps: a lattice around the origin of coordinates that are x to the east, y to the north, z up, in metres.
struct GrassField {
    uint clumps;  // the first of rows * columns
    uint columns;
    uint rows;
    float spacing_m;
};
// Where a clump stands, and what its blades are drawn by lot from.
struct GrassClump {
    vec3 foot;
    uint seed;
};
// A picture's eye. The axes are unit vectors, at right angles.
struct GrassView {
    vec3 eye;
    vec3 right;
    vec3 up;
    vec3 forward;
    vec2 scale;  // one over the tangent of half the field of view, across and down
};
// All that the programs of a frame of grass are told; pushed, so at most 128 bytes.
struct GrassFrame {
    GrassView view;
    uvec2 clumps;      // device address: GrassClump[field.clumps]
    uvec2 lists;       // ... GrassLists, then the clumps of its two lists, field.clumps each
    uvec2 visibility;  // ... of the compute way: a word of 64 bits a pixel
    GrassField field;
    uint size_px;      // width, height << 16
    float switch_m;    // up to this distance of the eye blades have more than the fewest vertices
    float wind_time_s; // negative: no wind
    float margin_m;    // how far beside the picture a clump is still drawn
    uint flags;        // grass_...
    uint list;         // vertex way: which of the two lists a draw reads
};
ORO_CONST uint grass_by_boxes = 1u;  // clumps are left out by what they may cover, not by their foot
ORO_CONST uint grass_thins = 2u;     // no blade is narrower than a pixel: the farther, the fewer and wider
// Arguments of indirect draws and dispatches, as Vulkan lays them out. List 0: clumps nearer than the switch distance, 1: the others.
struct GrassDraw {
    uint vertices;
    uint instances;  // blades
    uint first_vertex;
    uint first_instance;
};
struct GrassLists {
    GrassDraw draws[2];
    uint one_group[3];      // 1, 1, 1: the task workgroup of clumps.task
    uint task_groups[3];    // of packed.task
    uint raster_groups[3];  // of grass_raster.comp
    uint clumps;            // of both lists
    uint mesh_groups;       // that mesh ways have started
};

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

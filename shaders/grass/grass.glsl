// What the programs of a frame of grass read and write.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/grass/shared_grass.h"
#define ORO_FUNCTION
#define ORO_PRECISE precise
#include "shaders/grass/blade.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer GrassClumps { GrassClump at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer GrassListed {
    GrassLists at;
    uint numbers[];  // of clumps: those of the first list, then, from field.clumps on, of the second
};
layout(push_constant, scalar) uniform Pushed { GrassFrame grass; };

uint width_px() { return grass.size_px & 0xffffu; }
uint height_px() { return grass.size_px >> 16; }

// How many clumps a list has, and the number in the field of one of them.
uint listed_clumps(uint list) { return GrassListed(grass.lists).at.draws[list].instances / blades_per_clump; }
uint listed_clump(uint list, uint at) { return GrassListed(grass.lists).numbers[list * grass.field.clumps + at]; }
// ... of both lists, one after the other.
uint clump_of_both(uint at) {
    uint nearer = listed_clumps(0u);
    return at < nearer ? listed_clump(0u, at) : listed_clump(1u, at - nearer);
}

// Ids: of the field's blades; 0 is the background.
uint blade_id(uint clump, uint blade) { return clump * blades_per_clump + blade + 1u; }

GrassClump clump_numbered(uint number) { return GrassClumps(grass.clumps).at[number]; }
GrassBlade blade_of_clump(GrassClump clump, uint blade) {
    return blade_of(clump, blade, clump_blade_width(grass.view, height_px(), grass.flags, clump), grass.wind_time_s);
}
uint vertices_of_clump(GrassClump clump) { return blade_vertices(eye_distance(grass.view, clump), grass.switch_m); }

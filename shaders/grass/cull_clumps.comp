#version 460
// Lists the clumps that a frame draws, by distance: one invocation a clump, and one atomic addition a workgroup and list.
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/grass.glsl"

layout(local_size_x = 128) in;  // clumps_per_cull
shared uint counted[2];
shared uint first[2];

void main() {
    uint lane = gl_LocalInvocationIndex, number = gl_GlobalInvocationID.x;
    if (lane < 2u) counted[lane] = 0u;
    barrier();
    bool is_drawn = number < grass.field.clumps;
    uint list = 0u, rank = 0u;
    if (is_drawn) {
        GrassClump clump = clump_numbered(number);
        float width = clump_blade_width(grass.view, height_px(), grass.flags, clump);
        is_drawn = clump_in_view(grass.view, clump, width, grass.margin_m, grass.flags) &&
                   ((grass.flags & grass_thins) == 0u || clump_is_kept(grass.field, number, width));
        list = grass_list_of(eye_distance(grass.view, clump), grass.switch_m);
    }
    if (is_drawn) rank = atomicAdd(counted[list], 1u);
    barrier();
    GrassListed lists = GrassListed(grass.lists);
    if (lane < 2u && counted[lane] > 0u)
        first[lane] = atomicAdd(lists.at.draws[lane].instances, counted[lane] * blades_per_clump) / blades_per_clump;
    if (lane == 0u && counted[0] + counted[1] > 0u) {
        uint more = counted[0] + counted[1], all = atomicAdd(lists.at.clumps, more) + more;
        atomicMax(lists.at.task_groups[0], (all + clumps_per_task - 1u) / clumps_per_task);
        atomicMax(lists.at.raster_groups[0], (all + clumps_per_raster - 1u) / clumps_per_raster);
    }
    barrier();
    if (is_drawn) lists.numbers[list * grass.field.clumps + first[list] + rank] = number;
}

#version 460
// Brings pieces of crowns into the order of their distance, in steps: near crowns are drawn first, and what they hide
// need not be looked for.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/growth/growth.glsl"
#include "shaders/growth/crown_steps.glsl"

layout(local_size_x = 256) in;

const uint per_invocation = sorted_by_group / 256u;
shared uint counts[crown_step_count];  // of this workgroup's pieces
shared uint before[crown_step_count];  // its first place in the list

void main() {
    ListsOfCrowns lists = ListsOfCrowns(GROWTH.lists);
    uint own = gl_LocalInvocationIndex, count = min(lists.at.piece_count, crown_piece_max);
    if (own < crown_step_count) counts[own] = 0u;
    barrier();
    uint pieces[per_invocation], steps[per_invocation], places[per_invocation];
    for (uint i = 0u; i < per_invocation; ++i) {
        uint number = gl_WorkGroupID.x * sorted_by_group + i * gl_WorkGroupSize.x + own;
        if (number >= count) break;
        pieces[i] = lists.at.found[number];
        steps[i] = step_at(lists.at.crowns[pieces[i] >> crown_piece_bits].begins_m);
        places[i] = atomicAdd(counts[steps[i]], 1u);
    }
    barrier();
    if (own < crown_step_count && counts[own] > 0u) {
        uint first = atomicAdd(lists.at.sorted_at[own], counts[own]);
        for (uint step = 0u; step < own; ++step) first += lists.at.pieces_at[step];
        before[own] = first;
    }
    barrier();
    for (uint i = 0u; i < per_invocation; ++i) {
        uint number = gl_WorkGroupID.x * sorted_by_group + i * gl_WorkGroupSize.x + own;
        if (number >= count) break;
        lists.at.pieces[before[steps[i]] + places[i]] = pieces[i];
    }
}

#version 460
// The compute rasteriser's first step: one invocation a meshlet; those worth drawing are listed.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "select.glsl"
#include "verdict.glsl"
#include "lists.glsl"

layout(local_size_x = 64) in;

shared uint kept_here;
shared uint first_here;

void main() {
    uint page_number = first_page + gl_WorkGroupID.y;
    uint meshlet = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    if (gl_LocalInvocationIndex == 0u) kept_here = 0u;
    barrier();
    FramePage page = frame_pages().at[page_number];
    uint verdict = verdict_on(page, PageBlocks(page.block).at[0].meshlets[meshlet]);
    count_verdict(verdict);
    uint place = 0u;
    if (verdict == is_kept) place = atomicAdd(kept_here, 1u);
    barrier();
    if (gl_LocalInvocationIndex == 0u && kept_here > 0u) {
        first_here = atomicAdd(lists().at.meshlets, kept_here);
        uint last = first_here + kept_here;
        atomicMax(lists().at.meshlet_groups[0], min(last, groups_per_row));
        atomicMax(lists().at.meshlet_groups[1], (last + groups_per_row - 1u) / groups_per_row);
    }
    barrier();
    if (verdict == is_kept) Words(FRAME.meshlet_list).at[first_here + place] = page_number * meshlets_per_page + meshlet;
}

#version 460
// The compute rasteriser's first step: one workgroup a page that has something to draw, one invocation a node; those worth drawing
// are listed.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/choose/select.glsl"
#include "shaders/choose/verdict.glsl"
#include "shaders/choose/choose.glsl"
#include "shaders/choose/lists.glsl"

layout(local_size_x = 256) in;

shared uint kept_here;
shared uint first_here;
shared uint edges_here[edges_words];

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint number = folded(gl_WorkGroupID);
    if (number >= Live(FRAME.live_pages).at.count) return;
    uint page_number = Words(FRAME.live).at[FRAME.page_count + number];
    if (lane == 0u) kept_here = 0u;
    if (lane < edges_words) edges_here[lane] = 0u;
    barrier();
    ChosenNode chosen = choose_node(page_number, lane);
    count_verdict(chosen.verdict);
    uint place = 0u;
    if (chosen.verdict == is_kept) {
        place = atomicAdd(kept_here, 1u);
        atomicOr(edges_here[lane / 8u], chosen.edges << (lane % 8u * 4u));
    }
    barrier();
    if (lane == 0u && kept_here > 0u) {
        first_here = atomicAdd(lists().at.meshlets, kept_here);
        uint last = first_here + kept_here;
        atomicMax(lists().at.meshlet_groups[0], min(last, groups_per_row));
        atomicMax(lists().at.meshlet_groups[1], (last + groups_per_row - 1u) / groups_per_row);
    }
    if (lane < edges_words) Words(FRAME.edges).at[page_number * edges_words + lane] = edges_here[lane];
    barrier();
    if (chosen.verdict == is_kept)
        Words(FRAME.meshlet_list).at[first_here + place] = page_number * meshlets_per_page + lane | chosen.edges << 28;
}

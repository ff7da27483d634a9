#version 460
// Second step: one workgroup lists the pages that have something to draw, in the frame's order, so that the same frame is
// rasterised in the same order every time. For the mesh path it lists those of a round, too.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"

layout(local_size_x = 256) in;
layout(constant_id = 1) const uint task_groups_per_page = 8u;
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Live { LivePages at; };

shared uint before[256];

layout(push_constant, scalar) uniform Round { FrameRound round; };

// Of the frame all pages are asked, of a round those that the frame draws.
uint page_at(uint i) { return round.lists_round != 0u ? Words(FRAME.live).at[FRAME.page_count + i] : i; }

void main() {
    uint lane = gl_LocalInvocationIndex;
    bool of_round = round.lists_round != 0u;
    uint asked = of_round ? Live(FRAME.live_pages).at.count : FRAME.page_count;
    Words flags = Words(of_round ? FRAME.round_live : FRAME.live);
    uint each = (asked + 255u) / 256u;
    uint first = min(lane * each, asked), last = min(first + each, asked);
    uint count = 0u;
    for (uint i = first; i < last; ++i) count += flags.at[page_at(i)];
    before[lane] = count;
    barrier();
    for (uint step = 1u; step < 256u; step *= 2u) {
        uint more = lane >= step ? before[lane - step] : 0u;
        barrier();
        before[lane] += more;
        barrier();
    }
    // The list goes behind the flags.
    uint at = FRAME.page_count + before[lane] - count;
    for (uint i = first; i < last; ++i) {
        uint page_number = page_at(i);
        if (flags.at[page_number] != 0u) flags.at[at++] = page_number;
    }
    if (lane != 255u) return;
    uint total = before[255];
    uint rows = (total + groups_per_row - 1u) / groups_per_row;
    Live list = Live(of_round ? FRAME.round_pages : FRAME.live_pages);
    list.at.count = total;
    list.at.task_groups[0] = task_groups_per_page;
    list.at.task_groups[1] = min(total, groups_per_row);
    list.at.task_groups[2] = rows;
    list.at.cull_groups[0] = min(total, groups_per_row);
    list.at.cull_groups[1] = rows;
    list.at.cull_groups[2] = 1u;
    if (of_round) atomicAdd(Counts(FRAME.counts).at.task_groups, total * task_groups_per_page);
    else Counts(FRAME.counts).at.pages_live = total;
}

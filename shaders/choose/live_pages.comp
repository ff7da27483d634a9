#version 460
// Second step: one workgroup lists the pages that have something to draw, in the frame's order, so that the same frame is
// rasterised in the same order every time.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"

layout(local_size_x = 256) in;
layout(constant_id = 1) const uint task_groups_per_page = 8u;
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Live { LivePages at; };

shared uint before[256];

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint each = (FRAME.page_count + 255u) / 256u;
    uint first = lane * each, last = min(first + each, FRAME.page_count);
    Words live = Words(FRAME.live);
    uint count = 0u;
    for (uint i = first; i < last; ++i) count += live.at[i];
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
        if (live.at[i] != 0u) live.at[at++] = i;
    }
    if (lane != 255u) return;
    uint total = before[255];
    uint rows = (total + groups_per_row - 1u) / groups_per_row;
    Live list = Live(FRAME.live_pages);
    list.at.count = total;
    list.at.task_groups[0] = task_groups_per_page;
    list.at.task_groups[1] = min(total, groups_per_row);
    list.at.task_groups[2] = rows;
    list.at.cull_groups[0] = min(total, groups_per_row);
    list.at.cull_groups[1] = rows;
    list.at.cull_groups[2] = 1u;
    Counts(FRAME.counts).at.pages_live = total;
}

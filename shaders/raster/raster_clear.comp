#version 460
// Clears the visibility buffer, and empties the lists of all grids and rounds, of which FrameRound.lists tells the number here. A program
// of its own, not a command of the API: so it runs beside those that choose levels.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/lists.glsl"

layout(local_size_x = 256) in;
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Cleared { uvec2 at[]; };

// One group along y and z even where there are none along x: an indirect dispatch of nothing.
void empty_lists(Lists lists) {
    lists.at.meshlets = lists.at.clips = lists.at.large = lists.at.tasks = lists.at.boxes = 0u;
    for (uint i = 0u; i < 3u; ++i) {
        uint groups = min(i, 1u);
        lists.at.meshlet_groups[i] = lists.at.clip_groups[i] = lists.at.task_groups[i] = lists.at.box_groups[i] = groups;
    }
}

void main() {
    uint group = folded(gl_WorkGroupID), lane = gl_LocalInvocationIndex;
    if (group == 0u) {
        for (uint i = lane; i < round.lists; i += gl_WorkGroupSize.x) empty_lists(lists_at(i));
    }
    uint end = FRAME.width_px * FRAME.height_px, first = group * clear_group_px + lane;
    for (uint i = first; i < min((group + 1u) * clear_group_px, end); i += gl_WorkGroupSize.x) Cleared(FRAME.visibility).at[i] = uvec2(0u);
}

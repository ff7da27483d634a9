// What one invocation draws by itself of the triangles that come to it, and what it hands on to be clipped. Needs lists.glsl.

// Pixels of the largest box that one invocation draws by itself: each waits for the one before. What is larger goes to teams of
// invocations and to other workgroups: near the eye a few meshlets cover most of the picture, and whoever drew them alone would keep all
// others waiting. A processor has nobody to keep waiting, and takes longer to begin with a workgroup.
layout(constant_id = 1) const int alone_max_px = 64;
const int alone_of_many_px = 64;  // ... where teams have much to draw already
const int box_max_px = 1024;      // ... of the largest that a team draws

void list_clip(uint id) {
    uint at = atomicAdd(lists().at.clips, 1u);
    if (at >= clips_room) {
        atomicAdd(Counts(FRAME.counts).at.triangles_not_clipped, 1u);
        return;
    }
    Words(FRAME.clip_list).at[at] = id;
    uint groups = at / 64u + 1u;
    atomicMax(lists().at.clip_groups[0], min(groups, groups_per_row));
    atomicMax(lists().at.clip_groups[1], (groups + groups_per_row - 1u) / groups_per_row);
}

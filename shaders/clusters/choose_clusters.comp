#version 460
// A round of clusters, one invocation for each that the frame's cut may draw: those that the round draws. The first round makes the cut,
// and draws the nearest, and those that the last frame saw; a later one those that the ground drawn so far does not hide. The last asks of all, so that
// the next frame knows which are seen. The same steps as of a page's nodes (cull.comp, cull_second_pass.comp).
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/choose/rounds.glsl"
#include "shaders/place/bend.glsl"
#include "shaders/choose/occlusion.glsl"
#include "shaders/clusters/drawn.glsl"
#include "shaders/clusters/group_rule.glsl"

layout(local_size_x = 64) in;  // clusters_per_choice
layout(constant_id = 2) const bool is_first = true;
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer ClusterBoxes { ClusterBox at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer AskedGroups { AskedGroup at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer SeenBlocks { ClusterBlock at; };

shared uint tested_here;
shared uint hidden_here;
shared uint later_here;
shared uint cut_here;  // 1 + the last cluster of the cut; 0: none

bool is_cluster_hidden(uint number) {
    ClusterBox box = ClusterBoxes(FRAME.cluster_boxes).at[number];
    mat3 half_axes = FRAME.view_from_ecef * box.half_axes;
    float radius_m = sqrt(dot(half_axes[0], half_axes[0]) + dot(half_axes[1], half_axes[1]) + dot(half_axes[2], half_axes[2]));
    // As of a node (is_hidden): floats, placing, and what light bends a box out of the shape that its corners span.
    float slack_m = FRAME.placing_slack_m + 1.0e-2 + 1.0e-6 * (abs(box.centre.x) + abs(box.centre.y) + abs(box.centre.z) + radius_m);
    slack_m += 0.5 * abs(FRAME.refraction_per_m) * radius_m * radius_m;
    BoxOnPicture on_picture;
    return box_on_picture(box.centre, half_axes, slack_m, on_picture) && is_behind(on_picture);
}

bool was_seen(uint number) {
    return FRAME.clusters_before != 0u && SeenBlocks(drawn_cluster(number).block).at.seen == FRAME.clusters_before;
}

bool asked_stands(uint number) { return group_stands(AskedGroups(FRAME.cut.asked).at[number], FRAME.cut.rule); }

bool is_of_cut(uint number) {
    DrawnCluster cluster = drawn_cluster(number);
    return (cluster.made_by == no_asked_group || asked_stands(cluster.made_by)) &&
           (cluster.used_by == no_asked_group || !asked_stands(cluster.used_by));
}

// The cut's clusters come first: coarser ones are as far as the last of them.
bool is_in_turn(uint number) {
    uint count = max(FRAME.cut.in_cut, 1u);
    return is_looked_at(min(number, count - 1u), count);
}

// What the first round makes of a cluster.
uint first_state(uint number) {
    if (!is_of_cut(number)) return 0u;
    if (FRAME.occlusion == 0u) return cluster_kept | cluster_drawn_now;
    bool now = is_in_turn(number) || was_seen(number);
    return now ? cluster_kept | cluster_drawn | cluster_drawn_now : cluster_kept;
}

// ... and a later one.
uint later_state(uint number, uint before) {
    uint state = before & ~cluster_drawn_now;
    bool is_last = round.is_last != 0u, drawn = (before & cluster_drawn) != 0u;
    bool asks = (before & cluster_kept) != 0u && (is_last || (!drawn && is_in_turn(number)));
    if (!asks) return state;
    bool hidden = is_cluster_hidden(number);
    if (is_last) {
        atomicAdd(tested_here, 1u);
        if (hidden && !drawn) atomicAdd(hidden_here, 1u);
        if (!hidden) {
            SeenBlocks(drawn_cluster(number).block).at.seen = FRAME.clusters_turn;
            state |= cluster_shows;
        }
    }
    if (drawn || hidden) return state;
    atomicAdd(later_here, 1u);
    return state | cluster_drawn_now | (is_last ? 0u : cluster_drawn);
}

// Hands those of this workgroup that the round draws to the compute rasteriser.
void list_clusters(uint number, bool now) {
    if (gl_LocalInvocationIndex == 0u) count_here = 0u;
    barrier();
    uint place = now ? atomicAdd(count_here, 1u) : 0u;
    barrier();
    if (gl_LocalInvocationIndex == 0u && count_here > 0u) {
        first_here = atomicAdd(lists().at.meshlets, count_here);
        uint last = first_here + count_here;
        atomicMax(lists().at.meshlet_groups[0], min(last, groups_per_row));
        atomicMax(lists().at.meshlet_groups[1], (last + groups_per_row - 1u) / groups_per_row);
    }
    barrier();
    if (now) Words(FRAME.meshlet_list).at[first_here + place] = number;
}

void main() {
    uint number = gl_GlobalInvocationID.x, lane = gl_LocalInvocationIndex;
    if (lane == 0u) tested_here = hidden_here = later_here = cut_here = 0u;
    barrier();
    bool there = number < FRAME.clusters.count;
    Words states = Words(FRAME.cluster_states);
    uint state = 0u;
    if (there) {
        state = is_first ? first_state(number) : later_state(number, states.at[number]);
        states.at[number] = state;
        if (is_first && (state & cluster_kept) != 0u) atomicMax(cut_here, number + 1u);
    }
    if (for_compute) list_clusters(number, (state & cluster_drawn_now) != 0u);
    barrier();
    if (lane != 0u) return;
    if (is_first && cut_here > 0u) {
        Words groups = Words(FRAME.cut.groups);
        atomicMax(groups.at[0], min(cut_here, groups_per_row));
        atomicMax(groups.at[1], (cut_here + groups_per_row - 1u) / groups_per_row);
    }
    if (is_first) return;
    Counts counts = Counts(FRAME.counts);
    if (tested_here > 0u) atomicAdd(counts.at.meshlets_tested, tested_here);
    if (hidden_here > 0u) atomicAdd(counts.at.meshlets_hidden, hidden_here);
    if (later_here > 0u) atomicAdd(counts.at.meshlets_drawn_later, later_here);
}

#version 460
// Third step of a choice of pages, one workgroup, level by level from the coarsest: a wanted page takes part in the frame when it and
// all above it are here, and no page of the level above beside it is missing.
#extension GL_GOOGLE_include_directive : require
#include "shaders/plan/choice.glsl"

layout(local_size_x = 256) in;

bool is_open(uint page) {
    uint slot = Words(Terms(terms).at.slots).at[page];
    return slot == no_page || wanted_pages().at[slot].open != 0u;
}

void open(uint slot, uint page) {
    bool opens = wanted_pages().at[slot].block != uvec2(0u);
    uint above = records().at[page].parent;
    if (above != no_page) {
        uint slot_above = Words(Terms(terms).at.slots).at[above];
        // Of more pages than there is room for some have no slot.
        if (slot_above == no_page) return;
        opens = opens && wanted_pages().at[slot_above].open != 0u;
        for (uint i = 0u; i < 4u && opens; ++i) {
            uint beside = records().at[page].beside[i];
            opens = beside == no_page || is_open(beside);
        }
        uint quarter = quarter_of(page);
        if (!opens)
            atomicOr(wanted_pages().at[slot_above].fallback_quarters,
                     1u << quarter | 1u << (stands_for_missing + quarter));
    }
    wanted_pages().at[slot].open = opens ? 1u : 0u;
    if (opens) atomicAdd(counts().at.open, 1u);
}

// Writes the number of pages to where those who draw them read it.
void publish_count(uint pages) {
    counts().at.open = pages;
    counts().at.groups[0] = pages;
    counts().at.groups[1] = 1u;
    counts().at.groups[2] = 1u;
    if (Terms(terms).at.frame_counts == uvec2(0u)) return;
    Words frame = Words(Terms(terms).at.frame_counts), before = Words(Terms(terms).at.frame_counts_before);
    frame.at[0] = pages;
    frame.at[1] = Terms(terms).at.frame_counts_before == uvec2(0u) ? 0u : before.at[0] + before.at[1];
    Words(Terms(terms).at.plan_count).at[0] = pages;
}

void main() {
    uint lane = gl_LocalInvocationIndex, count = wanted_count();
    // With none missing all are open, in any order.
    bool any_missing = counts().at.missing > 0u;
    for (uint step = any_missing ? Terms(terms).at.level_count : 1u; step-- > 0u;) {
        for (uint slot = lane; slot < count; slot += 256u) {
            uint page = wanted_pages().at[slot].page;
            if (!any_missing) wanted_pages().at[slot].open = 1u;
            else if (level_of(page) == step) open(slot, page);
        }
        memoryBarrierBuffer();
        barrier();
    }
    if (lane == 0u) publish_count(any_missing ? atomicAdd(counts().at.open, 0u) : count);
}

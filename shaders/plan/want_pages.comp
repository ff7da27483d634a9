#version 460
// Second step of a choice of pages: a page is wanted where it is seen, and all above it are, each in a quarter that needs finer pages.
#extension GL_GOOGLE_include_directive : require
#include "shaders/plan/choice.glsl"

layout(local_size_x = 64) in;

uint rating_of(uint page) { return Words(Terms(terms).at.ratings).at[page]; }

bool is_asked_for(uint page) {
    while (true) {
        uint above = records().at[page].parent;
        if (above == no_page) return true;
        uint rating = rating_of(above);
        if ((rating & rated_seen) == 0u || (rating >> (rated_refined + quarter_of(page)) & 1u) == 0u) return false;
        page = above;
    }
}

void want(uint page) {
    uint slot = atomicAdd(counts().at.wanted, 1u);
    if (slot >= Terms(terms).at.capacity) return;
    dvec3 centre_m = seen(records().at[page].centre_ecef[0], records().at[page].centre_ecef[1], records().at[page].centre_ecef[2]);
    double reach_m = records().at[page].reach_m, distance_m = length_of(centre_m);
    if (Terms(terms).at.gap_reach > 0.0lf) reach_m = grown(reach_m, distance_m, Terms(terms).at.gap_reach);
    uvec2 block = Blocks(Terms(terms).at.blocks).at[page];
    wanted_pages().at[slot].distance_m = max(0.0lf, difference(distance_m, reach_m));
    wanted_pages().at[slot].block = block;
    wanted_pages().at[slot].page = page;
    wanted_pages().at[slot].number = no_page;
    wanted_pages().at[slot].open = 0u;
    wanted_pages().at[slot].fallback_quarters = rating_of(page) >> rated_enough & 15u;
    Words(Terms(terms).at.slots).at[page] = slot;
    if (block == uvec2(0u)) atomicAdd(counts().at.missing, 1u);
}

void main() {
    uint page = gl_GlobalInvocationID.x;
    if (page >= Terms(terms).at.page_count) return;
    uint rating = rating_of(page);
    if (rating == 0u || !is_asked_for(page)) return;
    if ((rating & rated_beyond_frustum) != 0u) atomicAdd(counts().at.beyond_frustum, 1u);
    else if ((rating & rated_beyond_horizon) != 0u) atomicAdd(counts().at.beyond_horizon, 1u);
    else want(page);
}

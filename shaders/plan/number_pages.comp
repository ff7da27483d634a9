#version 460
// Fourth step of a choice of pages: pages of the frame are numbered from the nearest on, those that are as far by their own numbers.
#extension GL_GOOGLE_include_directive : require
#include "shaders/plan/choice.glsl"

layout(local_size_x = 64) in;

shared double distances_m[64];
shared uint pages[64];

void main() {
    uint lane = gl_LocalInvocationIndex, count = wanted_count(), own = gl_GlobalInvocationID.x;
    if (gl_WorkGroupID.x * 64u >= count) return;
    double own_m = own < count ? wanted_pages().at[own].distance_m : 0.0lf;
    uint own_page = own < count ? wanted_pages().at[own].page : no_page, number = 0u;
    for (uint first = 0u; first < count; first += 64u) {
        barrier();
        uint slot = first + lane;
        bool takes_part = slot < count && wanted_pages().at[slot].open != 0u;
        pages[lane] = takes_part ? wanted_pages().at[slot].page : no_page;
        distances_m[lane] = takes_part ? wanted_pages().at[slot].distance_m : 0.0lf;
        barrier();
        for (uint i = 0u; i < 64u; ++i) {
            double distance_m = distances_m[i];
            bool nearer = distance_m < own_m || (distance_m == own_m && pages[i] < own_page);
            if (pages[i] != no_page && nearer) ++number;
        }
    }
    if (own < count && wanted_pages().at[own].open != 0u) wanted_pages().at[own].number = number;
}

// What the programs that choose pages have in common (core/frame/frame_plan.cpp, PageChoice, is what they do). Needs exact.glsl.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "shaders/shared.h"
#include "shaders/plan/shared_choice.h"
#include "shaders/plan/exact.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Terms { ChoiceTerms at; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Records { ChoicePage at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Blocks { uvec2 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Changes { BlockChange at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) coherent buffer WantedPages { WantedPage at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counts { ChoiceCounts at; };
layout(push_constant, scalar) uniform Grid { uvec2 terms; };

Records records() { return Records(Terms(terms).at.records); }
Counts counts() { return Counts(Terms(terms).at.counts); }
WantedPages wanted_pages() { return WantedPages(Terms(terms).at.wanted); }
// How many pages are wanted, of those that there is room for.
uint wanted_count() { return min(counts().at.wanted, Terms(terms).at.capacity); }

uint level_of(uint page) { return records().at[page].traits & 255u; }
// Of the page above it that a page lies in.
uint quarter_of(uint page) { return records().at[page].row % 2u * 2u + records().at[page].column % 2u; }

// A place in ECEF from the eye, in view coordinates.
dvec3 seen(double x, double y, double z) {
    dvec3 from_eye = difference(dvec3(x, y, z), dvec3(Terms(terms).at.eye_ecef[0], Terms(terms).at.eye_ecef[1], Terms(terms).at.eye_ecef[2]));
    dvec3 by[3];
    for (int i = 0; i < 3; ++i)
        by[i] = dvec3(Terms(terms).at.view_from_ecef[3 * i], Terms(terms).at.view_from_ecef[3 * i + 1], Terms(terms).at.view_from_ecef[3 * i + 2]);
    return turned(by[0], by[1], by[2], from_eye);
}

double neighbour(double x, bool above) {
    uvec2 words = unpackDouble2x32(x);
    if (above) {
        words.x += 1u;
        if (words.x == 0u) words.y += 1u;
    } else {
        if (words.x == 0u) words.y -= 1u;
        words.x -= 1u;
    }
    return packDouble2x32(words);
}

// The double that is nearest to the root: that of the device may be the one beside it. The rest of x beyond root^2 is exact.
double exact_root(double x) {
    if (!(x > 0.0lf)) return 0.0lf;
    double root = sqrt(x);
    for (int i = 0; i < 3; ++i) {
        dvec2 square = product_of(root, root);
        double rest = difference(difference(x, square.x), square.y);
        double above = neighbour(root, true), below = neighbour(root, false);
        if (rest > product(root, difference(above, root))) root = above;
        else if (rest <= -product(root, difference(root, below))) root = below;
        else break;
    }
    return root;
}
double length_of(dvec3 a) { return exact_root(along(a, a)); }

// A sphere that reaches out by a share of the distance to its far side.
double grown(double reach_m, double distance_m, double share) {
    precise double all = reach_m + share * (distance_m + reach_m);
    return all;
}

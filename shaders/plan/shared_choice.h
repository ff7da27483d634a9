// What a device chooses the pages of a frame from, and what it makes of them. Compiled as C++ and as GLSL;
// not a part of shared.h, for only the programs of shaders/plan need it, and doubles.
#ifndef OROGRAPH_SHADERS_PLAN_SHARED_CHOICE_H
#define OROGRAPH_SHADERS_PLAN_SHARED_CHOICE_H

#ifdef __cplusplus
#include "shaders/shared.h"
namespace oro::gpu {
#endif

// The nodes of a quarter of a page (core/lod/pyramid.h, PageQuarter).
struct ChoiceQuarter {
    double centre_ecef[3];
    double lod_radius_m;  // negative: none of them has a triangle
};

// What the choice of pages needs to know of one, whatever the eye. Pages are numbered from the finest level
// on, row by row.
struct ChoicePage {
    double centre_ecef[3];  // of what it and all below it lie in: a sphere,
    double reach_m;         // ... negative for none,
    double horizon[3];      // ... and a cone
    double horizon_angle_rad;
    ChoiceQuarter quarters[4];
    float errors_m[4];  // the largest of each quarter
    uint row;           // among the pages of its level
    uint column;
    uint row_source;  // number of its row of pages, and of its column of pages, among those of all levels
    uint column_source;
    uint traits;     // choice_...
    uint parent;     // numbers of pages; no_page: there is none
    uint beside[4];  // of the level above: what holds the ground beyond the north, east, south and west rim
    uint children[4];
};
// Bits of ChoicePage.traits: the level in the lowest eight, then
ORO_CONST uint choice_unit_cone = 256u;  // the cone's direction has length 1 but for rounding
ORO_CONST uint choice_skirt = 512u;      // is_skirt

// One grid of a frame: what depends on the eye, and where all lies.
struct ChoiceTerms {
    double view_from_ecef[9];  // column by column
    double eye_ecef[3];
    double planes[20];  // of the frustum in view coordinates: x, y, z and w of five
    double horizon[3];  // direction of the eye
    double horizon_angle_rad;
    double gap_reach;  // of a metre of distance: by how much a sphere grows (seams)
    double corner_stretch;
    double shading_spacing_px;
    double spacing_px_m[32];  // of each level: of two posts beside each other, times pixels_per_tangent
    float pixels_per_tangent;
    float corner_tangent;
    float tau_px;
    uint cull;        // FramePage.cull of all pages, but for is_skirt
    uint page_count;  // of the region
    uint level_count;
    uint capacity;  // most pages that may be wanted
    uint change_count;
    uint row_source_count;  // rows of pages and columns of pages of all levels
    uint column_source_count;
    uvec2 means_before;  // how far before a block its means lie, bytes; 0: there are none
    uvec2 records;       // ChoicePage[page_count]
    uvec2 blocks;        // uvec2[page_count]: device addresses of blocks of pages; 0: not here
    uvec2 changes;       // BlockChange[change_count]
    uvec2 ratings;       // uint[page_count]
    uvec2 slots;         // uint[page_count]: the number of a page among the wanted ones; no_page
    uvec2 counts;        // ChoiceCounts
    uvec2 wanted;        // WantedPage[capacity]
    uvec2 pages;         // the frame's FramePages, capacity of them
    uvec2 numbers;       // of PlanTerms: rows and columns of pages that the frame needs, then its pages
    // Where the numbers of the frame's pages go, 0: nowhere: FrameConstants.page_count, and first_page after
    // it, which is what these two of the grid before add up to (0: it is the first); PlanTerms.page_count.
    uvec2 frame_counts;
    uvec2 frame_counts_before;
    uvec2 plan_count;
    // Of frames in rounds: FrameConstants.page_before, from uint[page_count]: numbers of pages in the last
    // such frame; 0: nobody knows. And these of this frame; 0: it is none in rounds.
    uvec2 page_before;
    uvec2 numbers_before;
    uvec2 numbers_now;
};

// A page that has come, or gone.
struct BlockChange {
    uint page;
    uint unused;
    uvec2 block;
};

// What is known of a page in ChoiceTerms.ratings: 0 where it is never seen;
ORO_CONST uint rated_seen = 1u;
ORO_CONST uint rated_beyond_frustum = 2u;
ORO_CONST uint rated_beyond_horizon = 4u;
// ... of each quarter that has a finer page: it is good enough; it needs the finer page. Four bits each.
ORO_CONST uint rated_enough = 4u;
ORO_CONST uint rated_refined = 8u;

// A page that the frame wants.
struct WantedPage {
    double distance_m;  // of its nearest place
    uvec2 block;        // 0: it is missing
    uint page;
    uint number;  // in the frame; no_page: it takes no part in it
    uint open;    // 1: it takes part
    uint fallback_quarters;
};

struct ChoiceCounts {
    uint wanted;  // more than the capacity: the frame is not whole
    uint open;    // pages of the frame
    uint missing;
    uint beyond_frustum;
    uint beyond_horizon;
    uint undecided;  // answers of the horizon that are closer than rounding
    uint groups[3];  // of an indirect dispatch: one a page of the frame
    uint unused;
};
ORO_CONST uint choice_group = 64u;

#ifdef __cplusplus
static_assert(sizeof(ChoicePage) == 264 && sizeof(WantedPage) == 32);
}  // namespace oro::gpu
#endif

#endif

// Part of shared.h, which includes it: what casts shadows. Not for anybody else.
#ifndef OROGRAPH_SHADERS_SHARED_CASTERS_H
#define OROGRAPH_SHADERS_SHARED_CASTERS_H

// What casts shadows into a frame: pages of all levels, those that are drawn and others, behind the eye, too.
// Of each level the pages within a rectangle (rows and columns of pages) may be there.
struct CasterLevel {
    uint first_row;
    uint first_column;
    uint rows;
    uint columns;
    uint first;  // of its entries in the table: numbers of pages, row by row; no_page where there is none
};
struct CasterPage {
    uvec2 block;  // device address of its PageBlock
    uint level;
    uint row;
    uint column;
};
ORO_CONST uint open_corners = 17u;       // along a page's side
ORO_CONST uint open_groups_a_page = 5u;  // workgroups of 64
struct Casters {
    CasterLevel levels[31];
    uint level_count;
    float row_rad;  // from one post of level 0 to the next
    float column_rad;
    uint page_count;
    float top_m;        // nothing is higher above the ellipsoid, as drawn
    float error_per_m;  // casters may be off by so much for each metre from the eye to what they shade, times
                        // the slope of the light there: its rise on a level metre, 0.02 to 1
    uvec2 pages;        // CasterPage
    uvec2 table;        // uint
    uvec2 nodes;        // CasterNode, 256 a page
    uvec2 openness;  // float[open_corners^2] for each page of the frame: the share of the sky that its nodes'
                     // corners see
    uvec2 sun_shares;  // float for each pixel, row by row: what it sees of the sun (casters.glsl, share_step)
};
ORO_CONST float no_node_m = 1.0e30f;
ORO_CONST uint node_has_finer = 1u;  // the page of the next finer level is there
ORO_CONST uint node_is_gentle = 2u;  // no triangle rises towards the sun as fast as its light does
ORO_CONST uint node_has_voids = 4u;
// A node of such a page.
struct CasterNode {
    float top_m;          // nothing that it stands for is higher
    float error_m;        // of the pyramid
    float above_top_m;    // the same of the node of the next coarser level that holds it;
    float above_error_m;  // ... no_node_m where that is not there
    uint flags;           // node_has_finer, node_is_gentle, node_has_voids
    uvec2 block;          // device address of its page's PageBlock
};

#endif

// Part of shared.h, which includes it: the rounds of a frame, and what is counted. Not for anybody else.
#ifndef OROGRAPH_SHADERS_SHARED_ROUNDS_H
#define OROGRAPH_SHADERS_SHARED_ROUNDS_H

struct FrameCounts {
    uint pages_live;    // with a node of the right level
    uint nodes_chosen;  // of the right level; those that are hidden included
    uint meshlets_beyond_frustum;
    uint meshlets_beyond_horizon;
    uint meshlets_drawn;
    uint triangles_drawn;
    uint mesh_groups;            // mesh path: workgroups of mesh shaders
    uint triangles_not_clipped;  // compute path: no room in the list; the frame has holes
    uint task_groups;            // mesh path: workgroups of task shaders
    uint meshlets_tested;        // whether other ground hides them, by the last round
    uint meshlets_hidden;        // ... those that it hides, and that no round has drawn
    uint meshlets_drawn_later;   // by another round than the first
    uint triangles_left_out;     // mesh path: that cover no pixel's centre
    uint halves_left_out;        // mesh path by halves: of meshlets that are drawn, those without a triangle
};

// A frame is drawn in rounds; each leaves out what the ground of those before it hides. What a program is
// told of its round.
struct FrameRound {
    uint first_share;  // of the pages that have something to draw, in 256ths of their number, nearest first:
                       // these
    uint last_share;   // ... are looked at; from the first round all that was seen in the last frame, too
    uint is_last;      // 1: all pages are looked at
    uint nearest;      // 1: the pyramid is of the nearest depths, which is wrong (tests only)
    uint lists_round;  // 1: live_pages lists the pages that the round draws, not all
    uint lists;        // number of the RasterLists of a grid's round (compute path)
    uint backwards;    // 1: last page, meshlet and triangle first (mesh path)
};
ORO_CONST uint round_shares = 256u;
// What a picture of a frame's own parts shows (shade/show.comp).
ORO_CONST uint show_colours = 0u;  // none of them
ORO_CONST uint show_visible = 1u;  // whether the last round has drawn a pixel's meshlet, or one before
ORO_CONST uint show_levels = 2u;
ORO_CONST uint show_meshlets = 3u;
ORO_CONST uint show_triangles = 4u;
ORO_CONST uint show_clusters = 5u;  // by their numbers in the graph, so that they keep their colours
ORO_CONST uint show_groups = 6u;    // of clusters
ORO_CONST uint show_overdraw = 7u;  // how many triangles were rasterised in a pixel
// The pyramid of the farthest depths: a level has a value for each square of 4, 8, 16, 32 and 64 pixels, row
// by row, and the levels follow each other.
ORO_CONST uint pyramid_finest = 2u;  // 2^2 = 4 pixels
ORO_CONST uint pyramid_coarsest = 6u;

#endif

// What the CPU and the GPU both know: sizes, and the structs that lie in GPU memory. The only place where
// either is defined; compiled as C++ and as GLSL (scalar block layout, so the two agree;
// tests/render/shared_layout_test.cpp proves it).
#ifndef OROGRAPH_SHADERS_SHARED_H
#define OROGRAPH_SHADERS_SHARED_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace oro::gpu {
using glm::mat3;
using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#define ORO_CONST inline constexpr
#else
#define ORO_CONST const
#endif

// A page is 128 x 128 quads of one level of the region's post grid; a meshlet is 8 x 8 of them.
ORO_CONST uint page_quads = 128u;
ORO_CONST uint page_posts = 129u;  // along a side; the last row and column are the next page's first
ORO_CONST uint meshlet_quads = 8u;
ORO_CONST uint meshlet_posts = 9u;
ORO_CONST uint meshlets_per_side = 16u;
ORO_CONST uint meshlets_per_page = 256u;
ORO_CONST uint parts_per_task_max = 128u;  // meshlets, or halves of them, of a task workgroup
ORO_CONST uint meshlet_vertices = 81u;
ORO_CONST uint meshlet_triangles = 128u;
ORO_CONST uint page_diagonal_words = 512u;  // a bit for each quad
// Heights are kept with one more post on each side, so that slopes are continuous across pages.
ORO_CONST uint height_stride = 131u;
ORO_CONST uint page_heights = 17161u;  // height_stride squared
// Heights are kept in whole steps of 2^-11 m above the ellipsoid (core/terrain/drawn_heights.h), so that
// every page and level holds the same number for a post.
ORO_CONST float height_step_m = 1.0f / 2048.0f;
ORO_CONST int void_height = -2147483647 - 1;
ORO_CONST int void_code = -32768;  // of heights in 16 bits

#include "shaders/shared_halves.h"

// Exact placement of posts relative to the eye, in the eye's meridian frame: x outward in the equatorial
// plane at the eye's longitude, y east, z north along the axis. Each frame has tables for its pages' rows and
// columns, computed in double and rounded once, that depend on the post's angle and the eye alone: a post
// gets the same bits from every page and level. With N_e the prime-vertical radius, ha the frame's height of
// reference (FrameConstants.reference_steps), rho_eye and z_eye the eye's cylinder coordinates, and dlon from
// the eye's longitude, as they are on the ellipsoid. On the sphere N_e is its radius and e2 is 0. On the
// plane that touches the ellipsoid at the eye (its normal N_e and M_e, n = M_e dlat): R = cos(eye) (ha -
// h_eye) - sin(eye) n, C = cos(eye), S = sin(eye), P = N_e cos(eye), Z = sin(eye) (ha - h_eye) + cos(eye) n,
// Q = 0, V = 0, W = dlon in radians.
struct RowTerms {
    float R;       // (N_e + ha) cos(lat) - rho_eye
    float C;       // cos(lat)
    float S;       // sin(lat)
    float P;       // (N_e + ha) cos(lat)
    float Z;       // (N_e (1 - e2) + ha) sin(lat) - z_eye
    float Q;       // what a metre of height adds to P: cos(lat)
    float cosine;  // of the latitude, on every Earth
};
struct ColumnTerms {
    float V;  // 2 sin^2(dlon / 2)
    float W;  // sin(dlon)
};
// What a meshlet's posts lie in: a sphere in the page frame, and a cone around a direction in scaled space
// (unit sphere = occluding ellipsoid): when the eye's direction is farther from `horizon_direction` than the
// eye's own horizon angle plus horizon_angle_rad, no post of the meshlet can be seen. The direction is kept
// as its offset from the page's. As a node of the pyramid (core/lod/pyramid.h): how far its triangles are
// from the full resolution, and a sphere around `centre` that holds all they stand for; both at least those
// of the nodes below it and of those around these.
struct MeshletBounds {
    vec3 centre;
    float radius;  // negative: the meshlet has no triangle
    vec3 horizon_offset;
    float horizon_angle_rad;
    float error_m;  // unfit_error_m (levels.glsl): cannot stand for anything
    float lod_radius;
};
// Means of a page's ground over squares of posts (core/lod/ground_means.h): those of level k have 2^k x 2^k
// posts, (i, j) begins at post (i 2^k, j 2^k) of the page. Four more squares on each side, so that pixels
// average across pages.
ORO_CONST uint means_apron = 4u;
ORO_CONST uint means_stride = 136u;
ORO_CONST float means_normal_steps = 1023.0f;
struct MeansSquare {
    uint normal;  // mean unit normal in steps: east 11 bits, north 11, up 10; 0 without a post
    uint height;  // halves: mean height above the ellipsoid without exaggeration, and its spread
    uint spread;  // of the normals' east and north: standard deviations, 11 bits each of 0 to 1, and their
                  // correlation, 10 bits of -1 to 1
};
struct PageMeans {
    MeansSquare squares[18496];
};
ORO_CONST float means_spread_steps = 2047.0f;
ORO_CONST float means_correlation_steps = 511.0f;
// One page as the GPU holds it.
struct PageBlock {
    MeshletBounds meshlets[256];
    // Metres from one of the region's posts (of level 0) to the next: along the meridian; along the parallel,
    // to be multiplied by the cosine of the latitude. At the page's middle.
    float row_spacing_m;
    float column_spacing_m;
    // By how much rows are turned from east, towards north, radians: at the page's first post, and what the
    // next row and the next column add. In a grid with a CRS of its own (FrameConstants.has_net); there
    // column_spacing_m needs no cosine of a latitude.
    vec3 turn;
    vec2 up;  // the ellipsoid's normal at the page's origin, in the page frame: along x, along z
    // Of each meshlet: how far its posts are from the centre of its sphere, along east, north and that
    // normal, in 1023rds of its radius, 10 bits each; then which of its halves have triangles (both_halves
    // and so on): a half that is told to have none has none, whatever its edges are.
    uint boxes[256];
    // A bit for each quad: 1 where it is split from its south-west to its north-east post, 0 where from its
    // north-west to its south-east (core/terrain/cell_diagonal.h). Two words a meshlet, row by row, the first
    // the lowest bit.
    uint sw_ne[512];
    // Drawn heights row by row from post (-1, -1), in steps; void_height where there is none. With
    // FrameConstants.height_bits 16 two codes a word, the first in the low bits, and so half as many words
    // (core/frame/height_quantization.h). Packed ones lie as shared_heights.h says.
    int heights[17161];
};

// Where a page's 129 x 129 posts are, on a net: steps of height_step_m along x, y and z of ECEF, from the
// lattice point of the page's origin. In a page that reaches far (places_from_plane) they begin at a post's
// place on a plane: middle + (row - middle_row) row_step + (column - middle_column) column_step.
struct PagePlaces {
    int steps[49923];
    int row_step[3];
    int column_step[3];
    int middle[3];
    int middle_row;
    int middle_column;
};

// A page of this frame: one that is drawn, or one above such a page. Its number in the frame's list is in the
// triangle ids.
struct FramePage {
    mat3 view_from_page;     // rotation
    vec3 origin_view;        // the page's origin in view coordinates, metres
    vec4 planes[5];          // the frustum in the page frame, n.p + d >= 0 inside; left right bottom top near
    vec3 horizon_direction;  // scaled direction of the eye minus that of the page
    uvec2 block;             // device address of its PageBlock
    uvec2 means;             // of its PageMeans; 0 where there are none
    // On a net: of its PagePlaces, and from the eye's lattice point to its origin's, 64 bits along each axis
    // (core/terrain/page_on_net.h).
    uvec2 places;
    uvec3 from_eye_low;
    uvec3 from_eye_high;
    uint cull;  // bits: 1 the frustum, 2 the horizon may hide some meshlets of it; 4 none of its
                // nodes may stand for finer ones; 8 is_skirt; 16 places_from_plane;
                // 32 cull_by_occlusion
    uint level;
    uint first_row;  // number in the region of the page's first post
    uint first_column;
    uint row_terms;  // place of its 129 rows in the frame's table
    uint column_terms;
    uint quarter;    // of its parent page that it lies in: 2 south + east
    uint parent;     // number of that page in this frame; no_page when there is none
    uint neighbours[4];  // pages of the parent's level that hold the parents of the nodes beyond the north, east,
                     // south and west rim
    uint children[4];  // pages of the next finer level: north-west, north-east, south-west, south-east
    uint last_column;  // last node of a row, 15 or less where a region goes round the Earth
    uint west_column;  // parent of the node beyond the west rim: its column in that page
    // Bits of the quarters whose nodes are drawn whatever their error: nothing finer is there. Four bits up
    // those of them where something finer is needed.
    uint fallback_quarters;
};
ORO_CONST uint stands_for_missing = 4u;  // the first of these bits
// Slopes are shaded from the coarsest page whose posts are at most so many pixels apart, whatever level the
// triangles are of.
ORO_CONST float shading_spacing_px = 1.5f;
// The same where a pixel's colour is the mean of the ground that it covers; and where slopes have colours.
ORO_CONST float means_spacing_px = 0.375f, slope_means_px = 0.17f;
// FrameStyle.footprint: what a pixel's colour is made of.
ORO_CONST uint footprint_point = 0u;   // the ground in its middle, as shading_spacing_px says
ORO_CONST uint footprint_mean = 1u;    // the mean of all that it covers
ORO_CONST uint footprint_finest = 2u;  // the ground in its middle, from the finest posts: to measure with
ORO_CONST uint no_page = 0xffffffffu;
ORO_CONST uint no_column = 0xffffffffu;
ORO_CONST uint pages_max = 131071u;  // of a frame, all its grids together: what triangle ids can number
ORO_CONST uint accepted_words = 8u;  // a page: a bit for each node
ORO_CONST uint feedback_words = 24u;    // a page: FrameConstants.feedback
ORO_CONST uint edges_words = 32u;    // a page: four bits for each node
ORO_CONST uint cull_by_frustum = 1u;
ORO_CONST uint cull_by_horizon = 2u;
ORO_CONST uint never_coarsen = 4u;
ORO_CONST uint is_skirt =
    8u;  // a page of a seam (core/seam) whose quads reach out by pixels, at least so many
ORO_CONST uint places_from_plane = 16u;  // see PagePlaces
ORO_CONST uint cull_by_occlusion =
    32u;  // its nodes are left out where other ground hides them (choose/occlusion.glsl)
ORO_CONST float least_gap_px = 0.05f;
ORO_CONST uint contents_posts = 0u;   // of a grid's pages: posts of its own
ORO_CONST uint contents_seam = 1u;    // ... what lies between grids (place/seam.glsl)
ORO_CONST uint contents_meshes = 2u;  // ... triangles of meshes (shared_mesh_pages.h)
ORO_CONST uint seam_stride = 3u;         // posts of a seam's page from a quad to the next
ORO_CONST float seam_unit = 1048576.0f;  // a unit vector's length in the places of its pages

ORO_CONST uint groups_per_row = 32768u;  // of an indirect dispatch; below every device's limit

#include "shaders/shared_rounds.h"

// The pages that have something to draw, in the frame's order, and how many workgroups go through them.
struct LivePages {
    uint count;
    uint task_groups[3];  // of an indirect draw: groups of a page, then pages folded into rows
    uint cull_groups[3];  // of an indirect dispatch: pages folded into rows
};

// What the compute rasteriser passes from one of its steps to the next. Group counts are those of an indirect
// dispatch.
struct RasterLists {
    uint meshlets;  // meshlets to draw
    uint meshlet_groups[3];
    uint clips;  // triangles that cross the near plane or leave the range of integer coordinates
    uint clip_groups[3];
    uint large;  // triangles that many workgroups share
    uint tasks;  // squares of pixels of those
    uint task_groups[3];
    uint boxes;  // triangles that some invocations of one workgroup share
    uint box_groups[3];
};
ORO_CONST uint raster_lists_bytes = 80u;  // from one to the next
// A triangle on the pixel grid, 1/256 px, with reversed depths; positive area.
struct LargeTriangle {
    int ax, ay, bx, by, cx, cy;
    float az, bz, cz;
    uint id;
};
struct LargeTask {
    uint triangle;
    uint square;  // x in the low 16 bits, y in the high ones, in units of large_square_px
};
ORO_CONST uint no_triangle = 0xffffffffu;  // a task whose triangle found no room and was drawn at once
ORO_CONST uint large_square_px = 32u;
ORO_CONST uint clips_max = 4194304u;
ORO_CONST uint large_max = 262144u;
ORO_CONST uint boxes_max = 262144u;  // in the same list, behind large_max
ORO_CONST uint boxes_per_group = 4u;
ORO_CONST uint clear_group_px = 1024u;  // pixels that a workgroup clears
ORO_CONST uint tasks_max = 1048576u;

#include "shaders/shared_style.h"

#include "shaders/shared_casters.h"

// The geoid's undulation N at nodes of its own, bilinear between them; the nearest beyond them.
struct UndulationTable {
    uvec2 N_m;  // device address of float[rows * columns]; 0 where N is 0 everywhere
    uint rows;
    uint columns;
    vec2 first;     // of the region's first post: (row, column) among the nodes
    vec2 per_post;  // nodes from one of the region's posts to the next
};

// As core/earth/world_model.h, Precision.
ORO_CONST uint placing_relative = 0u;
ORO_CONST uint placing_rounded_posts = 1u;
ORO_CONST uint placing_naive = 2u;

// What a pixel shows: the posts of its triangle by their numbers in the region, and where they were placed.
// For measuring: no picture needs it.
struct DrawnTriangle {
    vec3 at[3];    // view coordinates, as they are drawn
    uint rows[3];  // no_triangle: the background
    uint columns[3];
    float h_m[3];  // above the ellipsoid, as they are drawn
};

// Where the eye stands over the region's grid of posts: from a place in view coordinates to the post below it
// (shaders/shade/outside.glsl).
struct EyePost {
    vec2 post;       // (row, column), fractional; of the region, or beyond it
    vec2 per_rad;    // rows a radian southwards, columns a radian eastwards
    vec2 post_m;     // metres from post to post in the region's middle, along a meridian and along a parallel
    vec2 latitude;   // cosine and sine
    float normal_m;  // radius of curvature across the meridian,
    float meridian_m;  // ... and along it
    float e2;          // of the Earth as it is drawn
    float turn;        // columns once round the Earth
};
#include "shaders/shared_drape.h"

// From places to posts of a grid on a net (core/net/lattice_georeference.h, LatticeGeoreference::Inverse): row and column as a
// polynomial of (u, v), the ellipsoid's normal along two axes.
struct NetMap {
    vec3 along_u;  // in the eye's meridian frame
    vec3 along_v;
    vec2 middle;
    vec2 scale;     // (dot products - middle) * scale is in -1 .. 1
    vec2 beyond_u;  // rows and columns a step outwards, beyond the grid
    vec2 beyond_v;
    vec2 turn;              // of rows in the grid's middle, from east towards north: cosine, sine
    vec2 coefficients[28];  // of u^i v^j: i from 0, and of each j from 0 to 6 - i
};

#include "shaders/shared_clusters.h"
#include "shaders/shared_mesh_looks.h"

struct FrameConstants {
    mat3 view_from_eye;     // rotation, from the eye's meridian frame
    int reference_steps;    // height that the row terms are for, a whole number of metres
    vec2 projection_scale;  // see core/earth/camera.h, Projection
    vec2 projection_shift;
    float near_m;
    float horizon_angle_rad;  // of the eye: acos(1 / distance in scaled space); pi when the eye is below the
                              // occluder
    float horizon_stretch;    // for the angles of what is seen: 1, more where light bends
    float refraction_per_m;   // curvature of sight lines; 0: they are straight
    uint placing;             // placing_... : how posts are placed
    mat3 view_from_ecef;      // for the other two than placing_relative: rotation,
    vec3 view_translation;    // ... minus the eye's ECEF turned by it,
    vec3 eye_high;            // ... the eye's ECEF as float32
    vec3 eye_low;             // ... and the rest,
    vec2 eye_meridian;        // ... cosine and sine of its longitude
    uint height_bits;         // 32, 16 or height_bits_packed, see PageBlock
    uint height_shift;        // of 16: steps = code << shift + offset
    int height_offset;
    uint has_net;        // 1: posts are where PagePlaces has them, not where row and column terms say
    vec3 eye_remainder;  // then: the eye from its lattice point, metres, ECEF
    vec3 up_view;        // the ellipsoid's normal at the eye, in view coordinates
    float eye_h_m;
    float earth_radius_m;  // Gaussian radius of curvature at the eye
    uint width_px;
    uint height_px;
    uint first_x_px;  // where they begin in the whole picture
    uint first_y_px;
    float pixels_per_tangent;  // for the choice of levels, see core/lod/levels.h
    float corner_tangent;
    float tau_px;
    float exaggeration;  // drawn h = H * exaggeration + N
    uint last_row;       // of the region's posts
    uint last_column;
    uint cut_column;  // the last post before the meridian where the flat Earth is cut; no_column: none
    uint page_count;
    uint first_page;    // of a frame's several grids: triangle ids go on from one to the next
    uint other_grids;   // other grids that the frame draws
    uint sample_index;  // samples of a pixel are drawn one after the other
    uint sample_count;
    uint has_means;      // 1: pages have PageMeans
    uvec2 pages;         // device address of FramePage[page_count]
    uvec2 row_terms;     // RowTerms
    uvec2 column_terms;  // ColumnTerms
    uvec2 accepted;      // accepted_words a page: nodes that may stand for what is below them
    uvec2 edges;         // edges_words a page: edges (levels.glsl) of the nodes that are drawn
    uvec2 live;  // uint[2 page_count]: whether a page has something to draw, then the numbers of those that
                 // have
    uvec2 live_pages;  // LivePages
    uvec2 counts;      // device address of FrameCounts
    uvec2 depths;      // float for each pixel, row by row: reversed depth of what is seen; 0 when not wanted
    uvec2 tiles_in_parts;  // uint for each 8 x 8 pixels: 1 where some are left to the program for footprints
                           // of several parts; 0 where there is none such
    uvec2 triangles;  // DrawnTriangle for each pixel of triangle_rows rows, row by row; 0 when not wanted
    uint triangle_rows;
    uvec2 recorded;    // device address of recorded positions, or 0 (tests only)
    uint record_view;  // 1: positions in view coordinates are recorded, not those in the eye's meridian frame
    uvec2 visibility;  // compute rasteriser: device address of depth << 32 | ~id for each pixel, row by row
    uvec2 lists;       // RasterLists
    uvec2 meshlet_list;  // frame page * 256 + meshlet, edges << 28
    uvec2 clip_list;     // triangle ids
    uvec2 large_list;    // LargeTriangle[large_max + boxes_max]
    uvec2 task_list;     // LargeTask[tasks_max]
    uvec2 air;           // vec3[air_entries]; 0 without air
    uvec2 casters;       // Casters; 0: no shadows
    UndulationTable undulation;
    FrameStyle style;
    EyePost eye_post;
    NetMap net;
    DrapeTable drape;
    // Last, so that addresses before it stay at multiples of 8 bytes: it would cost 2 to 4 % of a frame.
    uint contents;          // contents_..., of its pages
    uint occlusion;         // 1: the frame is drawn in several rounds, see FrameRound
    uvec2 round_pages;      // LivePages of the pages that a round draws (mesh path)
    uvec2 round_live;       // uint[2 page_count]: as `live`, of a round
    uvec2 kept;             // accepted_words a page: nodes that neither the frustum nor the horizon hides
    uvec2 drawn;            // ... that the rounds so far have drawn
    uvec2 drawn_now;        // ... that this round draws
    uvec2 seen;             // ... that nothing hides, as far as the last round knows
    uvec2 seen_before;      // the same of the last frame; 0: nothing is known of it
    uvec2 page_before;      // uint[page_count]: a page's number in the last frame; no_page
    uvec2 pyramid;          // float: the pyramid of the farthest depths
    uvec2 ids_before;       // mesh path: uint for each pixel, row by row: its id before this round
    uint show;              // show_...: what explains the frame, in the place of colours
    float placing_slack_m;  // a post may be drawn so far from where it is in its page's frame
    ClusterTable clusters;
    // Three bits for each node, accepted_words of any a page: whether it was asked if it shows, whether it may,
    // and whether anything finer may that it stands for, because that is missing. 0: nobody wants to know.
    uvec2 feedback;
    uvec2 overdraw;  // uint for each pixel, row by row: triangles that cover it; 0: nobody wants to know
    uvec2 cluster_boxes;   // ClusterBox[clusters.count], of frames in rounds
    uvec2 cluster_states;  // uint[clusters.count]: cluster_..., of the round
    uint clusters_turn;    // number of this frame among those in rounds, for ClusterBlock.seen
    uint clusters_before;  // ... of the last one; 0: nothing is known of it
    ClusterCut cut;
    NoiseOctave noise[16];  // from the largest cells on
    ClearedGround cleared;  // near meshes
};

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

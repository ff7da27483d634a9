// What the CPU and the GPU both know: sizes, and the structs that lie in GPU memory. The only place where either is
// defined; compiled as C++ and as GLSL (scalar block layout, so the two agree; tests/render/shared_layout_test.cpp proves it).
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
ORO_CONST uint meshlets_per_task_max = 128u;  // of a task workgroup
ORO_CONST uint meshlet_vertices = 81u;
ORO_CONST uint meshlet_triangles = 128u;
// Heights are kept with one more post on each side, so that slopes are continuous across pages.
ORO_CONST uint height_stride = 131u;
ORO_CONST uint page_heights = 17161u;  // height_stride squared
ORO_CONST uint border_posts = 512u;    // see border_index
// dh of a post that is void. Far below any real dh, and finite.
ORO_CONST float void_dh_m = -1.0e30f;
ORO_CONST float void_dh_limit_m = -1.0e29f;  // dh below this is void

// Exact placement of posts relative to their page's origin (lat0, lon0, h0), in the page frame: x outward in the equatorial
// plane at lon0, y east, z north along the axis. With N_e the prime-vertical radius and rho0, z0 the origin's
// cylinder coordinates, all computed in double and rounded once:
struct RowTerms {
    float R;  // (N_e + h0) cos(lat) - rho0
    float C;  // cos(lat)
    float S;  // sin(lat)
    float P;  // (N_e + h0) cos(lat)
    float Z;  // (N_e (1 - e2) + h0) sin(lat) - z0
};
struct ColumnTerms {
    float V;  // 2 sin^2(dlon / 2)
    float W;  // sin(dlon)
};
// A post on the page's rim in ECEF metres, high + low, each the float nearest to what remains. Both pages that share
// the post hold the same bits, so their triangles meet without a gap.
struct BorderPost {
    vec3 high;
    vec3 low;
};
// What a meshlet's posts lie in: a sphere in the page frame, and a cone around a direction in scaled space (unit sphere
// = occluding ellipsoid): when the eye's direction is farther from `horizon_direction` than the eye's own horizon angle plus
// horizon_angle_rad, no post of the meshlet can be seen. The direction is kept as its offset from the page's.
// As a node of the pyramid (core/pyramid.h): how far its triangles are from the full resolution, and a sphere around `centre` that
// holds all they stand for; both at least those of the nodes below it and of those around these.
struct MeshletBounds {
    vec3 centre;
    float radius;  // negative: the meshlet has no triangle
    vec3 horizon_offset;
    float horizon_angle_rad;
    float error_m;     // unfit_error_m (levels.glsl): cannot stand for anything
    float lod_radius;
    uint quads;        // rows | columns << 4 of quads within the region: 8 each, or fewer where it ends
};
// One page as the GPU holds it.
struct PageBlock {
    RowTerms rows[129];
    ColumnTerms columns[129];
    BorderPost borders[512];
    MeshletBounds meshlets[256];
    float h0_m;              // height of the page's origin above the ellipsoid
    float row_spacing_m;     // metres along the meridian from one row to the next, at the page's middle
    float column_spacing_rad;
    float exaggeration;      // drawn h = H * exaggeration + N
    float N_m[4];            // undulation at the north-west, north-east, south-west, south-east corners
    float dh[17161];         // drawn h - h0, row by row from post (-1, -1); void_dh_m where void
};

// A page that this frame draws. Its number in the frame's list is in the triangle ids.
struct FramePage {
    mat3 view_from_page;     // rotation
    vec3 origin_view;        // the page's origin in view coordinates, metres
    vec4 planes[5];          // the frustum in the page frame, n.p + d >= 0 inside; left right bottom top near
    vec3 horizon_direction;  // scaled direction of the eye minus that of the page
    uvec2 block;             // device address of its PageBlock
    uint cull;               // bits: 1 the frustum, 2 the horizon may hide some meshlets of it
};
ORO_CONST uint cull_by_frustum = 1u;
ORO_CONST uint cull_by_horizon = 2u;

struct FrameCounts {
    uint meshlets_beyond_frustum;
    uint meshlets_beyond_horizon;
    uint meshlets_void;
    uint meshlets_drawn;
    uint triangles_drawn;
    uint triangles_not_clipped;  // compute path: no room in the list; the frame has holes
};

// What the compute rasteriser passes from one of its steps to the next. Group counts are those of an indirect dispatch.
struct RasterLists {
    uint meshlets;           // meshlets to draw
    uint meshlet_groups[3];
    uint clips;              // triangles that cross the near plane or leave the range of integer coordinates
    uint clip_groups[3];
    uint large;              // triangles that many workgroups share
    uint tasks;              // squares of pixels of those
    uint task_groups[3];
};
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
ORO_CONST uint large_square_px = 64u;
ORO_CONST uint clips_max = 1048576u;
ORO_CONST uint large_max = 262144u;
ORO_CONST uint tasks_max = 1048576u;
ORO_CONST uint groups_per_row = 32768u;  // of an indirect dispatch; below every device's limit

struct TintStop {
    float H_m;
    vec3 colour;  // linear light
};
ORO_CONST uint tint_stops_max = 24u;

// How a frame is coloured. Colours are linear light, Rec. 709 primaries.
struct FrameStyle {
    TintStop tints[24];
    uint tint_count;
    vec3 sun_enu;            // unit vector towards the sun in the local frame of every place (a map's light)
    float ambient;           // share of the light that has no direction
    float relief;            // slopes are shaded as if they were this much steeper (1: as they are)
    vec3 haze_colour;
    float haze_distance_m;   // distance at which haze has taken 63 % of the colour
    vec3 zenith_colour;
    vec3 no_data_colour;     // the bare ellipsoid
    float sky_scale_height_m;
};

struct FrameConstants {
    mat3 view_from_ecef;
    vec3 eye_high;           // the eye in ECEF metres, high + low
    vec3 eye_low;
    vec2 projection_scale;   // see core/camera.h, Projection
    vec2 projection_shift;
    float near_m;
    float horizon_angle_rad; // of the eye: acos(1 / distance in scaled space); pi when the eye is below the occluder
    vec3 up_view;            // the ellipsoid's normal at the eye, in view coordinates
    float eye_h_m;
    float earth_radius_m;    // Gaussian radius of curvature at the eye
    uint width_px;
    uint height_px;
    uint page_count;
    uint sample_index;       // samples of a pixel are drawn one after the other
    uint sample_count;
    uvec2 pages;             // device address of FramePage[page_count]
    uvec2 counts;            // device address of FrameCounts
    uvec2 recorded;          // device address of recorded positions, or 0 (tests only)
    uvec2 visibility;        // compute rasteriser: device address of depth << 32 | id for each pixel, row by row
    uvec2 lists;             // RasterLists
    uvec2 meshlet_list;      // frame page * 256 + meshlet
    uvec2 clip_list;         // triangle ids
    uvec2 large_list;        // LargeTriangle[large_max]
    uvec2 task_list;         // LargeTask[tasks_max]
    FrameStyle style;
};

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

// What a device makes of a plan by itself before it draws a frame: tables of rows and columns, and where pages
// are. Compiled as C++ and as GLSL; not a part of shared.h, for only plan_terms.comp needs it, and doubles.
#ifndef OROGRAPH_SHADERS_PLAN_SHARED_PLAN_H
#define OROGRAPH_SHADERS_PLAN_SHARED_PLAN_H

#ifdef __cplusplus
#include "shaders/shared.h"
namespace oro::gpu {
#endif

// A row of posts, whatever the eye (core/frame/row_angles.h).
struct RowSource {
    double sine;  // of its latitude
    double cosine;
    double normal_m;  // the radius of curvature along the prime vertical there
    double polar_m;   // (1 - e^2) of it
};

// A page, whatever the eye. Matrices lie column by column.
struct PageSource {
    double ecef_from_page[9];
    double origin_ecef[3];
    double centre_ecef[3];  // of the sphere around its posts
    double radius_m;        // ... and how large that is
    double horizon[3];      // direction of its cone
};

// One grid of a frame: what depends on the eye, and where all that lies.
struct PlanTerms {
    double view_from_ecef[9];
    double eye_ecef[3];
    double planes[20];   // of the frustum in view coordinates: x, y, z and w of five
    double horizon[3];   // direction of the eye
    double reference_m;  // heights are relative to it
    double rho_m;        // of the eye: from the Earth's axis, and from the equator
    double z_m;
    double eye_lon_deg;
    uvec2 row_sources;     // page_posts RowSources for each row of pages of a level
    uvec2 column_sources;  // page_posts longitudes, degrees, for each column of pages of a level
    uvec2 page_sources;    // PageSources
    uvec2 numbers;         // of the frame's sources: of rows of pages, of columns of pages, of pages
    uvec2 rows;            // to be made: page_posts RowTerms of each of them
    uvec2 columns;         // ... ColumnTerms
    uvec2 pages;           // the frame's FramePages, which lack what is made of the sources
    uint row_count;        // of rows of pages, and so on
    uint column_count;
    uint page_count;
    uint unused;
};
ORO_CONST uint plan_pages_per_group = 64u;

#ifdef __cplusplus
}  // namespace oro::gpu
#endif

#endif

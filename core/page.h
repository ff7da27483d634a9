// A region's levels cut into pages of 128 x 128 quads, each with all that the GPU needs to place and cull it.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "core/culling.h"
#include "core/drawn_heights.h"
#include "core/ellipsoid.h"
#include "core/level_grid.h"
#include "core/post_grid.h"
#include "shaders/shared.h"

namespace oro {

struct PageIndex {
    int row{};
    int column{};
    int level{};
};

// Pages of a region's level 0.
//
// Where a region goes round the Earth and its quads are no multiple of 128, its last column lies within a
// page, and so may a pole's row: those posts are placed like inner ones, within the page's error of their
// twins on the first column's rim.
PageLayout page_layout(const PostGrid& grid);

// What holds for the whole region and every page of it.
struct RegionShape {
    HorizonOccluder occluder;
    double exaggeration{1.0};
};
RegionShape region_shape(const HeightField& field, double exaggeration);

// What the CPU keeps of a page: enough to choose it and to place its frame.
struct PageSummary {
    PageIndex index;
    Geodetic origin;  // the page's middle post position and the middle of its heights
    Ecef origin_ecef;
    glm::dmat3 ecef_from_page;  // rotation by the origin's longitude about the axis
    glm::dvec3 centre_m;        // sphere around all posts, page frame, relative to the origin
    double radius_m{};
    HorizonCone horizon;
    double lowest_h_m{};
    double highest_h_m{};
    std::uint32_t triangles{};  // 0: nothing to draw
    std::uint32_t meshlets{};   // those with a triangle
    // Of the nodes, as the pyramid (core/pyramid.h) knows them; 0 where there is none.
    float largest_error_m{};   // unfit_error_m where one is unfit
    float smallest_error_m{};  // of those with a triangle
    double lod_radius_m{};     // around centre_m: holds the nodes' lod spheres
};

// Fills `block` for a page of any level and gives its summary. Posts of the block are placed within 1 mm of
// their true position for pages up to 4 km wide, 2 mm up to 12 km, and in proportion beyond (evaluated in
// float32 as shaders/place.glsl does).
PageSummary build_page(const HeightField& field, const RegionShape& shape, PageIndex index,
                       gpu::PageBlock& block);
// The same, faster: from heights that are there already. `heights` are the field's own with the shape's
// exaggeration.
PageSummary build_page(const HeightField& field, const RegionShape& shape, const DrawnHeights& heights,
                       PageIndex index, gpu::PageBlock& block);

}  // namespace oro

// A region cut into pages of 128 x 128 quads, each with all that the GPU needs to place and cull it.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "core/culling.h"
#include "core/ellipsoid.h"
#include "core/post_grid.h"
#include "shaders/shared.h"

namespace oro {

struct PageIndex {
    int row{};
    int column{};
};

// Pages of a region: number of pages along each axis (the last ones may be partly beyond the grid: void
// there).
struct PageLayout {
    int rows{};
    int columns{};
};
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
};

// Position of a post that is not void on the exaggerated surface, canonical: the same bits for the same post
// from whatever page it is asked. Row and column may be one meridian's two numbers where a region goes round
// the Earth.
Ecef post_ecef(const HeightField& field, int row, int column, double exaggeration);

// Fills `block` for a page and gives its summary. Posts of the block are placed within 1 mm of their true
// position for pages up to 4 km wide, 2 mm up to 12 km (evaluated in float32 as shaders/place.glsl does).
PageSummary build_page(const HeightField& field, const RegionShape& shape, PageIndex index,
                       gpu::PageBlock& block);

}  // namespace oro

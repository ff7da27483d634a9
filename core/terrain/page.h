// A region's levels cut into pages of 128 x 128 quads, each with all that the GPU needs to place and cull it.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "core/earth/culling.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/level_grid.h"
#include "core/terrain/post_grid.h"
#include "shaders/shared.h"

namespace oro {

struct PageIndex {
    int row{};
    int column{};
    int level{};
    auto operator<=>(const PageIndex&) const = default;
};

// Pages of a region's level 0.
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
    // Of the nodes, as the pyramid (core/lod/pyramid.h) knows them; 0 where there is none.
    float largest_error_m{};  // unfit_error_m where one is unfit
    double lod_radius_m{};    // around centre_m: holds the nodes' lod spheres
};

// The heights of a page, row by row from post (-1, -1): its 129 x 129 posts and one more on each side (round
// the Earth, too), so that slopes are continuous across pages.
struct PageHeights {
    std::array<std::int32_t, gpu::page_heights>
        steps;  // drawn, see drawn_heights.h; void_height_steps where none
    std::array<std::uint32_t, gpu::page_diagonal_words> sw_ne{};  // as in the page's block
};
PageHeights page_heights(const PostGrid& grid, const DrawnHeights& heights, PageIndex index);

// A page's posts as the source gives them: H in metres, void_height_m where there is none. Posts that are one
// point (a meridian's two columns, a pole) have the H that is drawn for all of them. Where a region that goes
// round the Earth ends within the page, one more column, which only diagonals are decided by.
struct PageElevations {
    std::array<float, gpu::page_heights> H_m;
};
PageElevations page_elevations(const HeightField& field, PageIndex index);
// From these to what is drawn; the same numbers as page_heights gives.
PageHeights page_heights(const PostGrid& grid, const UndulationField& undulation, double exaggeration,
                         const PageElevations& elevations, PageIndex index);

// What bounds each meshlet: all that a picture asks for, or spheres alone, without horizon cones and boxes. A
// tenth of the time, for who only measures.
enum class MeshletBounding { whole, spheres };
// Fills `block` for a page of any level and gives its summary. The nodes' errors are left to the pyramid.
PageSummary build_page(const PostGrid& grid, const RegionShape& shape, const PageHeights& heights,
                       PageIndex index, gpu::PageBlock& block,
                       MeshletBounding bounding = MeshletBounding::whole);
// Builds a page from the field's own posts.
PageSummary build_page(const HeightField& field, const RegionShape& shape, PageIndex index,
                       gpu::PageBlock& block);

// Fills a block's spacing, and how its rows, its columns and its normal lie, for a page with that origin.
void set_spacing(const PostGrid& grid, const PageSummary& page, gpu::PageBlock& block);

// The frame of a page from its origin: origin_ecef and ecef_from_page.
void set_page_frame(PageSummary& summary);

// Number in the region of a post of a level, and where it would lie beyond the region's end.
std::int64_t post_beyond(const LevelAxis& axis, int post);

}  // namespace oro

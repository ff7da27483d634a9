// A region's levels cut into pages of 128 x 128 quads, each with all that the GPU needs to place and cull it.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "core/culling.h"
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
};

// Drawn heights above the ellipsoid, exaggeration and undulation included, in steps of 2^-11 m: a height less
// the whole metres of a page's origin is then exact in a float (up to 8,192 m), so that every page and level
// holds the same height for a post. Costs at most 0.25 mm, and is what every function here calls the height.
inline constexpr double height_step_m = 1.0 / 2048.0;
inline constexpr std::int32_t void_height_steps = std::numeric_limits<std::int32_t>::min();

// Those of a whole region, row by row. Posts that are one point (a meridian's two columns, a pole) have one
// height.
struct DrawnHeights {
    int rows{};
    int columns{};
    std::vector<std::int32_t> steps;  // void_height_steps where there is none

    [[nodiscard]] const std::int32_t* row(int number) const {
        return steps.data() + static_cast<std::size_t>(number) * static_cast<std::size_t>(columns);
    }
    [[nodiscard]] std::int32_t at(int row_number, int column) const { return row(row_number)[column]; }
};
// 4 bytes a post; the work is shared between `threads` (at least 1), with one result for any number.
DrawnHeights drawn_heights(const HeightField& field, double exaggeration, int threads);

// Position of a post that is not void on the exaggerated surface, canonical: the same bits for the same post
// from whatever page it is asked. Row and column may be one meridian's two numbers where a region goes round
// the Earth.
Ecef post_ecef(const HeightField& field, int row, int column, double exaggeration);

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

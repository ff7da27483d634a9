// Pages of a grid whose posts lie on a net: where they are, and what the GPU gets of it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "core/net/lattice_georeference.h"
#include "core/terrain/level_grid.h"
#include "core/terrain/page.h"

namespace oro {

// The place in the middle of what the region has of a page.
PostPlace net_page_middle(const PostGrid& grid, const PageIndex& index);

// visit(row, column, normal) for all posts of a page, 0 .. 128 each way, that the region has.
template <class Visit>
void for_each_normal(const PostGrid& grid, const PageIndex& index, const Visit& visit) {
    constexpr int quads = static_cast<int>(gpu::page_quads);
    const LevelGrid level = level_grid(grid, index.level);
    std::array<glm::dvec3, gpu::page_posts> normals;
    const int first_row = index.row * quads, first_column = index.column * quads;
    const int rows = std::min(quads, level.row.quads - first_row),
              columns = std::min(quads, level.column.quads - first_column);
    for (int i = 0; i <= rows; ++i) {
        const int row = level.row.region_post(first_row + i);
        for (int j = 0; j <= columns; ++j) {
            const int column = level.column.region_post(first_column + j);
            // One by one on coarse levels, whose posts lie far apart.
            if (index.level > 0)
                grid.net->normals_of_row(row, column, {&normals[static_cast<std::size_t>(j)], 1});
            else if (j == 0)
                grid.net->normals_of_row(row, column,
                                         {normals.data(), static_cast<std::size_t>(columns) + 1});
            visit(i, j, normals[static_cast<std::size_t>(j)]);
        }
    }
}

// Places in whole steps of 2^-11 m along the axes of ECEF (core/terrain/drawn_heights.h, height_step_m):
// exact differences of them are what posts and eye are to each other.
struct LatticePoint {
    std::array<std::int64_t, 3> steps;
};
LatticePoint lattice_point(const glm::dvec3& ecef_m);

// Whether the places of a page's posts are told from a plane, because 32 bits hold no more than 1,048 km.
bool reaches_far(const PageSummary& page);

// Fills the places of a page's posts on the lattice, from the page's origin or, where it reaches far, from a
// plane. Costs 12 bytes a post. A post has the same place from every page and level: 0.5 mm at most from
// where the net has it. False where posts lie more than 1,048 km from the plane.
bool fill_places(const PostGrid& grid, const PageSummary& page, const PageHeights& heights,
                 gpu::PagePlaces& places);

// Whether one page can hold all posts of a net: those of a region some 5,000 km around its middle.
bool fits_one_page(const LatticeGeoreference& net);

// N for what is coloured by H: of every so many-th post of a field on a net, bilinear between. Its axes count
// posts and not degrees.
UndulationField drawn_undulation(const HeightField& field);
int undulation_step(const PostGrid& grid);

// Fills a block's spacing, and how rows are turned, from the page's middle.
void set_net_spacing(const LatticeGeoreference& net, const PageSummary& page, gpu::PageBlock& block);

}  // namespace oro

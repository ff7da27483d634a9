// The heights of a page: of the region's posts that it has.
#include <cassert>

#include "core/terrain/page_posts.h"

namespace oro {
namespace {

constexpr int posts = static_cast<int>(gpu::page_posts);
constexpr int stride = static_cast<int>(gpu::height_stride);

}  // namespace

PageLayout page_layout(const PostGrid& grid) {
    return level_grid(grid, 0).pages();
}

PageHeights page_heights(const PostGrid& grid, const DrawnHeights& heights, PageIndex index) {
    assert(heights.rows == grid.rows() && heights.columns == grid.columns());
    PageHeights page;
    for_each_post(PagePosts(grid, index), [&](std::size_t i, const std::optional<PageIndex>& post) {
        page.steps[i] = post ? heights.at(post->row, post->column) : void_height_steps;
    });
    return page;
}

PageElevations page_elevations(const HeightField& field, PageIndex index) {
    PageElevations page;
    for_each_post(PagePosts(field.grid, index), [&](std::size_t i, const std::optional<PageIndex>& post) {
        page.H_m[i] = post ? field.H_at_post_m(post->row, canonical_column(field, post->row, post->column))
                           : void_height_m;
    });
    return page;
}

PageHeights page_heights(const PostGrid& grid, const UndulationField& undulation, double exaggeration,
                         const PageElevations& elevations, PageIndex index) {
    const bool has_N = !undulation.N_m.empty();
    const PagePosts page_posts(grid, index);
    PageHeights page;
    for (int row = -1; row <= posts; ++row) {
        UndulationField::Between N_row{};
        for (int column = -1; column <= posts; ++column) {
            const auto i = static_cast<std::size_t>((row + 1) * stride + column + 1);
            page.steps[i] = void_height_steps;
            if (is_void(elevations.H_m[i])) continue;
            const std::optional<PageIndex> post = page_posts.region_post(row, column);
            if (!post) continue;
            N_row = has_N ? undulation.row_between(row_lat_deg(grid, post->row)) : N_row;
            const double N_m = has_N ? undulation.at_m(N_row, undulation.column_between(canonical_lon_deg(
                                                                  grid, post->row, post->column)))
                                     : 0.0;
            page.steps[i] = height_steps(static_cast<double>(elevations.H_m[i]) * exaggeration + N_m);
        }
    }
    return page;
}

}  // namespace oro

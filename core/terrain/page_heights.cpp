// The heights of a page: of the region's posts that it has.
#include <algorithm>
#include <array>
#include <cassert>
#include <span>

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

namespace {

// The same of a grid on a net.
PageHeights heights_on_net(const PostGrid& grid, const UndulationField& undulation, double exaggeration,
                           const PageElevations& elevations, PageIndex index) {
    const bool has_N = !undulation.N_m.empty();
    const PagePosts page_posts(grid, index);
    PageHeights page;
    std::array<glm::dvec3, gpu::height_stride> normals;
    for (int row = -1; row <= posts; ++row) {
        std::optional<PageIndex>
            first;  // of the row's posts that the region has; at level 0 the others follow
        for (int column = -1; column <= posts; ++column) {
            const auto i = static_cast<std::size_t>((row + 1) * stride + column + 1);
            page.steps[i] = void_height_steps;
            const std::optional<PageIndex> post = page_posts.region_post(row, column);
            if (!post) continue;
            const float H_m = elevations.H_m[i];
            if (!first && has_N && index.level == 0) {
                const int left = std::min(posts - column + 1, grid.columns() - post->column);
                grid.net->normals_of_row(post->row, post->column,
                                         std::span(normals).first(static_cast<std::size_t>(left)));
            }
            if (!first) first = post;
            if (is_void(H_m)) continue;
            glm::dvec3& normal =
                normals[index.level == 0 ? static_cast<std::size_t>(post->column - first->column) : 0];
            if (has_N && index.level > 0) grid.net->normals_of_row(post->row, post->column, {&normal, 1});
            const double N_m = has_N ? static_cast<double>(N_on_net_m(undulation, normal)) : 0.0;
            page.steps[i] = height_steps(static_cast<double>(H_m) * exaggeration + N_m);
        }
    }
    return page;
}

}  // namespace

PageHeights page_heights(const PostGrid& grid, const UndulationField& undulation, double exaggeration,
                         const PageElevations& elevations, PageIndex index) {
    if (grid.net) return heights_on_net(grid, undulation, exaggeration, elevations, index);
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

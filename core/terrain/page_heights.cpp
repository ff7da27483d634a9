// The heights of a page: of the region's posts that it has.
#include <algorithm>
#include <array>
#include <cassert>
#include <span>

#include "core/terrain/page_diagonals.h"
#include "core/terrain/page_posts.h"

namespace oro {
namespace {

constexpr int posts = static_cast<int>(gpu::page_posts);
constexpr int stride = static_cast<int>(gpu::height_stride);
constexpr int quads = static_cast<int>(gpu::page_quads), side = static_cast<int>(gpu::meshlets_per_side),
              meshlet_quads = static_cast<int>(gpu::meshlet_quads);

using PageDiagonals = std::array<std::uint32_t, gpu::page_diagonal_words>;

// Puts the bits of eight cells of a row of a page's where the block has them.
void put_eight(PageDiagonals& sw_ne, int row, int column, std::uint8_t eight) {
    const int meshlet = row / meshlet_quads * side + column / meshlet_quads,
              cell = row % meshlet_quads * meshlet_quads;
    sw_ne[static_cast<std::size_t>(2 * meshlet + cell / 32)] |= static_cast<std::uint32_t>(eight)
                                                                << (cell % 32);
}

// Those of the whole region.
PageDiagonals diagonals_of(const CellDiagonals& all, PageIndex index) {
    PageDiagonals sw_ne{};
    const int first_row = index.row * quads, first_column = index.column * quads;
    for (int row = 0; row < std::min(quads, all.rows(index.level) - first_row); ++row) {
        for (int column = 0; column < std::min(quads, all.columns(index.level) - first_column);
             column += meshlet_quads)
            put_eight(sw_ne, row, column, all.eight(index.level, first_row + row, first_column + column));
    }
    return sw_ne;
}

// Decided by the page's own posts: the same, for these go as far as those that decide.
PageDiagonals diagonals_of(const PostGrid& grid, const PageElevations& elevations, PageIndex index) {
    PageDiagonals sw_ne{};
    const LevelGrid level = level_grid(grid, index.level);
    const int cells = std::min(quads, level.column.quads - index.column * quads);
    DiagonalRows rows(cells);
    std::array<std::uint8_t, quads / 8> bits{};
    for (int row = -1; row <= std::min(posts, level.row.quads - index.row * quads + 1); ++row) {
        const std::span<std::int32_t> steps = rows.next();
        for (std::size_t i = 0; i < steps.size(); ++i)
            steps[i] = decisive_steps(elevations.H_m[static_cast<std::size_t>((row + 1) * stride) + i]);
        rows.take();
        if (row < 2) continue;
        rows.decide(std::span(bits).first(static_cast<std::size_t>((cells + 7) / 8)));
        for (int column = 0; column < cells; column += 8)
            put_eight(sw_ne, row - 2, column, bits[static_cast<std::size_t>(column / 8)]);
    }
    return sw_ne;
}

// Which of the region's columns a page's posts are, row after row.
class PageColumns {
  public:
    explicit PageColumns(const PagePosts& page) : columns_(page.region_columns()) {
        const auto there = [](int column) { return column >= 0; };
        first_ = static_cast<std::size_t>(std::ranges::find_if(columns_, there) - columns_.begin());
        end_ = first_;
        while (end_ < columns_.size() && columns_[end_] == columns_[first_] + static_cast<int>(end_ - first_))
            ++end_;
        one_after_another_ =
            std::none_of(columns_.begin() + static_cast<std::ptrdiff_t>(end_), columns_.end(), there);
    }
    // from: a row of the region, null where it has none there; `none` stands where there is no post.
    template <class Height>
    void copy(const Height* from, Height none, Height* to) const {
        if (from == nullptr || first_ == columns_.size()) {
            std::fill_n(to, columns_.size(), none);
        } else if (one_after_another_) {
            std::fill_n(to, first_, none);
            std::copy_n(from + columns_[first_], end_ - first_, to + first_);
            std::fill(to + end_, to + columns_.size(), none);
        } else {
            copy_each([&](int column) { return from[column]; }, none, to);
        }
    }
    template <class Height, class Give>
    void copy_each(const Give& give, Height none, Height* to) const {
        for (std::size_t i = 0; i < columns_.size(); ++i) to[i] = columns_[i] < 0 ? none : give(columns_[i]);
    }

  private:
    std::array<int, gpu::height_stride> columns_;
    std::size_t first_{}, end_{};
    bool one_after_another_{};
};

// Heights of a row's posts, each that which is drawn for all posts of its place. What a row is, is asked
// once.
class RowElevations {
  public:
    RowElevations(const HeightField& field, int row)
        : field_(&field), row_(row), all_(at_pole(field.grid, row)) {
        twin_ = field.grid.wraps_longitude() ? field.grid.columns() - 1 : -1;
    }
    [[nodiscard]] float H_m(int column) const {
        if (all_ || column == twin_)
            return field_->H_at_post_m(row_, canonical_column(*field_, row_, column));
        return field_->H_at_post_m(row_, column);
    }

    // The row in memory, where each post has its own height and all are there; else null.
    [[nodiscard]] const float* as_they_are() const {
        if (all_ || twin_ >= 0 || field_->posts) return nullptr;
        return &field_
                    ->H_m[static_cast<std::size_t>(row_) * static_cast<std::size_t>(field_->grid.columns())];
    }

  private:
    const HeightField* field_;
    int row_, twin_;
    bool all_;
};

}  // namespace

PageLayout page_layout(const PostGrid& grid) {
    return level_grid(grid, 0).pages();
}

PageHeights page_heights(const PostGrid& grid, const DrawnHeights& heights, PageIndex index) {
    assert(heights.rows == grid.rows() && heights.columns == grid.columns());
    PageHeights page;
    const PagePosts page_posts(grid, index);
    const PageColumns columns(page_posts);
    for (int row = -1; row <= posts; ++row) {
        const int region_row = page_posts.region_row(row);
        columns.copy(region_row < 0 ? nullptr : heights.row(region_row), void_height_steps,
                     &page.steps[static_cast<std::size_t>((row + 1) * stride)]);
    }
    page.sw_ne = page_diagonals(heights, index);
    return page;
}

std::array<std::uint32_t, gpu::page_diagonal_words> page_diagonals(const DrawnHeights& heights,
                                                                   PageIndex index) {
    return heights.diagonals ? diagonals_of(*heights.diagonals, index) : PageDiagonals{};
}

PageElevations page_elevations(const HeightField& field, PageIndex index) {
    PageElevations page;
    const PagePosts page_posts(field.grid, index);
    const PageColumns columns(page_posts);
    for (int row = -1; row <= posts; ++row) {
        float* const H_m = &page.H_m[static_cast<std::size_t>((row + 1) * stride)];
        const int region_row = page_posts.region_row(row);
        if (region_row < 0) {
            columns.copy<float>(nullptr, void_height_m, H_m);
            continue;
        }
        const RowElevations elevations(field, region_row);
        if (const float* const of_region = elevations.as_they_are())
            columns.copy(of_region, void_height_m, H_m);
        else
            columns.copy_each([&](int column) { return elevations.H_m(column); }, void_height_m, H_m);
    }
    // The post after a last column that is the first one.
    const LevelGrid level = level_grid(field.grid, index.level);
    const int after = level.column.quads + 1 - index.column * quads;
    if (!field.grid.wraps_longitude() || after >= posts) return page;
    const int column = level.column.region_post(1);
    for (int i = -1; i <= posts; ++i) {
        const int level_row = index.row * quads + i;
        if (level_row < 0 || level_row > level.row.quads) continue;
        const int row = level.row.region_post(level_row);
        page.H_m[static_cast<std::size_t>((i + 1) * stride + after + 1)] =
            field.H_at_post_m(row, canonical_column(field, row, column));
    }
    return page;
}

namespace {

// The same of a grid on a net.
PageHeights heights_on_net(const PostGrid& grid, const UndulationField& undulation, double exaggeration,
                           const PageElevations& elevations, PageIndex index) {
    const bool has_N = !undulation.N_m.empty();
    const PagePosts page_posts(grid, index);
    PageHeights page;
    page.sw_ne = diagonals_of(grid, elevations, index);
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
    page.sw_ne = diagonals_of(grid, elevations, index);
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

#include "core/frame/column_angles.h"

#include <cassert>
#include <cstddef>
#include <cstdint>

#include "core/terrain/page.h"

namespace oro {
namespace {

constexpr int page_columns = static_cast<int>(gpu::page_posts);

double longitude_deg(const PostGrid& grid, std::int64_t column) {
    const bool twin = column == grid.columns() - 1 && grid.wraps_longitude();
    return grid.lon.at_deg(twin ? 0 : column);
}

}  // namespace

std::span<const double> ColumnAngles::of(int first, int count) {
    assert(!grid_->net && first >= 0 && first + count <= grid_->columns());
    if (columns_.empty()) {
        columns_.resize(static_cast<std::size_t>(grid_->columns()));
        for (int i = 0; i < grid_->columns(); ++i)
            columns_[static_cast<std::size_t>(i)] = longitude_deg(*grid_, i);
    }
    return std::span(columns_).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
}

std::span<const double> ColumnAngles::of_pages(const LevelAxis& level, int page_column) {
    const int first = page_column * static_cast<int>(gpu::page_quads);
    const auto number = static_cast<std::size_t>(level.level);
    if (pages_.size() <= number) pages_.resize(number + 1);
    if (pages_[number].empty()) pages_[number].resize(static_cast<std::size_t>(level.pages()));
    std::vector<double>& of_page = pages_[number][static_cast<std::size_t>(page_column)];
    if (of_page.empty()) {
        of_page.resize(gpu::page_posts);
        for (int i = 0; i < page_columns; ++i)
            of_page[static_cast<std::size_t>(i)] = longitude_deg(*grid_, post_beyond(level, first + i));
    }
    return of_page;
}

}  // namespace oro

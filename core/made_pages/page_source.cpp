#include "core/made_pages/page_source.h"

#include <type_traits>

#include "core/made_pages/page_sources.h"
#include "core/terrain/page_posts.h"

namespace oro {
namespace {

static_assert(gpu::made_page_stride == gpu::height_stride);
static_assert(sizeof(gpu::MadePageRow) == 24 && sizeof(gpu::MadePageColumn) == 24);

gpu::uint kind_of(std::int64_t number) {
    return gpu::made_post_there | ((number & 1) != 0 ? gpu::made_post_odd : 0U);
}

gpu::MadePageRow row_of(const PostGrid& grid, const UndulationField& undulation, const MadeGround& ground,
                        int row) {
    if (row < 0) return {};
    const std::int64_t number = ground.north - row;
    const MadeRow placed = made_row(number, ground.posts_per_deg);
    gpu::MadePageRow of{placed.from_axis, placed.north, kind_of(number), 0, 0.0};
    if (at_pole(grid, row)) of.is |= gpu::made_post_pole;
    if (undulation.N_m.empty()) return of;
    const auto [first, share] = undulation.row_between(row_lat_deg(grid, row));
    of.N_first = first;
    of.N_share = share;
    return of;
}

gpu::MadePageColumn column_of(const PostGrid& grid, const UndulationField& undulation,
                              const MadeGround& ground, int column) {
    if (column < 0) return {};
    const std::int64_t number = ground.west + column;
    const MadeColumn placed = made_column(number, ground.posts_per_deg);
    gpu::MadePageColumn of{placed.cosine, placed.sine, kind_of(number), 0, 0.0};
    if (undulation.N_m.empty()) return of;
    const bool is_first_again = column == grid.columns() - 1 && grid.wraps_longitude();
    const auto [first, share] = undulation.column_between(grid.lon.at_deg(is_first_again ? 0 : column));
    of.N_first = first;
    of.N_share = share;
    return of;
}

// row and column: what of the region's rows and columns, -1 where it has none.
template <class Row, class Column>
void fill(const PostGrid& grid, PageIndex page, const Row& row, const Column& column,
          gpu::MadePageSource& source) {
    const PagePosts posts(grid, page);
    const std::array<int, gpu::height_stride> columns = posts.region_columns();
    for (int i = 0; i < static_cast<int>(gpu::height_stride); ++i) {
        source.rows[i] = row(posts.region_row(i - 1));
        source.columns[i] = column(columns[static_cast<std::size_t>(i)]);
    }
    source.of_poles = column(0);
}

}  // namespace

void set_page_source(const PostGrid& grid, const UndulationField& undulation, const MadeGround& ground,
                     PageIndex page, gpu::MadePageSource& source) {
    fill(
        grid, page, [&](int row) { return row_of(grid, undulation, ground, row); },
        [&](int column) { return column_of(grid, undulation, ground, column); }, source);
}

PageSources::PageSources(const PostGrid& grid, const UndulationField& undulation, const MadeGround& ground)
    : grid_(grid), undulation_(undulation), ground_(ground) {
    constexpr int most = 65536;
    if (static_cast<std::int64_t>(grid.rows()) + grid.columns() > most) return;
    for (int row = 0; row < grid.rows(); ++row) rows_.push_back(row_of(grid, undulation, ground, row));
    for (int column = 0; column < grid.columns(); ++column)
        columns_.push_back(column_of(grid, undulation, ground, column));
}

void PageSources::set(PageIndex page, gpu::MadePageSource& source) const {
    if (rows_.empty()) return set_page_source(grid_, undulation_, ground_, page, source);
    const auto of = [](const auto& known, int number) {
        using Share = std::remove_cvref_t<decltype(known.front())>;
        return number < 0 ? Share{} : known[static_cast<std::size_t>(number)];
    };
    fill(
        grid_, page, [&](int row) { return of(rows_, row); },
        [&](int column) { return of(columns_, column); }, source);
}

}  // namespace oro

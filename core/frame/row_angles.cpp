#include "core/frame/row_angles.h"

#include <algorithm>
#include <cassert>

#include "core/earth/ellipsoid.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/page.h"

namespace oro {
namespace {

constexpr int page_rows = static_cast<int>(gpu::page_posts);
constexpr int rows_at_a_time = 128;

RowAngles::Row angles_of(const PostGrid& grid, std::int64_t row) {
    const double lat_deg =
        grid.net ? grid.net->place_at(static_cast<double>(row), 0.5 * (grid.columns() - 1)).lat_deg
                 : row_lat_deg(grid, row);
    const SineCosine lat = sine_cosine_deg(lat_deg);
    return {lat.sine, lat.cosine, prime_vertical_radius_m(lat_deg)};
}

}  // namespace

void RowAngles::Table::set(std::size_t number, const Row& row) {
    sine[number] = row.sine;
    cosine[number] = row.cosine;
    normal_m[number] = row.normal_m;
    polar_m[number] = row.normal_m * (1.0 - wgs84_e2);
}

void RowAngles::fill(int first, int count) {
    if (!rows_) {
        rows_ = std::make_unique<Table>(static_cast<std::size_t>(grid_->rows()));
        filled_.resize(static_cast<std::size_t>((grid_->rows() + rows_at_a_time - 1) / rows_at_a_time));
    }
    for (int some = first / rows_at_a_time; some * rows_at_a_time < first + count; ++some) {
        if (filled_[static_cast<std::size_t>(some)]) continue;
        filled_[static_cast<std::size_t>(some)] = true;
        const int end = std::min((some + 1) * rows_at_a_time, grid_->rows());
        for (int row = some * rows_at_a_time; row < end; ++row)
            rows_->set(static_cast<std::size_t>(row), angles_of(*grid_, row));
    }
}

RowAngles::Rows RowAngles::of(int first, int count) {
    assert(first >= 0 && count >= 1 && first + count <= grid_->rows());
    fill(first, count);
    return rows_->from(static_cast<std::size_t>(first));
}

RowAngles::Row RowAngles::at(std::int64_t row) {
    if (grid_->net) row = std::min<std::int64_t>(row, grid_->rows() - 1);
    if (row < 0 || row >= grid_->rows()) return angles_of(*grid_, row);
    const Rows one = of(static_cast<int>(row), 1);
    return {*one.sine, *one.cosine, *one.normal_m};
}

RowAngles::Rows RowAngles::of_pages(const LevelAxis& level, int page_row) {
    const int first = page_row * static_cast<int>(gpu::page_quads);
    if (level.level == 0 && first + page_rows <= grid_->rows()) return of(first, page_rows);
    const auto number = static_cast<std::size_t>(level.level);
    if (pages_.size() <= number) pages_.resize(number + 1);
    if (pages_[number].empty()) pages_[number].resize(static_cast<std::size_t>(level.pages()));
    std::unique_ptr<Table>& table = pages_[number][static_cast<std::size_t>(page_row)];
    if (!table) {
        table = std::make_unique<Table>(gpu::page_posts);
        for (int i = 0; i < page_rows; ++i)
            table->set(static_cast<std::size_t>(i), at(post_beyond(level, first + i)));
    }
    return table->from(0);
}

}  // namespace oro

#include "core/terrain/drawn_heights.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/terrain/floor_within.h"

namespace oro {

bool at_pole(const PostGrid& grid, int row) {
    return !grid.net && std::abs(row_lat_deg(grid, row)) == 90.0;
}

namespace {

// height_steps() without a call.
inline std::int32_t rounded_steps(double h_m) {
    return floor_within(h_m * (1.0 / height_step_m) + 0.5, highest_height_steps);
}

}  // namespace

std::int32_t height_steps(double h_m) {
    return rounded_steps(h_m);
}

int canonical_column(const HeightField& field, int row, int column) {
    const PostGrid& grid = field.grid;
    if (is_void(field.H_at_post_m(row, column))) return column;
    if (at_pole(grid, row)) {
        int first = 0;
        // No further than the post itself, also where a page can no longer be read that could be just now.
        while (first < column && is_void(field.H_at_post_m(row, first))) ++first;
        return first;
    }
    const bool twin = column == grid.columns() - 1 && grid.wraps_longitude();
    return twin && !is_void(field.H_at_post_m(row, 0)) ? 0 : column;
}

double canonical_lon_deg(const PostGrid& grid, int row, int column) {
    const bool twin = column == grid.columns() - 1 && grid.wraps_longitude();
    return grid.lon.at_deg(twin || at_pole(grid, row) ? 0 : column);
}

double row_lat_deg(const PostGrid& grid, std::int64_t row) {
    const double lat_deg = grid.lat.at_deg(row);
    return std::abs(std::abs(lat_deg) - 90.0) < 1.0e-9 ? std::copysign(90.0, lat_deg) : lat_deg;
}

double drawn_h_m(const HeightField& field, int row, int column, double exaggeration) {
    const float H_m = field.H_at_post_m(row, canonical_column(field, row, column));
    if (field.grid.net)
        return height_steps(static_cast<double>(H_m) * exaggeration + field.N_at_post_m(row, column)) *
               height_step_m;
    const double N_m =
        field.undulation.at_m(row_lat_deg(field.grid, row), canonical_lon_deg(field.grid, row, column));
    return height_steps(static_cast<double>(H_m) * exaggeration + N_m) * height_step_m;
}

// Posts of a row that are points of their own.
ORO_WIDE void lift_row(std::size_t count, const float* H_m, const double* N_m, double exaggeration,
                       std::int32_t* steps) {
    for (std::size_t i = 0; i < count; ++i) {
        const double h_m = static_cast<double>(H_m[i]) * exaggeration + N_m[i];
        const std::int32_t lifted = rounded_steps(h_m);
        steps[i] = is_void(H_m[i]) ? void_height_steps : lifted;
    }
}
ORO_WIDE void between_rows(const std::vector<double>& north, const std::vector<double>& south, double share,
                           std::vector<double>& N_m) {
    for (std::size_t i = 0; i < N_m.size(); ++i) N_m[i] = (1.0 - share) * north[i] + share * south[i];
}

namespace {

// N of row after row of posts, by the same steps as UndulationField::at_m(): between the columns of its nodes
// once for many rows. columns: of the posts; none where N is 0.
class UndulationRows {
  public:
    UndulationRows(const HeightField& field, const std::vector<UndulationField::Between>& columns)
        : field_(field),
          columns_(columns),
          north_m_(columns.size()),
          south_m_(columns.size()),
          N_m_(static_cast<std::size_t>(field.grid.columns()), 0.0) {}
    const double* row(int number) {
        if (columns_.empty()) return N_m_.data();
        const UndulationField::Between at = field_.undulation.row_between(row_lat_deg(field_.grid, number));
        if (at.first != first_) {
            first_ = at.first;
            for (std::size_t i = 0; i < columns_.size(); ++i) {
                north_m_[i] = field_.undulation.at_m({first_, 0.0}, columns_[i]);
                south_m_[i] = field_.undulation.at_m({first_, 1.0}, columns_[i]);
            }
        }
        between_rows(north_m_, south_m_, at.share, N_m_);
        return N_m_.data();
    }

  private:
    const HeightField& field_;
    const std::vector<UndulationField::Between>& columns_;
    std::vector<double> north_m_, south_m_, N_m_;
    int first_{-1};
};

std::int32_t drawn_steps(const HeightField& field, int row, int column, double exaggeration) {
    if (is_void(field.H_at_post_m(row, column))) return void_height_steps;
    return height_steps(drawn_h_m(field, row, column, exaggeration));
}

}  // namespace

DrawnHeights drawn_heights(const HeightField& field, double exaggeration, int threads) {
    const PostGrid& grid = field.grid;
    DrawnHeights heights;
    heights.rows = grid.rows();
    heights.columns = grid.columns();
    heights.steps.resize(grid.post_count());
    std::vector<UndulationField::Between> columns;
    const bool has_N = !field.undulation.N_m.empty() && !grid.net;
    for (int column = 0; has_N && column < grid.columns(); ++column)
        columns.push_back(field.undulation.column_between(grid.lon.at_deg(column)));
    constexpr int band_rows = 64;
    in_parallel((grid.rows() + band_rows - 1) / band_rows, threads, [&](int band) {
        UndulationRows undulation(field, columns);
        std::vector<float> read(field.posts ? static_cast<std::size_t>(grid.columns()) : 0);
        for (int row = band * band_rows; row < std::min((band + 1) * band_rows, grid.rows()); ++row) {
            const std::size_t first =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns());
            std::int32_t* const steps = &heights.steps[first];
            // A row of points of their own, but for the last, which may be the first.
            const int own = grid.net || at_pole(grid, row) ? 0 : grid.columns() - 1;
            for (int column = 0; field.posts && column < own; ++column)
                read[static_cast<std::size_t>(column)] = field.posts->H_m(row, column);
            lift_row(static_cast<std::size_t>(own), field.posts ? read.data() : &field.H_m[first],
                     undulation.row(row), exaggeration, steps);
            for (int column = own; column < grid.columns(); ++column)
                steps[column] = drawn_steps(field, row, column, exaggeration);
        }
    });
    heights.diagonals = CellDiagonals::of(field, threads);
    if (!heights.steps.empty())
        heights.highest_steps = *std::max_element(heights.steps.begin(), heights.steps.end());
    return heights;
}

Ecef post_ecef(const HeightField& field, int row, int column, double exaggeration) {
    assert(!is_void(field.H_at_post_m(row, column)));
    if (field.grid.net)
        return ecef_along(field.grid.net->normal_at(row, column),
                          drawn_h_m(field, row, column, exaggeration));
    return ecef_from_geodetic({row_lat_deg(field.grid, row), canonical_lon_deg(field.grid, row, column),
                               drawn_h_m(field, row, column, exaggeration)});
}

}  // namespace oro

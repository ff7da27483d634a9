#include "geo/region/region_fingerprints.h"

#include <array>
#include <cmath>
#include <vector>

namespace oro {
namespace {

// Angles and spacings as whole numbers: what two files of the same posts differ by is far below half of one.
void add_axis(RunningChecksum& sum, const GridAxis& axis, int first, int count) {
    constexpr double parts_of_a_degree = 1e7, parts_of_a_post = 1e3;
    const std::array<std::int64_t, 3> place{std::llround(axis.at_deg(first) * parts_of_a_degree),
                                            std::llround(axis.posts_per_deg * parts_of_a_post), count};
    sum.add(std::as_bytes(std::span(place)));
}

// Of a net: where four of its posts lie, and how many there are.
void add_net(RunningChecksum& sum, const LatticeGeoreference& net) {
    constexpr double parts_of_a_degree = 1e7;
    for (const double row : {0.0, net.rows() - 1.0}) {
        for (const double column : {0.0, net.columns() - 1.0}) {
            const PostPlace place = net.place_at(row, column);
            const std::array<std::int64_t, 2> whole{std::llround(place.lat_deg * parts_of_a_degree),
                                                    std::llround(place.lon_deg * parts_of_a_degree)};
            sum.add(std::as_bytes(std::span(whole)));
        }
    }
    const std::array<std::int64_t, 2> counts{net.rows(), net.columns()};
    sum.add(std::as_bytes(std::span(counts)));
}

void add_grid(RunningChecksum& sum, const PostGrid& grid) {
    if (grid.net) return add_net(sum, *grid.net);
    add_axis(sum, grid.lat, 0, grid.rows());
    add_axis(sum, grid.lon, 0, grid.columns());
}

}  // namespace

void SourceFingerprint::begin(const PostGrid& grid, int first_row, int first_column, int rows, int columns) {
    if (grid.net) return add_net(sum_, *grid.net);
    add_axis(sum_, grid.lat, first_row, rows);
    add_axis(sum_, grid.lon, first_column, columns);
}

std::uint64_t grid_fingerprint(const PostGrid& grid) {
    RunningChecksum sum;
    add_grid(sum, grid);
    return sum.sum();
}

std::uint64_t posts_hash(const HeightField& field) {
    RunningChecksum sum;
    add_grid(sum, field.grid);
    if (!field.posts) {
        sum.add(std::as_bytes(std::span(field.H_m)));
        return sum.sum();
    }
    std::vector<float> H_m(static_cast<std::size_t>(field.grid.columns()));
    for (int row = 0; row < field.grid.rows(); ++row) {
        for (int column = 0; column < field.grid.columns(); ++column)
            H_m[static_cast<std::size_t>(column)] = field.H_at_post_m(row, column);
        sum.add(std::as_bytes(std::span(H_m)));
    }
    return sum.sum();
}

std::uint64_t undulation_fingerprint(const UndulationField& undulation) {
    RunningChecksum sum;
    if (undulation.N_m.empty()) return sum.sum();
    add_axis(sum, undulation.lat, 0, undulation.lat.count);
    add_axis(sum, undulation.lon, 0, undulation.lon.count);
    sum.add(std::as_bytes(std::span(undulation.N_m)));
    return sum.sum();
}

}  // namespace oro

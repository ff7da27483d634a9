#include "core/terrain/page_on_net.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/parallel.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

constexpr int quads = static_cast<int>(gpu::page_quads);
constexpr int posts = static_cast<int>(gpu::page_posts);

}  // namespace

PostPlace net_page_middle(const PostGrid& grid, const PageIndex& index) {
    const LevelGrid level = level_grid(grid, index.level);
    const auto middle = [](const LevelAxis& axis, int page) {
        return 0.5 * (axis.region_post(page * quads) +
                      axis.region_post(std::min(page * quads + quads, axis.quads)));
    };
    return grid.net->place_at(middle(level.row, index.row), middle(level.column, index.column));
}

LatticePoint lattice_point(const glm::dvec3& ecef_m) {
    LatticePoint point{};
    for (int axis = 0; axis < 3; ++axis)
        point.steps[static_cast<std::size_t>(axis)] = std::llround(ecef_m[axis] / height_step_m);
    return point;
}

namespace {

using Steps = std::array<std::int64_t, 3>;

// Of (rows + 1) x (columns + 1) places: the plane along which they lie, and their distance from it is as
// small on either side.
struct PlaneOfPlaces {
    int middle_row{}, middle_column{};
    Steps row_step{}, column_step{}, middle{};

    [[nodiscard]] std::int64_t steps(int row, int column, std::size_t axis) const {
        return middle[axis] + (row - middle_row) * row_step[axis] +
               (column - middle_column) * column_step[axis];
    }
};

// at(row, column): lattice points on the ellipsoid, from any one origin.
template <class At>
PlaneOfPlaces plane_of(int rows, int columns, const At& at) {
    constexpr int looks = 16;
    PlaneOfPlaces plane;
    plane.middle_row = rows / 2;
    plane.middle_column = columns / 2;
    const Steps north = at(0, plane.middle_column), south = at(rows, plane.middle_column),
                west = at(plane.middle_row, 0), east = at(plane.middle_row, columns);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        plane.row_step[axis] = (south[axis] - north[axis]) / std::max(rows, 1);
        plane.column_step[axis] = (east[axis] - west[axis]) / std::max(columns, 1);
    }
    Steps lowest, highest;
    lowest.fill(std::numeric_limits<std::int64_t>::max());
    highest.fill(std::numeric_limits<std::int64_t>::lowest());
    for (int i = 0; i <= looks; ++i) {
        for (int j = 0; j <= looks; ++j) {
            const int row = rows * i / looks, column = columns * j / looks;
            const Steps there = at(row, column);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::int64_t off = there[axis] - plane.steps(row, column, axis);
                lowest[axis] = std::min(lowest[axis], off);
                highest[axis] = std::max(highest[axis], off);
            }
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) plane.middle[axis] = (lowest[axis] + highest[axis]) / 2;
    return plane;
}

// The plane of a page's posts, from its origin.
PlaneOfPlaces plane_of_page(const PostGrid& grid, const PageSummary& page, const LatticePoint& origin) {
    const LevelGrid level = level_grid(grid, page.index.level);
    const int first_row = page.index.row * quads, first_column = page.index.column * quads;
    return plane_of(std::min(quads, level.row.quads - first_row),
                    std::min(quads, level.column.quads - first_column), [&](int row, int column) {
                        const glm::dvec3 normal =
                            grid.net->normal_at(level.row.region_post(first_row + row),
                                                level.column.region_post(first_column + column));
                        Steps at = lattice_point(ecef_along(normal, 0.0).m).steps;
                        for (std::size_t axis = 0; axis < 3; ++axis) at[axis] -= origin.steps[axis];
                        return at;
                    });
}

bool fits_32_bits(std::int64_t steps) {
    return std::abs(steps) < std::int64_t{1} << 31U;
}

bool put_plane(const PlaneOfPlaces& plane, gpu::PagePlaces& places) {
    bool fits = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        fits = fits && fits_32_bits(plane.row_step[axis]) && fits_32_bits(plane.column_step[axis]) &&
               fits_32_bits(plane.middle[axis]);
        places.row_step[axis] = static_cast<std::int32_t>(plane.row_step[axis]);
        places.column_step[axis] = static_cast<std::int32_t>(plane.column_step[axis]);
        places.middle[axis] = static_cast<std::int32_t>(plane.middle[axis]);
    }
    places.middle_row = plane.middle_row;
    places.middle_column = plane.middle_column;
    return fits;
}

}  // namespace

bool reaches_far(const PageSummary& page) {
    constexpr double most_m = 1.04e6;
    return glm::length(page.centre_m) + page.radius_m > most_m;
}

bool fits_one_page(const LatticeGeoreference& net) {
    constexpr double most_m = 1.03e6;  // 2^31 steps, less what heights add
    constexpr int side = 64;
    const auto at = [&](int row, int column) {
        return lattice_point(ecef_along(net.normal_at((net.rows() - 1.0) * row / side,
                                                      (net.columns() - 1.0) * column / side),
                                        0.0)
                                 .m)
            .steps;
    };
    const PlaneOfPlaces plane = plane_of(side, side, at);
    // A page has twice as many posts along a side, or nearly so.
    const double step_max_m = most_m * 2.0;
    for (int row = 0; row <= side; ++row)
        for (int column = 0; column <= side; ++column)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto off = static_cast<double>(at(row, column)[axis] - plane.steps(row, column, axis));
                if (std::abs(off) * height_step_m > most_m) return false;
            }
    return std::ranges::all_of(plane.row_step,
                               [&](std::int64_t step) {
                                   return std::abs(static_cast<double>(step)) * height_step_m < step_max_m;
                               }) &&
           std::ranges::all_of(plane.column_step, [&](std::int64_t step) {
               return std::abs(static_cast<double>(step)) * height_step_m < step_max_m;
           });
}

bool fill_places(const PostGrid& grid, const PageSummary& page, const PageHeights& heights,
                 gpu::PagePlaces& places) {
    const LatticePoint origin = lattice_point(page.origin_ecef.m);
    PlaneOfPlaces plane;
    if (reaches_far(page)) plane = plane_of_page(grid, page, origin);
    std::fill(std::begin(places.steps), std::end(places.steps), 0);
    bool fits = put_plane(plane, places);
    for_each_normal(grid, page.index, [&](int i, int j, const glm::dvec3& normal) {
        const std::int32_t height =
            heights.steps[static_cast<std::size_t>((i + 1) * static_cast<int>(gpu::height_stride) + j + 1)];
        if (height == void_height_steps) return;
        const LatticePoint at = lattice_point(ecef_along(normal, height * height_step_m).m);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t off = at.steps[axis] - origin.steps[axis] - plane.steps(i, j, axis);
            fits = fits && fits_32_bits(off);
            places.steps[static_cast<std::size_t>(i * posts + j) * 3 + axis] = static_cast<std::int32_t>(off);
        }
    });
    return fits;
}

int undulation_step(const PostGrid& grid) {
    constexpr int most_nodes = 512;  // along a side
    int step = 1;
    while (std::max(grid.rows(), grid.columns()) / step >= most_nodes) step *= 2;
    return step;
}

namespace {

// N at a post, or straight on beyond the last row and column.
double N_beyond_m(const HeightField& field, int row, int column) {
    const int last_row = field.grid.rows() - 1, last_column = field.grid.columns() - 1;
    const int r = std::min(row, last_row), c = std::min(column, last_column);
    const double here_m = field.N_at_post_m(r, c);
    double there_m = here_m;
    if (row > r) there_m += (row - r) * (here_m - field.N_at_post_m(std::max(r - 1, 0), c));
    if (column > c) there_m += (column - c) * (here_m - field.N_at_post_m(r, std::max(c - 1, 0)));
    return there_m;
}

}  // namespace

UndulationField drawn_undulation(const HeightField& field) {
    UndulationField nodes;
    if (field.N_of_posts_m.empty() && field.undulation.N_m.empty()) return nodes;
    const PostGrid& grid = field.grid;
    const int step = undulation_step(grid);
    nodes.lat.count = (grid.rows() + step - 2) / step + 1;
    nodes.lon.count = (grid.columns() + step - 2) / step + 1;
    const auto columns = static_cast<std::size_t>(nodes.lon.count);
    nodes.N_m.resize(static_cast<std::size_t>(nodes.lat.count) * columns);
    in_parallel(nodes.lat.count, thread_count(), [&](int i) {
        for (std::size_t j = 0; j < columns; ++j)
            nodes.N_m[static_cast<std::size_t>(i) * columns + j] =
                static_cast<float>(N_beyond_m(field, i * step, static_cast<int>(j) * step));
    });
    return nodes;
}

void set_net_spacing(const LatticeGeoreference& net, const PageSummary& page, gpu::PageBlock& block) {
    const PostNumber middle = net.post_at(page.origin.lat_deg, page.origin.lon_deg);
    const LatticeGeoreference::LatticeFrame local_frame = net.local_frame_at(middle.row, middle.column);
    const double higher = 1.0 + page.origin.h_m / wgs84_a_m;
    block.row_spacing_m = static_cast<float>(local_frame.row_m * higher);
    block.column_spacing_m = static_cast<float>(local_frame.column_m * higher);
    const double step = std::ldexp(1.0, page.index.level);
    const auto change = [&](double down, double right) {
        const LatticeGeoreference::LatticeFrame next_frame =
            net.local_frame_at(middle.row + down, middle.column + right);
        return static_cast<float>(
            std::remainder(next_frame.turn_rad - local_frame.turn_rad, 2.0 * std::numbers::pi));
    };
    // Numbers of the page's own posts, from its first.
    const double first_row = static_cast<double>(page.index.row) * quads * step,
                 first_column = static_cast<double>(page.index.column) * quads * step;
    const float by_row = change(step, 0.0), by_column = change(0.0, step);
    const auto row = static_cast<float>((middle.row - first_row) / step),
               column = static_cast<float>((middle.column - first_column) / step);
    block.turn = gpu::vec3(static_cast<float>(local_frame.turn_rad) - by_row * row - by_column * column,
                           by_row, by_column);
}

}  // namespace oro

#include "core/net/page_on_net.h"

#include <algorithm>
#include <cmath>
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

bool fill_places(const PostGrid& grid, const PageSummary& page, const PageHeights& heights,
                 gpu::PagePlaces& places) {
    const LatticePoint origin = lattice_point(page.origin_ecef.m);
    std::fill(std::begin(places.steps), std::end(places.steps), 0);
    bool fits = true;
    for_each_normal(grid, page.index, [&](int i, int j, const glm::dvec3& normal) {
        const std::int32_t height =
            heights.steps[static_cast<std::size_t>((i + 1) * static_cast<int>(gpu::height_stride) + j + 1)];
        if (height == void_height_steps) return;
        const LatticePoint at = lattice_point(ecef_along(normal, height * height_step_m).m);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t from_origin = at.steps[axis] - origin.steps[axis];
            fits = fits && std::abs(from_origin) < std::int64_t{1} << 31U;
            places.steps[static_cast<std::size_t>(i * posts + j) * 3 + axis] =
                static_cast<std::int32_t>(from_origin);
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

void set_net_spacing(const GridNet& net, const PageSummary& page, gpu::PageBlock& block) {
    const PostNumber middle = net.post_at(page.origin.lat_deg, page.origin.lon_deg);
    const GridNet::Lie lie = net.lie_at(middle.row, middle.column);
    const double higher = 1.0 + page.origin.h_m / wgs84_a_m;
    block.row_spacing_m = static_cast<float>(lie.row_m * higher);
    block.column_spacing_m = static_cast<float>(lie.column_m * higher);
    const double step = std::ldexp(1.0, page.index.level);
    const auto change = [&](double down, double right) {
        const GridNet::Lie beside = net.lie_at(middle.row + down, middle.column + right);
        return static_cast<float>(std::remainder(beside.turn_rad - lie.turn_rad, 2.0 * std::numbers::pi));
    };
    // Numbers of the page's own posts, from its first.
    const double first_row = static_cast<double>(page.index.row) * quads * step,
                 first_column = static_cast<double>(page.index.column) * quads * step;
    const float by_row = change(step, 0.0), by_column = change(0.0, step);
    const auto row = static_cast<float>((middle.row - first_row) / step),
               column = static_cast<float>((middle.column - first_column) / step);
    block.turn =
        gpu::vec3(static_cast<float>(lie.turn_rad) - by_row * row - by_column * column, by_row, by_column);
}

}  // namespace oro

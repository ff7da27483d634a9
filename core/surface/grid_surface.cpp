#include "core/surface/grid_surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>

#include "shaders/shared.h"

namespace oro {
namespace {

// Posts on an edge may count as within: rounding is far below what lies between a post and an edge beside it.
constexpr double on_edge_posts = 1.0e-7;
constexpr int node_side = static_cast<int>(gpu::meshlet_quads);

}  // namespace

GridSurface::GridSurface(const DrawnHeights& heights, const GridWindow& window)
    : heights_(heights), window_(window), sw_ne_(heights.steps.size(), 0) {
    assert(window.first_row % static_cast<int>(gpu::meshlet_quads) == 0);
    assert(window.first_column % static_cast<int>(gpu::meshlet_quads) == 0);
    for (int row = 0; heights.diagonals && row < heights.rows - 1; ++row) {
        for (int column = 0; column < heights.columns - 1; ++column)
            sw_ne_[static_cast<std::size_t>(row) * static_cast<std::size_t>(heights.columns) +
                   static_cast<std::size_t>(column)] =
                heights.diagonal(0, row, column) == Diagonal::sw_ne ? 1 : 0;
    }
}

bool GridSurface::is_window() const {
    return window_.north_open || window_.east_open || window_.south_open || window_.west_open;
}

bool GridSurface::is_open(VertexNumber number) const {
    const auto columns = static_cast<VertexNumber>(heights_.columns);
    const auto row = static_cast<int>(number / columns), column = static_cast<int>(number % columns);
    return (window_.north_open && row == 0) || (window_.south_open && row == heights_.rows - 1) ||
           (window_.west_open && column == 0) || (window_.east_open && column == heights_.columns - 1);
}

bool GridSurface::must_stay(VertexNumber number) const {
    const auto column = static_cast<int>(number % static_cast<VertexNumber>(heights_.columns));
    return window_.wraps_longitude && (column == 0 || column == heights_.columns - 1);
}

SurfaceVertex GridSurface::vertex(VertexNumber number) const {
    const auto columns = static_cast<VertexNumber>(heights_.columns);
    return {window_.first_row + static_cast<std::int32_t>(number / columns),
            window_.first_column + static_cast<std::int32_t>(number % columns), heights_.steps[number]};
}

// side 0: that with the cell's western edge, 1: that with its eastern one. Clockwise on the map.
VertexTriangle GridSurface::triangle_of(int row, int column, int side) const {
    const auto columns = static_cast<VertexNumber>(heights_.columns);
    const VertexNumber north_west =
        static_cast<VertexNumber>(row) * columns + static_cast<VertexNumber>(column);
    const VertexNumber south_east = north_west + columns + 1;
    if (sw_ne_[north_west] != 0)
        return side == 0 ? VertexTriangle{north_west, north_west + 1, north_west + columns}
                         : VertexTriangle{north_west + columns, north_west + 1, south_east};
    if (side == 0) return {north_west, south_east, north_west + columns};
    return {north_west, north_west + 1, south_east};
}

bool GridSurface::triangle_there(const VertexTriangle& triangle) const {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](VertexNumber number) { return heights_.steps[number] != void_height_steps; });
}

std::uint32_t GridSurface::nodes_across() const {
    return static_cast<std::uint32_t>((heights_.columns - 1 + node_side - 1) / node_side);
}

template <class Take>
void GridSurface::each_of_leaf(std::uint32_t node, const Take& take) const {
    const int north = static_cast<int>(node / nodes_across()) * node_side;
    const int west = static_cast<int>(node % nodes_across()) * node_side;
    for (int row = north; row < std::min(north + node_side, heights_.rows - 1); ++row) {
        for (int column = west; column < std::min(west + node_side, heights_.columns - 1); ++column) {
            for (const int half : {0, 1}) {
                const VertexTriangle triangle = triangle_of(row, column, half);
                if (triangle_there(triangle) && !take(triangle)) return;
            }
        }
    }
}

std::vector<std::uint32_t> GridSurface::leaf_nodes() const {
    const std::uint32_t down = static_cast<std::uint32_t>((heights_.rows - 1 + node_side - 1) / node_side);
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t node = 0; node < down * nodes_across(); ++node) {
        bool is_there = false;
        each_of_leaf(node, [&](const VertexTriangle&) {
            is_there = true;
            return false;
        });
        if (is_there) nodes.push_back(node);
    }
    return nodes;
}

std::vector<VertexTriangle> GridSurface::leaf(std::uint32_t node) const {
    std::vector<VertexTriangle> triangles;
    each_of_leaf(node, [&](const VertexTriangle& triangle) {
        triangles.push_back(triangle);
        return true;
    });
    return triangles;
}

std::vector<std::vector<VertexTriangle>> GridSurface::leaves() const {
    std::vector<std::vector<VertexTriangle>> leaves;
    for (const std::uint32_t node : leaf_nodes()) leaves.push_back(leaf(node));
    return leaves;
}

// At the places where the way from one vertex to another meets lines of the grid of one kind (rows, columns
// or diagonals): whole numbers tell which post it has passed and how far it is from it.
double GridSurface::crossing_difference(const SurfaceVertex& from, const SurfaceVertex& to,
                                        const Lines& lines, double limit) const {
    const std::int64_t down = to.row - from.row, right = to.column - from.column;
    const double share = 1.0 / lines.count;
    const double rise = share * (static_cast<double>(to.steps) - from.steps);
    double largest = 0.0;
    // Post numbers after whole steps, and what is left of them in shares of `count`.
    const bool by_row = lines.along == 1;  // along a row: the column is what is left
    const std::int64_t moved = by_row ? right : down;
    std::int64_t whole = moved / lines.count, rest = moved % lines.count;
    if (rest < 0) {
        rest += lines.count;
        --whole;
    }
    const std::int64_t columns = heights_.columns;
    // A step across the lines, and the posts passed along them.
    std::ptrdiff_t across;
    if (by_row)
        across = down > 0 ? columns : -columns;
    else if (lines.along == columns)
        across = right > 0 ? 1 : -1;
    else if (lines.sw_ne == 0)
        across = right - down > 0 ? 1 : -1;  // a diagonal's post of the same row
    else
        across = right + down > 0 ? 1 : -1;
    const std::ptrdiff_t whole_step = across + whole * lines.along;
    const std::int32_t* passed = post(from.row, from.column);
    std::int64_t left = 0;
    for (int i = 1; i < lines.count; ++i) {
        passed += whole_step;
        left += rest;
        if (left >= lines.count) {
            left -= lines.count;
            passed += lines.along;
        }
        if (lines.diagonals && left != 0 && sw_ne(passed + lines.cell) != lines.sw_ne) continue;
        double original = *passed;
        if (left != 0)
            original +=
                share * static_cast<double>(left) * (static_cast<double>(passed[lines.along]) - *passed);
        largest = std::max(largest, std::abs(original - (from.steps + i * rise)));
        if (largest > limit) return largest;
    }
    return largest;
}

double GridSurface::edge_difference(const SurfaceVertex& from, const SurfaceVertex& to, double limit) const {
    const int down = to.row - from.row, right = to.column - from.column;
    const int rows = std::abs(down), columns = std::abs(right);
    const int falling = std::abs(right - down), rising = std::abs(right + down);
    if (rows <= 1 && columns <= 1) {
        if (rows + columns < 2) return 0.0;  // along a row or a column
        const bool sw_ne_there =
            sw_ne(post(std::min(from.row, to.row), std::min(from.column, to.column))) != 0;
        if (sw_ne_there == (rising == 0)) return 0.0;  // the cell's own diagonal
        const double crossed = static_cast<double>(*post(from.row, to.column)) + *post(to.row, from.column);
        return 0.5 * std::abs(crossed - (static_cast<double>(from.steps) + to.steps));
    }
    double largest = 0.0;
    if (rows > 1) largest = crossing_difference(from, to, {rows, 1}, limit);
    if (columns > 1 && largest <= limit)
        largest = std::max(largest, crossing_difference(from, to, {columns, heights_.columns}, limit));
    if (falling > 1 && largest <= limit)
        largest = std::max(largest,
                           crossing_difference(from, to, {falling, heights_.columns + 1, 0, 0, true}, limit));
    if (heights_.diagonals && rising > 1 && largest <= limit)
        largest = std::max(largest,
                           crossing_difference(from, to, {rising, heights_.columns - 1, -1, 1, true}, limit));
    return largest;
}

double GridSurface::inner_difference(const SurfaceVertex& a, const SurfaceVertex& b, const SurfaceVertex& c,
                                     double limit) const {
    const std::int64_t area = twice_area(a, b, c);
    if (area <= 2) return 0.0;  // by Pick's theorem no post is within
    const double rise_b = static_cast<double>(b.steps) - a.steps,
                 rise_c = static_cast<double>(c.steps) - a.steps;
    const double share = 1.0 / static_cast<double>(area);
    const double per_column = share * ((c.row - a.row) * rise_b - (b.row - a.row) * rise_c);
    const double per_row = share * ((b.column - a.column) * rise_c - (c.column - a.column) * rise_b);
    const SurfaceVertex *top = &a, *middle = &b, *bottom = &c;
    if (middle->row < top->row) std::swap(top, middle);
    if (bottom->row < middle->row) std::swap(middle, bottom);
    if (middle->row < top->row) std::swap(top, middle);
    const auto slope = [](const SurfaceVertex& from, const SurfaceVertex& to) {
        return to.row == from.row ? 0.0 : static_cast<double>(to.column - from.column) / (to.row - from.row);
    };
    const double through = slope(*top, *bottom), upper = slope(*top, *middle),
                 lower = slope(*middle, *bottom);
    double lowest = 0.0, highest = 0.0;
    for (int row = top->row + 1; row < bottom->row; ++row) {
        const double one = top->column + through * (row - top->row);
        const double other = row < middle->row ? top->column + upper * (row - top->row)
                                               : middle->column + lower * (row - middle->row);
        const int first = static_cast<int>(std::ceil(std::min(one, other) - on_edge_posts));
        const int last = static_cast<int>(std::floor(std::max(one, other) + on_edge_posts));
        const std::int32_t* steps = post(row, first);
        const double plane = a.steps + per_row * (row - a.row) - per_column * a.column;
        for (int column = first; column <= last; ++column) {
            const double off = steps[column - first] - (plane + per_column * column);
            lowest = std::min(lowest, off);
            highest = std::max(highest, off);
        }
        if (std::max(-lowest, highest) > limit) break;
    }
    return std::max(-lowest, highest);
}

}  // namespace oro

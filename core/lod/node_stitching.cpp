// The part of NodeDeviations that is about single triangles and edges beside a coarser node.
#include <algorithm>
#include <bit>
#include <cmath>

#include "core/earth/extremes.h"
#include "core/lod/levels_gpu.h"
#include "core/lod/node_deviations.h"

namespace oro {
namespace {

constexpr int node_quads = static_cast<int>(gpu::meshlet_quads);

}  // namespace

// Every triangle that some combination of stitched edges has and the node without them has not. One edge
// changes the triangles along it; two change others only where they meet, so all pairs are gone through, and
// all four together for nodes so narrow that opposite edges meet.
std::vector<NodeDeviations::Stitched> NodeDeviations::stitched_triangles(std::uint32_t rows,
                                                                         std::uint32_t columns,
                                                                         std::uint32_t edges) {
    std::vector<Stitched> found;
    const auto known = [&](const Stitched& candidate) {
        return std::any_of(found.begin(), found.end(), [&](const Stitched& other) {
            return other.posts == candidate.posts && (other.edges & candidate.edges) == other.edges;
        });
    };
    for (std::uint32_t mask = 1; mask < 16; ++mask) {
        if ((mask & edges) != mask) continue;
        for (std::uint32_t i = 0; i < 2 * rows * columns; ++i) {
            const std::uint32_t row = i / 2 / columns;
            const std::uint32_t column = i / 2 % columns;
            const std::uint32_t side = i % 2;
            const std::array<glm::uvec2, 3> plain{
                glm::uvec2{row, column}, {row + 1 - side, column + side}, {row + 1, column + 1}};
            Stitched candidate{mask, {}};
            bool changed = false;
            std::array<glm::ivec2, 3> at;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const glm::uvec2 to = gpu::stitched_post(plain[corner], {rows, columns}, mask);
                changed = changed || to != plain[corner];
                candidate.posts[corner] = {to.x, to.y};
                at[corner] = glm::ivec2(to);
            }
            const glm::ivec2 a = at[1] - at[0];
            const glm::ivec2 b = at[2] - at[0];
            if (!changed || a.x * b.y == a.y * b.x || known(candidate)) continue;
            found.push_back(candidate);
        }
    }
    return found;
}

// Largest difference along an edge of a triangle that is none of the full-resolution surface's, in steps:
// where it crosses that surface's edges.
double NodeDeviations::crossing_deviation(const Post& from, const Post& to) const {
    const int down = to.row - from.row;
    const int right = to.column - from.column;
    if (down == 0 || right == 0 || down == right) return 0.0;
    const double h0 = heights_.at(from.row, from.column);
    const double h1 = heights_.at(to.row, to.column);
    Extremes extremes;
    bool beside_void = false;
    // The place at share t of the edge lies on the full-resolution edge from a post to its neighbour (dr,
    // dc).
    const auto compare = [&](double t, int row, int column, double share, int dr, int dc) {
        beside_void = beside_void || heights_.at(row, column) == void_height_steps ||
                      heights_.at(row + dr, column + dc) == void_height_steps;
        const double h =
            (1.0 - share) * heights_.at(row, column) + share * heights_.at(row + dr, column + dc);
        extremes.add(h - (h0 + t * (h1 - h0)));
    };
    const int step_down = down > 0 ? 1 : -1;
    for (int i = step_down; i != down; i += step_down) {
        const double t = static_cast<double>(i) / down;
        const double column = from.column + t * right;
        const int west = static_cast<int>(std::floor(column));
        if (column > west) compare(t, from.row + i, west, column - west, 0, 1);
    }
    const int step_right = right > 0 ? 1 : -1;
    for (int i = step_right; i != right; i += step_right) {
        const double t = static_cast<double>(i) / right;
        const double row = from.row + t * down;
        const int north = static_cast<int>(std::floor(row));
        if (row > north) compare(t, north, from.column + i, row - north, 1, 0);
    }
    const int across = right - down;
    const int step_across = across > 0 ? 1 : -1;
    for (int i = step_across; i != across; i += step_across) {
        const double t = static_cast<double>(i) / across;
        const double row = from.row + t * down;
        const int north = static_cast<int>(std::floor(row));
        const int west = north + from.column - from.row + i;
        if (row > north) compare(t, north, west, row - north, 1, 1);
    }
    // That surface is not there on either side of an edge that ends in a void post.
    return beside_void ? unfit_m : extremes.magnitude();
}

// Largest difference over a triangle, in steps; infinite when a post in it is void.
double NodeDeviations::triangle_deviation(const Triangle& triangle) const {
    const auto& [a, b, c] = triangle;
    const double h = heights_.at(a.row, a.column);
    const double hb = heights_.at(b.row, b.column) - h;
    const double hc = heights_.at(c.row, c.column) - h;
    const int br = b.row - a.row, bc = b.column - a.column, cr = c.row - a.row, cc = c.column - a.column;
    const double area = static_cast<double>(br) * cc - static_cast<double>(cr) * bc;
    const double per_row = (hb * cc - hc * bc) / area;
    const double per_column = (hc * br - hb * cr) / area;
    Extremes extremes;
    for (int row = std::min({a.row, b.row, c.row}); row <= std::max({a.row, b.row, c.row}); ++row) {
        double west = std::numeric_limits<double>::infinity();
        double east = -west;
        const auto widen = [&](double column) {
            west = std::min(west, column);
            east = std::max(east, column);
        };
        for (std::size_t i = 0; i < 3; ++i) {
            const Post& p = triangle[i];
            const Post& q = triangle[(i + 1) % 3];
            if (p.row == row) widen(p.column);
            if ((p.row < row) != (q.row < row) && p.row != row && q.row != row)
                widen(p.column + static_cast<double>(row - p.row) * (q.column - p.column) / (q.row - p.row));
        }
        const std::int32_t* steps = heights_.row(row);
        const double in_row = h + per_row * (row - a.row);
        const int last = static_cast<int>(std::floor(east + 1.0e-9));
        for (int column = static_cast<int>(std::ceil(west - 1.0e-9)); column <= last; ++column) {
            if (steps[column] == void_height_steps) return unfit_m;
            extremes.add(steps[column] - (in_row + per_column * (column - a.column)));
        }
    }
    return std::max(
        {extremes.magnitude(), crossing_deviation(a, b), crossing_deviation(b, c), crossing_deviation(c, a)});
}

// Stitching joins two quads of an edge: with voids it keeps the covered area only where both are wholly
// covered or both are not at all. The edges, as bits, where that is not so.
std::uint32_t NodeDeviations::unfit_edges(const std::array<Cover, 64>& covers, int rows, int columns) {
    std::uint32_t unfit = 0;
    const auto join = [&](std::uint32_t edge, int row, int column, int next_row, int next_column) {
        const Cover cover = covers[static_cast<std::size_t>(row * node_quads + column)];
        const Cover next = covers[static_cast<std::size_t>(next_row * node_quads + next_column)];
        if (cover != next || (cover != Cover::full && cover != Cover::empty)) unfit |= edge;
    };
    for (int i = 0; i + 1 < columns; i += 2) {
        join(gpu::edge_north, 0, i, 0, i + 1);
        join(gpu::edge_south, rows - 1, i, rows - 1, i + 1);
    }
    for (int i = 0; i + 1 < rows; i += 2) {
        join(gpu::edge_west, i, 0, i + 1, 0);
        join(gpu::edge_east, i, columns - 1, i + 1, columns - 1);
    }
    return unfit;
}

// In steps; infinite where a triangle is drawn over voids.
PerEdge NodeDeviations::stitched_deviation(int node_row, int node_column, std::uint32_t edges) const {
    const int rows = level_.row.quads_of_node(node_row);
    const int columns = level_.column.quads_of_node(node_column);
    const bool whole = rows == node_quads && columns == node_quads;
    const std::vector<Stitched> own = whole ? std::vector<Stitched>{}
                                            : stitched_triangles(static_cast<std::uint32_t>(rows),
                                                                 static_cast<std::uint32_t>(columns), edges);
    PerEdge deviation{};
    for (const Stitched& stitched : whole ? whole_node_ : own) {
        if ((stitched.edges & edges) != stitched.edges) continue;
        Triangle triangle;
        bool dropped = false;
        for (std::size_t i = 0; i < 3; ++i) {
            triangle[i] = {
                level_.row.region_post(node_row * node_quads + static_cast<int>(stitched.posts[i][0])),
                level_.column.region_post(node_column * node_quads + static_cast<int>(stitched.posts[i][1]))};
            dropped = dropped || heights_.at(triangle[i].row, triangle[i].column) == void_height_steps;
        }
        double& of_edge = deviation[static_cast<std::size_t>(std::countr_zero(stitched.edges))];
        if (!dropped) of_edge = std::max(of_edge, triangle_deviation(triangle));
    }
    return deviation;
}

// The same for a whole node of level 0 without voids, where only two places of a pair of quads can be the
// worst: the post that is left out, and the one crossing of an edge that is new. In halves of a step, so that
// it is exact.
PerEdge NodeDeviations::finest_stitched_deviation(int node_row, int node_column) const {
    const int north = node_row * node_quads;
    const int west = node_column * node_quads;
    std::array<std::int64_t, 4> twice{};
    // Twice the middle of a and b less that of c and d.
    const auto compare = [&](std::size_t edge, std::int64_t a, std::int64_t b, std::int64_t c,
                             std::int64_t d) {
        twice[edge] = std::max(twice[edge], std::abs(a + b - c - d));
    };
    for (int i = 1; i < node_quads; i += 2) {
        const std::int32_t* top = heights_.row(north) + west + i;
        const std::int32_t* below_top = heights_.row(north + 1) + west + i;
        compare(0, top[-1], top[1], top[0], top[0]);
        compare(0, top[-1], below_top[1], top[0], below_top[0]);
        const std::int32_t* bottom = heights_.row(north + node_quads) + west + i;
        const std::int32_t* above_bottom = heights_.row(north + node_quads - 1) + west + i;
        compare(2, bottom[-1], bottom[1], bottom[0], bottom[0]);
        compare(2, bottom[-1], above_bottom[0], above_bottom[-1], bottom[0]);
        const std::int32_t* above = heights_.row(north + i - 1) + west;
        const std::int32_t* row = heights_.row(north + i) + west;
        const std::int32_t* below = heights_.row(north + i + 1) + west;
        compare(1, above[8], below[8], row[8], row[8]);
        compare(1, row[7], above[8], above[7], row[8]);
        compare(3, above[0], below[0], row[0], row[0]);
        compare(3, above[0], below[1], row[0], row[1]);
    }
    PerEdge deviation{};
    for (std::size_t i = 0; i < 4; ++i) deviation[i] = 0.5 * static_cast<double>(twice[i]);
    return deviation;
}

}  // namespace oro

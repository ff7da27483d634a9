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

// Of numbers that are not negative: what std::floor gives, which is a call.
int rounded_down(double number) {
    return static_cast<int>(number);
}
// Of numbers above -1.
int rounded_up(double number) {
    const int down = static_cast<int>(number);
    return static_cast<double>(down) < number ? down + 1 : down;
}

// Whether a line that goes `far` one way in so many steps of the other comes to posts alone, step by step:
// also as it is reckoned in double, where shares of a power of two are exact.
bool power_of_two(int number) {
    const int size = std::abs(number);
    return (size & (size - 1)) == 0;
}
bool meets_posts_alone(int steps, int far) {
    return power_of_two(steps) && (far & (std::abs(steps) - 1)) == 0;
}

// An edge of a triangle as a way from row to row.
struct Slope {
    int first_row, last_row;  // the ends are not of the way
    int row, column;          // one of the ends
    int down, right;
    double share;  // one of `down`; 0 where that is not exact
    [[nodiscard]] double column_at(int r) const {
        const double way = static_cast<double>(r - row) * right;
        return column + (share != 0.0 ? way * share : way / down);
    }
};

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
            return other.posts == candidate.posts && other.diagonal == candidate.diagonal &&
                   other.quad == candidate.quad && (other.edges & candidate.edges) == other.edges;
        });
    };
    const auto add = [&](Stitched candidate, const CellCorners& corners) {
        const glm::uvec2 quad(candidate.quad[0], candidate.quad[1]);
        bool changed = false;
        std::array<glm::ivec2, 3> at;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::uvec2 plain = quad + glm::uvec2(corners[i][0], corners[i][1]);
            const glm::uvec2 to = gpu::stitched_post(plain, {rows, columns}, candidate.edges);
            changed = changed || to != plain;
            candidate.posts[i] = {to.x, to.y};
            at[i] = glm::ivec2(to);
        }
        const glm::ivec2 a = at[1] - at[0];
        const glm::ivec2 b = at[2] - at[0];
        if (changed && a.x * b.y != a.y * b.x && !known(candidate)) found.push_back(candidate);
    };
    for (std::uint32_t mask = 1; mask < 16; ++mask) {
        if ((mask & edges) != mask) continue;
        for (std::uint32_t i = 0; i < 2 * rows * columns; ++i) {
            const std::array quad{i / 2 / columns, i / 2 % columns};
            for (const Diagonal diagonal : {Diagonal::nw_se, Diagonal::sw_ne}) {
                const bool sw_ne =
                    gpu::drawn_sw_ne(diagonal == Diagonal::sw_ne, {quad[0], quad[1]}, {rows, columns}, mask);
                add({mask, quad, diagonal, {}},
                    cell_corners(sw_ne ? Diagonal::sw_ne : Diagonal::nw_se, i % 2 == 0));
            }
        }
    }
    return found;
}

// Largest difference along an edge of a triangle that is none of the full-resolution surface's, in steps:
// where it crosses that surface's edges.
double NodeDeviations::crossing_deviation(const Post& from, const Post& to) const {
    const int down = to.row - from.row;
    const int right = to.column - from.column;
    if (down == 0 || right == 0 || (down == right && !heights_.diagonals)) return 0.0;
    const double h0 = heights_.at(from.row, from.column);
    const double h1 = heights_.at(to.row, to.column);
    Extremes extremes;
    bool meets_void = false;
    // The place at share t of the edge lies on the full-resolution edge from a post to its neighbour (dr,
    // dc).
    const auto compare = [&](double t, int row, int column, double share, int dr, int dc) {
        const std::int32_t begin = heights_.at(row, column), end = heights_.at(row + dr, column + dc);
        meets_void = meets_void || begin == void_height_steps || end == void_height_steps;
        extremes.add((1.0 - share) * begin + share * end - (h0 + t * (h1 - h0)));
    };
    // Step by step of one way, of which there are so many: all that do not come to a post.
    const auto each = [](int steps, const auto& visit) {
        const int step = steps > 0 ? 1 : -1;
        const double share = power_of_two(steps) ? 1.0 / steps : 0.0;
        for (int i = step; i != steps; i += step)
            visit(i, share != 0.0 ? i * share : static_cast<double>(i) / steps);
    };
    if (!meets_posts_alone(down, right))
        each(down, [&](int i, double t) {
            const double column = from.column + t * right;
            const int west = rounded_down(column);
            if (column > west) compare(t, from.row + i, west, column - west, 0, 1);
        });
    if (!meets_posts_alone(right, down))
        each(right, [&](int i, double t) {
            const double row = from.row + t * down;
            const int north = rounded_down(row);
            if (row > north) compare(t, north, from.column + i, row - north, 1, 0);
        });
    if (right != down && !meets_posts_alone(right - down, down))
        each(right - down, [&](int i, double t) {
            const double row = from.row + t * down;
            const int north = rounded_down(row), west = north + from.column - from.row + i;
            if (row > north && heights_.diagonal(0, north, west) == Diagonal::nw_se)
                compare(t, north, west, row - north, 1, 1);
        });
    if (heights_.diagonals && right != -down && !meets_posts_alone(right + down, down))
        each(right + down, [&](int i, double t) {
            const double row = from.row + t * down;
            const int north = rounded_down(row), east = from.row + from.column + i - north;
            if (row > north && heights_.diagonal(0, north, east - 1) == Diagonal::sw_ne)
                compare(t, north, east, row - north, 1, -1);
        });
    // That surface is not there on either side of an edge that ends in a void post.
    return meets_void ? unfit_m : extremes.magnitude();
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
    std::array<Slope, 3> slopes{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Post &p = triangle[i], &q = triangle[(i + 1) % 3];
        const int down = q.row - p.row;
        slopes[i] = {std::min(p.row, q.row),
                     std::max(p.row, q.row),
                     p.row,
                     p.column,
                     down,
                     q.column - p.column,
                     down != 0 && power_of_two(down) ? 1.0 / down : 0.0};
    }
    for (int row = std::min({a.row, b.row, c.row}); row <= std::max({a.row, b.row, c.row}); ++row) {
        double west = std::numeric_limits<double>::infinity();
        double east = -west;
        const auto widen = [&](double column) {
            west = std::min(west, column);
            east = std::max(east, column);
        };
        for (std::size_t i = 0; i < 3; ++i) {
            const Slope& slope = slopes[i];
            if (slope.row == row) widen(slope.column);
            if (slope.first_row < row && row < slope.last_row) widen(slope.column_at(row));
        }
        const std::int32_t* steps = heights_.row(row);
        const double in_row = h + per_row * (row - a.row);
        const int last = rounded_down(east + 1.0e-9);
        for (int column = rounded_up(west - 1.0e-9); column <= last; ++column) {
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
PerEdge NodeDeviations::stitched_deviation(int node_row, int node_column, std::uint32_t edges,
                                           std::uint32_t asked_edges) const {
    PerEdge deviation{};
    if (asked_edges == 0) return deviation;
    const int rows = level_.row.quads_of_node(node_row);
    const int columns = level_.column.quads_of_node(node_column);
    const bool whole = rows == node_quads && columns == node_quads;
    const std::vector<Stitched> own = whole ? std::vector<Stitched>{}
                                            : stitched_triangles(static_cast<std::uint32_t>(rows),
                                                                 static_cast<std::uint32_t>(columns), edges);
    for (const Stitched& stitched : whole ? whole_node_ : own) {
        if ((stitched.edges & edges) != stitched.edges) continue;
        const int edge = std::countr_zero(stitched.edges);
        if ((asked_edges >> edge & 1U) == 0) continue;
        if (heights_.diagonal(level_.level(), node_row * node_quads + static_cast<int>(stitched.quad[0]),
                              node_column * node_quads + static_cast<int>(stitched.quad[1])) !=
            stitched.diagonal)
            continue;
        Triangle triangle;
        bool dropped = false;
        for (std::size_t i = 0; i < 3; ++i) {
            triangle[i] = {
                level_.row.region_post(node_row * node_quads + static_cast<int>(stitched.posts[i][0])),
                level_.column.region_post(node_column * node_quads + static_cast<int>(stitched.posts[i][1]))};
            dropped = dropped || heights_.at(triangle[i].row, triangle[i].column) == void_height_steps;
        }
        double& of_edge = deviation[static_cast<std::size_t>(edge)];
        if (!dropped) of_edge = std::max(of_edge, triangle_deviation(triangle));
    }
    return deviation;
}

// The same for a whole node of level 0 without voids, where only few places of a pair of quads can be the
// worst: the post that is left out, and where edges that are new cross those of the two quads. In sixths of a
// step, so that it is exact.
PerEdge NodeDeviations::finest_stitched_deviation(int node_row, int node_column) const {
    const int north = node_row * node_quads, west = node_column * node_quads;
    std::array<std::int64_t, 4> sixfold{};
    // A pair of quads that an edge joins. Of the posts along the edge the second goes to the first; those
    // inside lie beside them. The first quad becomes a triangle, cut off along the line from the first post
    // of the edge to the second inside. The second one is split by a line that ends at the first post of the
    // edge, or as it was before. As seen from there, a diagonal `from_first` begins at the first post of the
    // edge in either quad.
    const auto join = [&](std::size_t edge, const std::array<std::int64_t, 3>& along,
                          const std::array<std::int64_t, 3>& inside, bool first_from_first,
                          bool second_from_first) {
        const auto middles = [&](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
            sixfold[edge] = std::max(sixfold[edge], 3 * std::abs(a + b - c - d));
        };
        middles(along[0], along[2], along[1], along[1]);
        if (!first_from_first) middles(along[0], inside[1], along[1], inside[0]);
        if (!second_from_first) return;
        middles(along[0], inside[2], along[1], inside[1]);
        // A third along the new line, two thirds along the first quad's diagonal.
        if (!first_from_first)
            sixfold[edge] =
                std::max(sixfold[edge], 2 * std::abs(2 * along[0] + inside[2] - inside[0] - 2 * along[1]));
    };
    const auto post = [&](int row, int column) {
        return std::int64_t{heights_.at(north + row, west + column)};
    };
    const auto sw_ne = [&](int row, int column) {
        return heights_.diagonal(0, north + row, west + column) == Diagonal::sw_ne;
    };
    constexpr int last = node_quads - 1;
    for (int i = 1; i < node_quads; i += 2) {
        const auto row = [&](int r) { return std::array{post(r, i - 1), post(r, i), post(r, i + 1)}; };
        const auto column = [&](int c) { return std::array{post(i - 1, c), post(i, c), post(i + 1, c)}; };
        join(0, row(0), row(1), !sw_ne(0, i - 1), !sw_ne(0, i));
        join(1, column(node_quads), column(last), sw_ne(i - 1, last), sw_ne(i, last));
        join(2, row(node_quads), row(last), sw_ne(last, i - 1), sw_ne(last, i));
        join(3, column(0), column(1), !sw_ne(i - 1, 0), !sw_ne(i, 0));
    }
    // Where both edges are stitched this quad is nw_se (shaders/choose/levels.glsl, drawn_sw_ne).
    constexpr std::uint32_t corner = gpu::edge_south | gpu::edge_east;
    if (sw_ne(last, last) && (edges(node_row, node_column) & corner) == corner)
        sixfold[1] = std::max(sixfold[1], 3 * std::abs(post(last, last) + post(last + 1, last + 1) -
                                                       post(last, last + 1) - post(last + 1, last)));
    PerEdge deviation{};
    for (std::size_t i = 0; i < 4; ++i) deviation[i] = static_cast<double>(sixfold[i]) / 6.0;
    return deviation;
}

}  // namespace oro

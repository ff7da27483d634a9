#include "core/made_pages/stitched_samples.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/base/wide.h"
#include "core/earth/extremes.h"

namespace oro {
namespace {

// Of numbers that are not negative.
int floor_of(double number) {
    return static_cast<int>(number);
}
// Of numbers above -1.
int ceiling_of(double number) {
    const int down = static_cast<int>(number);
    return static_cast<double>(down) < number ? down + 1 : down;
}

// A plane over posts: what it has at the one that its rows and columns count from, and how it changes.
struct PostPlane {
    double at_first;
    double by_row;
    double by_column;
    int first_row, first_column;
};

// coarse: the post at row 0 and column 0, `columns` from row to row.
ORO_WIDE Extremes compare_rows(std::span<const StitchedSamples::PostRow> rows, const std::int32_t* coarse,
                               int columns, const PostPlane& plane) {
    FourDoubles lows{}, highs{};
    Extremes rest;
    for (const StitchedSamples::PostRow& row : rows) {
        const std::int32_t* const posts = coarse + static_cast<std::ptrdiff_t>(row.number) * columns;
        const double of_row = plane.at_first + (row.number - plane.first_row) * plane.by_row;
        int j = row.first_column;
        const double from = j - plane.first_column;
        FourDoubles right{from, from + 1.0, from + 2.0, from + 3.0};
        for (; j + 3 <= row.last_column; j += 4, right += 4.0) {
            FourSteps four;
            std::memcpy(&four, posts + j, sizeof four);
            const FourDoubles difference =
                __builtin_convertvector(four, FourDoubles) - (of_row + right * plane.by_column);
            lows = difference < lows ? difference : lows;
            highs = difference > highs ? difference : highs;
        }
        for (; j <= row.last_column; ++j)
            rest.add(posts[j] - (of_row + (j - plane.first_column) * plane.by_column));
    }
    for (int k = 0; k < 4; ++k) {
        rest.add(lows[k]);
        rest.add(highs[k]);
    }
    return rest;
}

}  // namespace

StitchedSamples::StitchedSamples(const std::array<PostOffset, 3>& corners, int columns)
    : corners_(corners), columns_(columns) {
    for (std::size_t i = 0; i < 3; ++i) {
        edges_[i].from = i;
        edges_[i].to = (i + 1) % 3;
        add_crossings(edges_[i]);
    }
    add_posts();
}

// post: the one before the crossing.
void StitchedSamples::add_crossing(Edge& edge, double share, PostOffset post, double far, bool is_along_row) {
    const PostOffset& from = corners_[edge.from];
    const double begin = is_along_row ? from.column : from.row, first = is_along_row ? post.column : post.row;
    edge.crossings.push_back({number_of(post), number_of(post), share, begin, first, far, is_along_row});
}

// With the rows and columns of posts, and the diagonals of cells.
void StitchedSamples::add_crossings(Edge& edge) {
    const PostOffset &from = corners_[edge.from], &to = corners_[edge.to];
    const int down = to.row - from.row, right = to.column - from.column;
    const auto each = [&](int steps, const auto& visit) {
        const int step = steps > 0 ? 1 : -1;
        for (int i = step; i != steps && steps != 0; i += step) visit(i, static_cast<double>(i) / steps);
    };
    // What lies on a post needs no other.
    const auto go_on = [&](double between, const PostOffset& by) {
        if (between > 0.0) edge.crossings.back().next_post += number_of(by);
    };
    each(down, [&](int i, double share) {
        const double column = from.column + share * right;
        const int west = floor_of(column);
        add_crossing(edge, share, {from.row + i, west}, share * right, true);
        go_on(column - west, {0, 1});
    });
    each(right, [&](int i, double share) {
        const double row = from.row + share * down;
        const int north = floor_of(row);
        add_crossing(edge, share, {north, from.column + i}, share * down, false);
        go_on(row - north, {1, 0});
    });
    each(right - down, [&](int i, double share) {
        const double row = from.row + share * down;
        const int north = floor_of(row);
        add_crossing(edge, share, {north, from.column - from.row + i + north}, share * down, false);
        go_on(row - north, {1, 1});
    });
}

// In the triangle and on its edges.
void StitchedSamples::add_posts() {
    const auto [first_row, last_row] = std::minmax({corners_[0].row, corners_[1].row, corners_[2].row});
    for (int row = first_row; row <= last_row; ++row) {
        double west = std::numeric_limits<double>::infinity(), east = -west;
        for (const Edge& edge : edges_) {
            const PostOffset &from = corners_[edge.from], &to = corners_[edge.to];
            if (row < std::min(from.row, to.row) || row > std::max(from.row, to.row)) continue;
            const double share =
                to.row == from.row ? 0.0 : static_cast<double>(row - from.row) / (to.row - from.row);
            const double column = from.column + share * (to.column - from.column);
            west = std::min(west, column);
            east = std::max(east, column);
        }
        // A row that an edge lies on has its ends from the two other edges.
        constexpr double rounding = 1e-9;
        rows_.push_back({row, ceiling_of(west - rounding), floor_of(east + rounding)});
    }
}

double StitchedSamples::largest_steps(const DrawnHeights& heights, std::span<const std::int32_t> coarse_steps,
                                      const PostOffset& node) const {
    const std::ptrdiff_t first = number_of(node);
    const std::int32_t* const coarse = coarse_steps.data() + first;
    std::array<double, 3> h{};
    for (std::size_t i = 0; i < 3; ++i)
        h[i] = heights.steps[static_cast<std::size_t>(first + number_of(corners_[i]))];
    const auto& [a, b, c] = corners_;
    const double down_b = b.row - a.row, right_b = b.column - a.column, rise_b = h[1] - h[0];
    const double down_c = c.row - a.row, right_c = c.column - a.column, rise_c = h[2] - h[0];
    const double area = down_b * right_c - down_c * right_b;
    const double by_row = (rise_b * right_c - rise_c * right_b) / area;
    const double by_column = (down_b * rise_c - down_c * rise_b) / area;
    Extremes extremes = compare_rows(rows_, coarse, columns_, {h[0], by_row, by_column, a.row, a.column});
    for (const Edge& edge : edges_) {
        const double begin_h = h[edge.from], rise = h[edge.to] - begin_h;
        for (const Crossing& at : edge.crossings) {
            // As it is reckoned in the grid: not all shares are exact.
            const double origin = at.is_along_row ? node.column : node.row;
            const double between = origin + at.begin + at.far - (origin + at.first);
            const double there =
                (1.0 - between) * coarse[at.post] + (between > 0.0 ? between * coarse[at.next_post] : 0.0);
            extremes.add(there - (begin_h + at.share * rise));
        }
    }
    return extremes.magnitude();
}

}  // namespace oro

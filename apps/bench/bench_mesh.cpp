#include "apps/bench/bench_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace oro {
namespace {

// For divisors above 0.
std::int64_t divided_down(std::int64_t value, std::int64_t by) {
    return value >= 0 ? value / by : -((-value + by - 1) / by);
}
std::int64_t divided_up(std::int64_t value, std::int64_t by) {
    return -divided_down(-value, by);
}

struct ColumnRange {
    std::int64_t first;
    std::int64_t last;
};

// Columns of a row whose posts are in the triangle. An edge lets through where
// twice_area(from, to, post) = per_column * column + rest is not negative.
ColumnRange columns_in_row(const MeshTriangle& triangle, int row) {
    ColumnRange range{0, most_mesh_posts};
    for (std::size_t i = 0; i < 3; ++i) {
        const MeshPost& from = triangle[i];
        const MeshPost& to = triangle[(i + 1) % 3];
        const std::int64_t per_column = from.row - to.row;
        const std::int64_t rest =
            static_cast<std::int64_t>(to.column - from.column) * (row - from.row) - per_column * from.column;
        if (per_column > 0) range.first = std::max(range.first, divided_up(-rest, per_column));
        if (per_column < 0) range.last = std::min(range.last, divided_down(rest, -per_column));
    }
    return range;
}

}  // namespace

WorstPost worst_post(const DrawnHeights& heights, const MeshTriangle& triangle) {
    const auto& [a, b, c] = triangle;
    const std::int64_t area = twice_area(a, b, c);
    assert(area > 0);
    // Times the area, so that all are whole numbers: heights above a's, and the plane's.
    const std::int64_t h_a = heights.at(a.row, a.column);
    const std::int64_t rise_b = heights.at(b.row, b.column) - h_a;
    const std::int64_t rise_c = heights.at(c.row, c.column) - h_a;
    const std::int64_t per_column = (c.row - a.row) * rise_b - (b.row - a.row) * rise_c;
    const std::int64_t per_row = (b.column - a.column) * rise_c - (c.column - a.column) * rise_b;
    std::int64_t largest = 0;
    MeshPost worst = a;
    for (int row = std::min({a.row, b.row, c.row}); row <= std::max({a.row, b.row, c.row}); ++row) {
        const ColumnRange columns = columns_in_row(triangle, row);
        const std::int32_t* steps = heights.row(row);
        for (std::int64_t column = columns.first; column <= columns.last; ++column) {
            const std::int64_t plane = per_row * (row - a.row) + per_column * (column - a.column);
            const std::int64_t error = std::abs((steps[column] - h_a) * area - plane);
            if (error <= largest) continue;
            largest = error;
            worst = {row, static_cast<int>(column)};
        }
    }
    return {height_step_m * (static_cast<double>(largest) / static_cast<double>(area)), worst};
}

WorstPlace worst_place(const DrawnHeights& heights, const MeshTriangle& triangle) {
    const WorstPost post = worst_post(heights, triangle);
    WorstPlace worst{post.error_m, post.post, post.post};
    for (std::size_t i = 0; i < 3; ++i) {
        const MeshPost &a = triangle[i], &b = triangle[(i + 1) % 3];
        const int down = b.row - a.row, right = b.column - a.column;
        const double h_a = heights.at(a.row, a.column), h_b = heights.at(b.row, b.column);
        const auto cross = [&](int lines, const MeshPost& along) {
            for (int line = 1; line < lines; ++line) {
                const double share = static_cast<double>(line) / lines;
                // Posts on either side of the crossing, along the grid's line.
                const std::int64_t moved = static_cast<std::int64_t>(along.row != 0 ? down : right) * line;
                const std::int64_t whole = divided_down(moved, lines);
                const double beyond = static_cast<double>(moved - whole * lines) / lines;
                MeshPost from{a.row + static_cast<int>(whole), a.column + static_cast<int>(whole)};
                if (along.row == 0) from.row = a.row + (down > 0 ? line : -line);
                if (along.column == 0) from.column = a.column + (right > 0 ? line : -line);
                if (along.row != 0 && along.column > 0) from.column += right > down ? line : -line;
                if (along.column < 0)
                    from.column = a.column - static_cast<int>(whole) + (right + down > 0 ? line : -line);
                if (beyond == 0.0) continue;  // a post
                const bool diagonal = along.row != 0 && along.column != 0;
                if (diagonal && heights.diagonal(0, from.row, from.column - (along.column < 0 ? 1 : 0)) !=
                                    (along.column < 0 ? Diagonal::sw_ne : Diagonal::nw_se))
                    continue;  // that cell has the other one
                const MeshPost to{from.row + along.row, from.column + along.column};
                const double ground = heights.at(from.row, from.column) * (1.0 - beyond) +
                                      heights.at(to.row, to.column) * beyond;
                const double off_m = height_step_m * std::abs(ground - (h_a + share * (h_b - h_a)));
                if (off_m > worst.error_m) worst = {off_m, from, to};
            }
        };
        cross(std::abs(down), {0, 1});
        cross(std::abs(right), {1, 0});
        cross(std::abs(right - down), {1, 1});
        if (heights.diagonals) cross(std::abs(right + down), {1, -1});
    }
    return worst;
}

MeshCheck check_mesh(const DrawnHeights& heights, std::span<const MeshTriangle> mesh, double error_m) {
    MeshCheck check;
    std::vector<bool> covered(heights.steps.size());
    for (const auto& [a, b, c] : mesh) {
        const std::int64_t area = twice_area(a, b, c);
        const std::int64_t sign = area < 0 ? -1 : 1;
        assert(area != 0);
        for (int row = std::min({a.row, b.row, c.row}); row <= std::max({a.row, b.row, c.row}); ++row) {
            for (int column = std::min({a.column, b.column, c.column});
                 column <= std::max({a.column, b.column, c.column}); ++column) {
                const MeshPost post{row, column};
                const std::int64_t of_a = sign * twice_area(b, c, post);
                const std::int64_t of_b = sign * twice_area(c, a, post);
                const std::int64_t of_c = sign * twice_area(a, b, post);
                if (of_a < 0 || of_b < 0 || of_c < 0) continue;
                const std::int64_t h = heights.at(row, column);
                const std::int64_t above = of_a * (h - heights.at(a.row, a.column)) +
                                           of_b * (h - heights.at(b.row, b.column)) +
                                           of_c * (h - heights.at(c.row, c.column));
                const double off_m = height_step_m * (static_cast<double>(std::abs(above)) /
                                                      static_cast<double>(std::abs(area)));
                check.largest_error_m = std::max(check.largest_error_m, off_m);
                if (off_m > error_m) ++check.posts_beyond;
                covered[static_cast<std::size_t>(row) * static_cast<std::size_t>(heights.columns) +
                        static_cast<std::size_t>(column)] = true;
            }
        }
    }
    check.posts_uncovered = static_cast<std::size_t>(std::count(covered.begin(), covered.end(), false));
    return check;
}

}  // namespace oro

// Whether drawn nodes cover a region as they must: once, in steps of one level, without a gap.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/lod/levels.h"
#include "tests/core/lod/pyramid_region.h"
#include "tests/core/truth/drawn_surface.h"

namespace oro::test {

// Each level-0 node with a triangle is covered once (at most once where it may be left out); -1 where there
// is nothing to cover.
inline void expect_one_cover(const Region& region, const std::vector<DrawnNode>& nodes,
                             std::vector<int>& level_at, bool may_be_left_out = false) {
    const PyramidLevel& finest = region.pyramid.levels[0];
    const int rows = finest.grid.row.nodes();
    const int columns = finest.grid.column.nodes();
    level_at.assign(static_cast<std::size_t>(rows * columns), -1);
    for (const DrawnNode& node : nodes) {
        for (int row = node.row << node.level; row < std::min(rows, (node.row + 1) << node.level); ++row) {
            for (int column = node.column << node.level;
                 column < std::min(columns, (node.column + 1) << node.level); ++column) {
                int& level = level_at[static_cast<std::size_t>(row * columns + column)];
                ASSERT_EQ(level, -1) << "drawn twice";
                level = node.level;
            }
        }
    }
    for (int i = 0; i < rows * columns; ++i) {
        if (finest.node(i / columns, i % columns).radius >= 0.0F) {
            ASSERT_TRUE(may_be_left_out || level_at[static_cast<std::size_t>(i)] >= 0) << "not drawn";
        } else {
            level_at[static_cast<std::size_t>(i)] = -1;
        }
    }
}

inline void expect_steps_of_one(const Region& region, const std::vector<int>& level_at) {
    const int rows = region.grid(0).row.nodes();
    const int columns = region.grid(0).column.nodes();
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const int here = level_at[static_cast<std::size_t>(row * columns + column)];
            const auto expect = [&](int other) {
                if (here >= 0 && other >= 0) {
                    ASSERT_LE(std::abs(here - other), 1) << row << " " << column;
                }
            };
            if (row > 0) expect(level_at[static_cast<std::size_t>((row - 1) * columns + column)]);
            if (column > 0) expect(level_at[static_cast<std::size_t>(row * columns + column - 1)]);
            if (column == 0 && region.pyramid.wraps_longitude)
                expect(level_at[static_cast<std::size_t>(row * columns + columns - 1)]);
        }
    }
}

// Every edge of every drawn triangle belongs to two, in opposite directions, but where the surface ends:
// there the full resolution must end, too. Posts are compared by number, so nothing can open.
inline void expect_watertight(const Region& region, const std::vector<DrawnNode>& nodes) {
    using Edge = std::pair<RegionPost, RegionPost>;
    std::vector<Edge> edges;
    const int last_column = region.heights.columns - 1;
    const auto closed = [&](RegionPost post) {
        if (region.pyramid.wraps_longitude && post.column == last_column) post.column = 0;
        return post;
    };
    for (const DrawnNode& node : nodes) {
        for (const auto& triangle :
             drawn_triangles(region.heights, region.grid(node.level), node.row, node.column, node.edges)) {
            for (std::size_t i = 0; i < 3; ++i)
                edges.emplace_back(closed(triangle[i]), closed(triangle[(i + 1) % 3]));
        }
    }
    std::sort(edges.begin(), edges.end());
    ASSERT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end()) << "one triangle on each side";
    for (const Edge& edge : edges) {
        if (std::binary_search(edges.begin(), edges.end(), Edge{edge.second, edge.first})) continue;
        auto [a, b] = edge;
        if (std::abs(a.column - b.column) > last_column / 2) (a.column == 0 ? a : b).column = last_column;
        // An end of the surface. Triangles run counter-clockwise seen from above, so what is to the right of
        // a -> b lies outside: of the full resolution, too.
        const double length = std::hypot(b.row - a.row, b.column - a.column);
        const double outward_row = 0.5 * (a.row + b.row) + 0.01 * (b.column - a.column) / length;
        const double outward_column = 0.5 * (a.column + b.column) - 0.01 * (b.row - a.row) / length;
        const bool outside = outward_row < 0.0 || outward_column < 0.0 ||
                             outward_row > region.heights.rows - 1 || outward_column > last_column;
        ASSERT_TRUE(outside || !finest_triangle(region.heights, outward_row, outward_column))
            << a.row << "," << a.column << " - " << b.row << "," << b.column;
    }
}

}  // namespace oro::test

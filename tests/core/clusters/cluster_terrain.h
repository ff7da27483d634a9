// Terrain with its cluster graph, and what tests ask of both by ways of their own.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "core/cluster_frame/cluster_cut.h"
#include "core/clusters/graph_builder.h"
#include "core/surface/grid_surface.h"
#include "core/terrain/triangle_heights.h"
#include "tests/support/rough_terrain.h"

namespace oro::test {

// Everything reads what stands before it, so it is not copied.
struct ClusterTerrain {
    HeightField field;
    DrawnHeights heights;
    GridSurface surface;
    GridBounds bounds;
    ClusterGraph graph;

    explicit ClusterTerrain(HeightField of, const GraphOptions& options = {.threads = 2})
        : field(std::move(of)),
          heights(drawn_heights(field, 1.0, 1)),
          surface(heights),
          bounds(field.grid, heights.highest_steps),
          graph(build_cluster_graph(surface, bounds, options)) {}
    ClusterTerrain(const ClusterTerrain&) = delete;
    ClusterTerrain& operator=(const ClusterTerrain&) = delete;

    // Height of the original, in steps, at a row and a column; nothing where there is none.
    [[nodiscard]] std::optional<double> original(double row, double column) const {
        const auto post = [&](int r, int c) -> std::optional<double> {
            const std::int32_t steps = heights.at(r, c);
            if (steps == void_height_steps) return std::nullopt;
            return steps;
        };
        const auto diagonal_at = [&](int r, int c) { return heights.diagonal(0, r, c); };
        return h_at_row_column_m(field.grid, post, diagonal_at, row, column);
    }
};

inline HeightField flat_field(int rows, int columns, float H_m = 300.0F) {
    return made_field(47.0, 8.0, 1200.0, rows, columns, [=](double, double) { return H_m; });
}

inline float& post_of(HeightField& field, int row, int column) {
    return field.H_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.grid.columns()) +
                     static_cast<std::size_t>(column)];
}

// A ragged hole, a slit, single posts, and a void strip along a part of the rim.
inline HeightField holed_field(int rows, int columns, std::uint64_t seed) {
    HeightField field = rough_field(47.0, 8.0, rows, columns);
    std::mt19937_64 random(seed);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double from_middle = std::hypot(row - 0.45 * rows, column - 0.6 * columns);
            const bool hole = from_middle < 0.12 * rows + 3.0 * std::sin(row * 0.7) * std::cos(column * 0.9);
            const bool slit = row == rows / 5 && column > columns / 4 && column < columns / 2;
            const bool strip = row > rows - 5 && column < columns / 3;
            if (hole || slit || strip || random() % 701 == 0) post_of(field, row, column) = void_height_m;
        }
    }
    return field;
}

// A sea at H 0 that reaches over most of the field, and an island's coast.
inline HeightField coast_field(int rows, int columns) {
    HeightField field = rough_field(47.0, 8.0, rows, columns);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double from_corner = std::hypot(row, column) + 9.0 * std::sin(0.1 * row);
            if (from_corner > 0.4 * rows) post_of(field, row, column) = 0.0F;
        }
    }
    return field;
}

using DirectedEdge = std::pair<VertexNumber, VertexNumber>;

// The edges of triangles that have no triangle on their other side; empty where an edge is there twice, too:
// `twice` tells how often.
inline std::set<DirectedEdge> rim_of(const std::vector<VertexTriangle>& triangles, std::size_t& twice) {
    std::set<DirectedEdge> edges;
    twice = 0;
    for (const VertexTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i)
            twice += edges.insert({triangle[i], triangle[(i + 1) % 3]}).second ? 0U : 1U;
    }
    std::set<DirectedEdge> rim;
    for (const DirectedEdge& edge : edges) {
        if (!edges.contains({edge.second, edge.first})) rim.insert(edge);
    }
    return rim;
}

inline std::vector<VertexTriangle> triangles_of(const ClusterGraph& graph,
                                                const std::vector<std::uint32_t>& cut) {
    std::vector<VertexTriangle> triangles;
    for (const std::uint32_t i : cut) {
        const auto of_cluster = graph.triangles_of(graph.clusters[i]);
        triangles.insert(triangles.end(), of_cluster.begin(), of_cluster.end());
    }
    return triangles;
}

inline std::vector<VertexTriangle> original_triangles(const OriginalSurface& surface) {
    std::vector<VertexTriangle> triangles;
    for (const auto& leaf : surface.leaves()) triangles.insert(triangles.end(), leaf.begin(), leaf.end());
    return triangles;
}

// An edge as steps between neighbouring posts, where it is a straight run of such.
inline std::vector<DirectedEdge> unit_steps(const OriginalSurface& surface, const DirectedEdge& edge,
                                            int columns) {
    const SurfaceVertex a = surface.vertex(edge.first), b = surface.vertex(edge.second);
    const int parts = std::gcd(b.row - a.row, b.column - a.column);
    const int down = (b.row - a.row) / parts, right = (b.column - a.column) / parts;
    std::vector<DirectedEdge> steps;
    auto from = static_cast<std::int64_t>(edge.first);
    for (int i = 0; i < parts; ++i) {
        const std::int64_t to = from + std::int64_t{down} * columns + right;
        steps.emplace_back(static_cast<VertexNumber>(from), static_cast<VertexNumber>(to));
        from = to;
    }
    return steps;
}

// Groups that stand where a random subset is asked for, so that none stands above one that does not.
inline std::vector<char> random_stands(const ClusterGraph& graph, std::mt19937_64& random, double share) {
    std::vector<char> stands(graph.groups.size());
    for (std::size_t i = 0; i < stands.size(); ++i) {
        const double level_share = std::pow(share, 0.3 + 0.1 * graph.groups[i].level);
        bool below = true;
        for (const std::uint32_t member : graph.members_of(graph.groups[i])) {
            const std::uint32_t maker = graph.clusters[member].made_by;
            below = below && (maker == no_group || stands[maker] != 0);
        }
        stands[i] = below && std::uniform_real_distribution<double>(0.0, 1.0)(random) < level_share ? 1 : 0;
    }
    return stands;
}

}  // namespace oro::test

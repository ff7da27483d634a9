// The order of a cluster's triangles: each one across an edge of one before it, so that few bits tell them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/clusters/cluster_graph.h"
#include "core/surface/original_surface.h"

namespace oro {

// Which triangles of a cluster are told, and what is to be told next. Who writes them and who reads them walk
// alike. Vertices are numbered 0 .. vertices - 1 by place: row by row, each from west to east.
class ClusterWalk {
  public:
    // A directed edge of a told triangle. What lies on its other side is not told: a triangle with the edge
    // the other way round, or nothing of the cluster.
    struct Edge {
        int from;
        int to;
    };

    // vertices: at most most_cluster_vertices. Kept for many clusters one after another.
    void start(int vertices);
    // The edge whose other side is to be told now, the oldest first; nothing when all are told. Then a
    // triangle that touches no told one in an edge is next, if one is left.
    [[nodiscard]] std::optional<Edge> next();
    // Tells a triangle, clockwise, that may_be().
    void add(int a, int b, int c);
    // Tells that nothing of the cluster is beyond an edge that next() gave.
    void close(const Edge& edge);

    // Whether nothing that was told speaks against a triangle: its corners differ, and none of its edges is
    // told, nor is it told that nothing is there.
    [[nodiscard]] bool may_be(int a, int b, int c) const;
    // A corner of a told triangle.
    [[nodiscard]] bool is_told(int vertex) const { return told_[at(vertex)] != 0; }
    // Edges at a vertex whose other side is not told.
    [[nodiscard]] int open_edges(int vertex) const { return open_[at(vertex)]; }

  private:
    enum State : std::uint8_t { unknown, told, nothing };
    static std::size_t at(int number) { return static_cast<std::size_t>(number); }
    [[nodiscard]] std::uint8_t& state(int from, int to) { return states_[at(from) * vertices_ + at(to)]; }
    [[nodiscard]] std::uint8_t state(int from, int to) const {
        return states_[at(from) * vertices_ + at(to)];
    }

    std::size_t vertices_{};
    std::vector<std::uint8_t> states_;  // of directed edges
    std::array<std::uint8_t, most_cluster_vertices> told_{};
    std::array<int, most_cluster_vertices> open_{};
    std::vector<Edge> edges_;  // of told triangles, in the order in which they are asked
    std::size_t next_{};
};

// A triangle of a cluster by its own numbers.
using LocalTriangle = std::array<std::uint8_t, 3>;

// The triangles of a cluster in the order of a walk, and each turned as the walk tells it: the edge first
// that it was reached by. One that is reached by none is the least of those that are left, its least corner
// first. Gives the same for the same triangles in any order.
[[nodiscard]] std::vector<LocalTriangle> walk_order(std::span<const LocalTriangle> triangles, int vertices);

// Vertices of a cluster by place.
[[nodiscard]] std::vector<VertexNumber> vertices_by_place(const OriginalSurface& surface,
                                                          std::span<const VertexTriangle> triangles);

// Puts a cluster's triangles into the order of a walk.
void put_in_walk_order(const OriginalSurface& surface, std::span<VertexTriangle> triangles);

}  // namespace oro

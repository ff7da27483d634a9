// The order of a cluster's triangles: each one across an edge of one before it, so that few bits tell them.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/clusters/cluster_graph.h"

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
    [[nodiscard]] bool is_coded(int vertex) const { return coded_[at(vertex)] != 0; }
    // Edges at a vertex whose other side is not told.
    [[nodiscard]] int open_edges(int vertex) const { return open_[at(vertex)]; }

  private:
    enum State : std::uint8_t { unknown, coded, nothing };
    static std::size_t at(int number) { return static_cast<std::size_t>(number); }
    [[nodiscard]] std::uint8_t& state(int from, int to) { return states_[at(from) * vertices_ + at(to)]; }
    [[nodiscard]] std::uint8_t state(int from, int to) const {
        return states_[at(from) * vertices_ + at(to)];
    }

    std::size_t vertices_{};
    std::vector<std::uint8_t> states_;  // of directed edges
    std::array<std::uint8_t, most_cluster_vertices> coded_{};
    std::array<int, most_cluster_vertices> open_{};
    std::vector<Edge> edges_;  // of told triangles, in the order in which they are asked
    std::size_t next_{};
};

// A triangle of a cluster by its own numbers.
using LocalTriangle = std::array<std::uint8_t, 3>;

inline void ClusterWalk::start(int vertices) {
    assert(vertices >= 0 && at(vertices) <= most_cluster_vertices);
    vertices_ = at(vertices);
    states_.assign(vertices_ * vertices_, unknown);
    coded_.fill(0);
    open_.fill(0);
    edges_.clear();
    next_ = 0;
}

inline std::optional<ClusterWalk::Edge> ClusterWalk::next() {
    for (; next_ < edges_.size(); ++next_) {
        const Edge edge = edges_[next_];
        if (state(edge.to, edge.from) == unknown) return edge;
    }
    return std::nullopt;
}

inline void ClusterWalk::add(int a, int b, int c) {
    assert(may_be(a, b, c));
    for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
        const bool closes = state(edge.to, edge.from) == coded;
        state(edge.from, edge.to) = coded;
        coded_[at(edge.from)] = 1;
        for (const int vertex : {edge.from, edge.to}) open_[at(vertex)] += closes ? -1 : 1;
        if (!closes) edges_.push_back(edge);
    }
}

inline void ClusterWalk::close(const Edge& edge) {
    state(edge.to, edge.from) = nothing;
    --open_[at(edge.from)];
    --open_[at(edge.to)];
}

inline bool ClusterWalk::may_be(int a, int b, int c) const {
    return a != b && b != c && c != a && state(a, b) == unknown && state(b, c) == unknown &&
           state(c, a) == unknown;
}

}  // namespace oro

// A cluster's triangles in few bits, where the places of its vertices are known.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cluster_file/number_code.h"
#include "core/cluster_file/point_code.h"
#include "core/clusters/cluster_walk.h"

namespace oro {

// Told in the order of a ClusterWalk: what lies beyond each edge. Mostly it is the vertex from which the edge
// is seen at the largest angle, of those that have room for a triangle; else the next after it, and so on.
class MeshCode {
  public:
    // points: the vertices, sorted, at most most_cluster_vertices. triangles: `count` in the order of a walk,
    // clockwise; an encoder's are coded, a decoder's are replaced. False where a decoder's bytes tell none
    // such; the triangles are then of no use.
    template <class Coder>
    bool code(Coder& coder, std::span<const GridPosition> points, std::uint32_t count,
              std::vector<LocalTriangle>& triangles);

  private:
    static constexpr int none = -1;
    static constexpr std::uint32_t most_ranks = 8;

    // A vertex that may be beyond an edge.
    struct Candidate {
        double cotangent;  // of the angle at it
        int vertex;        // none: there is no other
    };
    void start(std::span<const GridPosition> points);
    void add(const LocalTriangle& triangle);
    void close(const ClusterWalk::Edge& edge);
    void drop_where_closed(int vertex);
    [[nodiscard]] bool fits(int a, int b, int c) const;
    void look_from(const ClusterWalk::Edge& edge);
    Candidate take_best(const ClusterWalk::Edge& edge);
    template <class Coder>
    bool code_first(Coder& coder, LocalTriangle& triangle);
    template <class Coder>
    int code_beyond(Coder& coder, const ClusterWalk::Edge& edge, int vertex);

    // By what is known of the best candidate: whether it is told, and its angle.
    std::array<std::array<AdaptiveBit, 5>, 3> nothing_;
    std::array<std::array<AdaptiveBit, most_ranks>, 2> passed_;
    AdaptiveBit first_is_next_;

    ClusterWalk walk_;
    std::span<const GridPosition> points_;
    int least_untold_{};
    // Vertices that have room for a triangle, in rising order, and where they are; as numbers of one kind, so
    // that the compiler reckons several at a time.
    std::size_t open_{};
    std::array<int, most_cluster_vertices> open_vertices_{};
    std::array<double, most_cluster_vertices> rows_{};
    std::array<double, most_cluster_vertices> columns_{};
    std::array<double, most_cluster_vertices> cotangents_{};
};

}  // namespace oro

#include "core/cluster_file/mesh_code.h"

#include <algorithm>
#include <limits>

namespace oro {
namespace {

constexpr double not_seen = std::numeric_limits<double>::infinity();

// Classes of angles, by their cotangents: from right angles on, and down to some 14 degrees.
std::size_t angle_class(double cotangent) {
    constexpr std::array<double, 4> bounds = {-0.01, 0.5, 1.5, 4.0};
    return static_cast<std::size_t>(
        std::find_if(bounds.begin(), bounds.end(), [=](double bound) { return cotangent < bound; }) -
        bounds.begin());
}

}  // namespace

void MeshCode::start(std::span<const GridPosition> points) {
    points_ = points;
    walk_.start(static_cast<int>(points.size()));
    least_untold_ = 0;
    open_ = points.size();
    for (std::size_t i = 0; i < open_; ++i) {
        open_vertices_[i] = static_cast<int>(i);
        rows_[i] = points[i].row;
        columns_[i] = points[i].column;
    }
}

// A vertex none of whose edges is open has no room any more. (Where parts of a cluster touch at a point, it
// may have: then it is told by its number.)
void MeshCode::drop_where_closed(int vertex) {
    if (walk_.open_edges(vertex) > 0) return;
    const auto end = open_vertices_.begin() + static_cast<std::ptrdiff_t>(open_);
    const auto found = std::lower_bound(open_vertices_.begin(), end, vertex);
    if (found == end || *found != vertex) return;
    const auto at = static_cast<std::size_t>(found - open_vertices_.begin());
    const std::size_t after = open_ - at - 1;
    std::copy_n(&open_vertices_[at] + 1, after, &open_vertices_[at]);
    std::copy_n(&rows_[at] + 1, after, &rows_[at]);
    std::copy_n(&columns_[at] + 1, after, &columns_[at]);
    --open_;
}

void MeshCode::add(const LocalTriangle& triangle) {
    walk_.add(triangle[0], triangle[1], triangle[2]);
    for (const int vertex : triangle) drop_where_closed(vertex);
}

void MeshCode::close(const ClusterWalk::Edge& edge) {
    walk_.close(edge);
    drop_where_closed(edge.from);
    drop_where_closed(edge.to);
}

bool MeshCode::fits(int a, int b, int c) const {
    const auto place = [&](int vertex) {
        const GridPosition& point = points_[static_cast<std::size_t>(vertex)];
        return SurfaceVertex{point.row, point.column, 0};
    };
    return walk_.may_be(a, b, c) && twice_area(place(a), place(b), place(c)) > 0;
}

// From all that have room, without asking what else is in the way. Roundings may change the order, the same
// on every machine: they are those of IEEE 754, and products are not joined with sums (-ffp-contract=off).
void MeshCode::look_from(const ClusterWalk::Edge& edge) {
    const GridPosition &from = points_[static_cast<std::size_t>(edge.to)],
                       &to = points_[static_cast<std::size_t>(edge.from)];
    const double from_row = from.row, from_column = from.column, to_row = to.row, to_column = to.column;
    for (std::size_t i = 0; i < open_; ++i) {
        const double row_a = from_row - rows_[i], row_b = to_row - rows_[i];
        const double column_a = from_column - columns_[i], column_b = to_column - columns_[i];
        const double area = column_a * row_b - row_a * column_b;
        const double cotangent = (row_a * row_b + column_a * column_b) / area;
        cotangents_[i] = area > 0.0 ? cotangent : not_seen;
    }
}

// The best that was not taken yet. Of several as good as each other the first.
MeshCode::Candidate MeshCode::take_best(const ClusterWalk::Edge& edge) {
    while (true) {
        double best = not_seen;
        std::size_t at = open_;
        for (std::size_t i = 0; i < open_; ++i) {
            at = cotangents_[i] < best ? i : at;
            best = cotangents_[i] < best ? cotangents_[i] : best;
        }
        if (at == open_) return {not_seen, none};
        cotangents_[at] = not_seen;
        if (walk_.may_be(edge.to, edge.from, open_vertices_[at])) return {best, open_vertices_[at]};
    }
}

template <class Coder>
int MeshCode::code_beyond(Coder& coder, const ClusterWalk::Edge& edge, int vertex) {
    look_from(edge);
    Candidate candidate = take_best(edge);
    const std::size_t kind = candidate.vertex == none ? 2 : walk_.is_coded(candidate.vertex) ? 1 : 0;
    if (coder.bit(nothing_[kind][angle_class(candidate.cotangent)], vertex == none)) return none;
    for (std::uint32_t rank = 0; rank < most_ranks && candidate.vertex != none; ++rank) {
        AdaptiveBit& passed = passed_[walk_.is_coded(candidate.vertex) ? 1 : 0][rank];
        if (!coder.bit(passed, candidate.vertex != vertex)) return candidate.vertex;
        candidate = take_best(edge);
    }
    const auto vertices = static_cast<std::uint32_t>(points_.size());
    return static_cast<int>(coder.uniform(vertices, static_cast<std::uint32_t>(vertex)));
}

// A triangle that is reached across no edge. Its least corner is the first vertex that is not told, but where
// all of its corners are: parts touch at points.
template <class Coder>
bool MeshCode::code_first(Coder& coder, LocalTriangle& triangle) {
    const auto vertices = static_cast<std::uint32_t>(points_.size());
    const auto any = [&](std::uint8_t vertex) {
        return static_cast<std::uint8_t>(coder.uniform(vertices, vertex));
    };
    while (least_untold_ < static_cast<int>(vertices) && walk_.is_coded(least_untold_)) ++least_untold_;
    const bool is_next = coder.bit(first_is_next_, triangle[0] == least_untold_);
    triangle[0] = is_next ? static_cast<std::uint8_t>(least_untold_) : any(triangle[0]);
    for (const std::size_t corner : {1U, 2U}) triangle[corner] = any(triangle[corner]);
    return triangle[0] < vertices && fits(triangle[0], triangle[1], triangle[2]);
}

template <class Coder>
bool MeshCode::code(Coder& coder, std::span<const GridPosition> points, std::uint32_t count,
                    std::vector<LocalTriangle>& triangles) {
    start(points);
    if constexpr (!Coder::writes) triangles.clear();
    for (std::size_t i = 0; i < count; ++i) {
        LocalTriangle triangle{};
        if constexpr (Coder::writes) triangle = triangles[i];
        int beyond = none;
        auto edge = walk_.next();
        while (edge) {
            const bool reached = Coder::writes && triangle[0] == edge->to && triangle[1] == edge->from;
            beyond = code_beyond(coder, *edge, reached ? triangle[2] : none);
            if (beyond != none) break;
            close(*edge);
            edge = walk_.next();
        }
        if (edge) {
            if (!fits(edge->to, edge->from, beyond)) return false;
            triangle = {static_cast<std::uint8_t>(edge->to), static_cast<std::uint8_t>(edge->from),
                        static_cast<std::uint8_t>(beyond)};
        } else if (!code_first(coder, triangle)) {
            return false;
        }
        add(triangle);
        if constexpr (!Coder::writes) triangles.push_back(triangle);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!walk_.is_coded(static_cast<int>(i))) return false;
    }
    return true;
}

template bool MeshCode::code(RangeEncoder&, std::span<const GridPosition>, std::uint32_t,
                             std::vector<LocalTriangle>&);
template bool MeshCode::code(RangeDecoder&, std::span<const GridPosition>, std::uint32_t,
                             std::vector<LocalTriangle>&);

}  // namespace oro

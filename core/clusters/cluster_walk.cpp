#include "core/clusters/cluster_walk.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace oro {
namespace {

LocalTriangle least_corner_first(LocalTriangle triangle) {
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    return triangle;
}

// The triangle on each side of each edge.
class TrianglesByEdge {
  public:
    TrianglesByEdge(std::span<const LocalTriangle> triangles, int vertices)
        : vertices_(static_cast<std::size_t>(vertices)), triangles_(vertices_ * vertices_, none) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t j = 0; j < 3; ++j)
                of(triangles[i][j], triangles[i][(j + 1) % 3]) = static_cast<std::uint8_t>(i);
        }
    }
    static constexpr std::uint8_t none = 0xff;
    static_assert(most_cluster_triangles < none);
    [[nodiscard]] std::uint8_t& of(int from, int to) {
        return triangles_[static_cast<std::size_t>(from) * vertices_ + static_cast<std::size_t>(to)];
    }

  private:
    std::size_t vertices_;
    std::vector<std::uint8_t> triangles_;
};

// The corner that is not on an edge.
std::uint8_t beyond(const LocalTriangle& triangle, const ClusterWalk::Edge& edge) {
    return *std::find_if(triangle.begin(), triangle.end(),
                         [&](std::uint8_t corner) { return corner != edge.from && corner != edge.to; });
}

}  // namespace

void ClusterWalk::start(int vertices) {
    assert(vertices >= 0 && at(vertices) <= most_cluster_vertices);
    vertices_ = at(vertices);
    states_.assign(vertices_ * vertices_, unknown);
    told_.fill(0);
    open_.fill(0);
    edges_.clear();
    next_ = 0;
}

std::optional<ClusterWalk::Edge> ClusterWalk::next() {
    for (; next_ < edges_.size(); ++next_) {
        const Edge edge = edges_[next_];
        if (state(edge.to, edge.from) == unknown) return edge;
    }
    return std::nullopt;
}

void ClusterWalk::add(int a, int b, int c) {
    assert(may_be(a, b, c));
    for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
        const bool closes = state(edge.to, edge.from) == told;
        state(edge.from, edge.to) = told;
        told_[at(edge.from)] = 1;
        for (const int vertex : {edge.from, edge.to}) open_[at(vertex)] += closes ? -1 : 1;
        if (!closes) edges_.push_back(edge);
    }
}

void ClusterWalk::close(const Edge& edge) {
    state(edge.to, edge.from) = nothing;
    --open_[at(edge.from)];
    --open_[at(edge.to)];
}

bool ClusterWalk::may_be(int a, int b, int c) const {
    return a != b && b != c && c != a && state(a, b) == unknown && state(b, c) == unknown &&
           state(c, a) == unknown;
}

std::vector<LocalTriangle> walk_order(std::span<const LocalTriangle> triangles, int vertices) {
    TrianglesByEdge by_edge(triangles, vertices);
    std::vector<char> told(triangles.size(), 0);
    std::vector<LocalTriangle> order;
    ClusterWalk walk;
    walk.start(vertices);
    const auto tell = [&](const LocalTriangle& triangle) {
        walk.add(triangle[0], triangle[1], triangle[2]);
        order.push_back(triangle);
    };
    while (order.size() < triangles.size()) {
        std::size_t least = triangles.size();
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            if (told[i] == 0 && (least == triangles.size() ||
                                 least_corner_first(triangles[i]) < least_corner_first(triangles[least])))
                least = i;
        }
        told[least] = 1;
        tell(least_corner_first(triangles[least]));
        while (const auto edge = walk.next()) {
            const std::uint8_t there = by_edge.of(edge->to, edge->from);
            if (there == TrianglesByEdge::none) {
                walk.close(*edge);
                continue;
            }
            told[there] = 1;
            tell({static_cast<std::uint8_t>(edge->to), static_cast<std::uint8_t>(edge->from),
                  beyond(triangles[there], *edge)});
        }
    }
    return order;
}

std::vector<VertexNumber> vertices_by_place(const OriginalSurface& surface,
                                            std::span<const VertexTriangle> triangles) {
    std::vector<VertexNumber> vertices;
    for (const VertexTriangle& triangle : triangles)
        vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const auto by_place = [&](VertexNumber a, VertexNumber b) {
        const SurfaceVertex of_a = surface.vertex(a), of_b = surface.vertex(b);
        return std::tie(of_a.row, of_a.column) < std::tie(of_b.row, of_b.column);
    };
    // A grid's numbers are in this order already.
    if (!std::is_sorted(vertices.begin(), vertices.end(), by_place))
        std::stable_sort(vertices.begin(), vertices.end(), by_place);
    return vertices;
}

void put_in_walk_order(const OriginalSurface& surface, std::span<VertexTriangle> triangles) {
    const std::vector<VertexNumber> vertices = vertices_by_place(surface, triangles);
    std::vector<std::pair<VertexNumber, std::uint8_t>> numbers;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        numbers.emplace_back(vertices[i], static_cast<std::uint8_t>(i));
    std::sort(numbers.begin(), numbers.end());
    std::vector<LocalTriangle> local(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            local[i][j] =
                std::lower_bound(numbers.begin(), numbers.end(), std::pair{triangles[i][j], std::uint8_t{0}})
                    ->second;
    }
    local = walk_order(local, static_cast<int>(vertices.size()));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t j = 0; j < 3; ++j) triangles[i][j] = vertices[local[i][j]];
    }
}

}  // namespace oro

#include "core/clusters/cluster_split.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/clusters/cluster_graph.h"
#include "core/surface/distinct_vertices.h"

namespace oro {
namespace {

// Three times the middle of a triangle, and the triangle with its least corner first: so it does not matter
// which corner was first.
struct Placed {
    std::int64_t row;
    std::int64_t column;
    VertexTriangle triangle;
};

void split(std::span<Placed> placed, std::size_t parts, std::vector<std::size_t>& counts) {
    std::vector<VertexTriangle> triangles;
    if (parts == 1) {
        for (const Placed& one : placed) triangles.push_back(one.triangle);
        if (vertex_count(triangles) <= most_cluster_vertices) {
            counts.push_back(placed.size());
            return;
        }
        parts = 2;  // many that do not touch
    }
    const auto rows = std::minmax_element(placed.begin(), placed.end(),
                                          [](const Placed& a, const Placed& b) { return a.row < b.row; });
    const auto columns = std::minmax_element(
        placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.column < b.column; });
    const bool by_row = rows.second->row - rows.first->row > columns.second->column - columns.first->column;
    const std::size_t first_parts = parts / 2;
    const std::size_t first = placed.size() * first_parts / parts;
    std::sort(placed.begin(), placed.end(), [&](const Placed& a, const Placed& b) {
        const std::int64_t of_a = by_row ? a.row : a.column, of_b = by_row ? b.row : b.column;
        return of_a != of_b ? of_a < of_b : a.triangle < b.triangle;
    });
    split(placed.first(first), first_parts, counts);
    split(placed.subspan(first), parts - first_parts, counts);
}

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

std::size_t vertex_count(std::span<const VertexTriangle> triangles) {
    return distinct_vertices(triangles).size();
}

void split_to_clusters(const OriginalSurface& surface, std::span<VertexTriangle> triangles,
                       std::vector<std::size_t>& counts) {
    if (triangles.empty()) return;
    std::vector<Placed> placed;
    placed.reserve(triangles.size());
    for (const VertexTriangle& triangle : triangles) {
        Placed one{0, 0, triangle};
        std::rotate(one.triangle.begin(), std::min_element(one.triangle.begin(), one.triangle.end()),
                    one.triangle.end());
        for (const VertexNumber number : triangle) {
            one.row += surface.vertex(number).row;
            one.column += surface.vertex(number).column;
        }
        placed.push_back(one);
    }
    split(placed, (placed.size() + most_cluster_triangles - 1) / most_cluster_triangles, counts);
    std::transform(placed.begin(), placed.end(), triangles.begin(),
                   [](const Placed& one) { return one.triangle; });
}

std::vector<LocalTriangle> walk_order(std::span<const LocalTriangle> triangles, int vertices) {
    TrianglesByEdge by_edge(triangles, vertices);
    std::vector<char> handled(triangles.size(), 0);
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
            if (handled[i] == 0 && (least == triangles.size() ||
                                    least_corner_first(triangles[i]) < least_corner_first(triangles[least])))
                least = i;
        }
        handled[least] = 1;
        tell(least_corner_first(triangles[least]));
        while (const auto edge = walk.next()) {
            const std::uint8_t there = by_edge.of(edge->to, edge->from);
            if (there == TrianglesByEdge::none) {
                walk.close(*edge);
                continue;
            }
            handled[there] = 1;
            tell({static_cast<std::uint8_t>(edge->to), static_cast<std::uint8_t>(edge->from),
                  beyond(triangles[there], *edge)});
        }
    }
    return order;
}

std::vector<VertexNumber> vertices_by_place(const OriginalSurface& surface,
                                            std::span<const VertexTriangle> triangles) {
    std::vector<VertexNumber> vertices = distinct_vertices(triangles);
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

#include "core/clusters/cluster_split.h"

#include <algorithm>

#include "core/clusters/cluster_graph.h"

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

}  // namespace

std::size_t vertex_count(std::span<const VertexTriangle> triangles) {
    std::vector<VertexNumber> vertices;
    for (const VertexTriangle& triangle : triangles)
        vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    std::sort(vertices.begin(), vertices.end());
    return static_cast<std::size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
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

}  // namespace oro

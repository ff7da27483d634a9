#include "core/surface/distinct_vertices.h"

#include <algorithm>
#include <array>

namespace oro {
namespace {

// A table at most three quarters full: sorting what is left takes a fifth of sorting all corners.
constexpr std::size_t slots = 512, most_triangles = slots / 4;

std::vector<VertexNumber> few_distinct(std::span<const VertexTriangle> triangles) {
    std::array<VertexNumber, slots> numbers;
    std::array<bool, slots> taken{};
    std::vector<VertexNumber> vertices;
    vertices.reserve(triangles.size());
    for (const VertexTriangle& triangle : triangles) {
        for (const VertexNumber number : triangle) {
            std::size_t slot = (number * 2654435761U) >> 23U;
            while (taken[slot] && numbers[slot] != number) slot = (slot + 1) % slots;
            if (taken[slot]) continue;
            taken[slot] = true;
            numbers[slot] = number;
            vertices.push_back(number);
        }
    }
    return vertices;
}

}  // namespace

std::vector<VertexNumber> distinct_vertices(std::span<const VertexTriangle> triangles) {
    std::vector<VertexNumber> vertices;
    if (triangles.size() <= most_triangles) {
        vertices = few_distinct(triangles);
    } else {
        for (const VertexTriangle& triangle : triangles)
            vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

}  // namespace oro

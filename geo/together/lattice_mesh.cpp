#include "geo/together/lattice_mesh.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <tuple>

namespace oro {
namespace {

constexpr std::uint32_t no_vertex = ~std::uint32_t{0};

// For each place that triangles have the first one that lies there; no_vertex for others.
std::pmr::vector<std::uint32_t> firsts_at(std::span<const glm::dvec3> places,
                                          std::span<const SourceTriangle> triangles,
                                          std::pmr::memory_resource* memory) {
    std::pmr::vector<std::uint32_t> order(memory), first(places.size(), no_vertex, memory);
    order.reserve(places.size());
    for (const SourceTriangle& triangle : triangles)
        for (const std::uint32_t corner : triangle)
            if (first[corner] == no_vertex) {
                first[corner] = corner;
                order.push_back(corner);
            }
    const auto key = [&](std::uint32_t i) { return std::tuple(places[i].x, places[i].y, places[i].z, i); };
    std::ranges::sort(order, {}, key);
    for (std::size_t i = 1; i < order.size(); ++i)
        if (places[order[i]] == places[order[i - 1]]) first[order[i]] = first[order[i - 1]];
    return first;
}

}  // namespace

LatticeMesh lattice_mesh(std::span<const glm::dvec3> places_m, std::span<const SourceTriangle> triangles,
                         ScratchMemory* scratch) {
    std::pmr::memory_resource* const memory = array_memory(scratch);
    const std::pmr::vector<std::uint32_t> first = firsts_at(places_m, triangles, memory);
    LatticeMesh mesh(memory);
    mesh.triangles.reserve(triangles.size()), mesh.triangle_of.reserve(triangles.size());
    mesh.vertices.reserve(places_m.size()), mesh.vertex_of.reserve(places_m.size());
    mesh.origin_m = places_m[triangles.front()[0]];
    std::pmr::vector<std::uint32_t> number(places_m.size(), no_vertex, memory);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        drop_pages_after(scratch, i + std::size_t{1});
        std::array<glm::dvec3, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = places_m[triangles[i][k]];
        if (glm::cross(at[1] - at[0], at[2] - at[0]) == glm::dvec3(0.0)) continue;
        std::array<std::uint32_t, 3>& triangle = mesh.triangles.emplace_back();
        mesh.triangle_of.push_back(i);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = first[triangles[i][k]];
            if (number[vertex] == no_vertex) {
                number[vertex] = static_cast<std::uint32_t>(mesh.vertices.size());
                mesh.vertices.push_back(places_m[vertex] - mesh.origin_m);
                mesh.vertex_of.push_back(vertex);
            }
            triangle[k] = number[vertex];
        }
    }
    return mesh;
}

}  // namespace oro

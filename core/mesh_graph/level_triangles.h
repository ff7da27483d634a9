// The triangles of a level of a mesh's graph, between two of the builder's steps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/mesh_graph/space_simplifier.h"

namespace oro {

// A LevelTriangle whose samples lie elsewhere.
struct StoredTriangle {
    std::array<std::uint32_t, 3> corners{};
    std::uint32_t original{};
    std::uint32_t made_by{};  // group; no_group: it is one of the mesh
    std::uint32_t sample_count{};
    double from_original_m{};
    const glm::dvec3* samples{};
};

// Triangles of one maker after another, in 40 bytes and 24 for each sample. All of it lies in `memory`.
class LevelTriangles {
  public:
    explicit LevelTriangles(std::pmr::memory_resource* memory) : triangles_(memory), samples_(memory) {}

    [[nodiscard]] std::size_t size() const { return triangles_.size(); }
    [[nodiscard]] const StoredTriangle& operator[](std::size_t number) const { return triangles_[number]; }
    [[nodiscard]] StoredTriangle& operator[](std::size_t number) { return triangles_[number]; }

    // Room for so many triangles.
    void reserve(std::size_t count) { triangles_.reserve(count); }
    // One of the mesh: its samples follow from it, first_samples().
    void add_original(const std::array<std::uint32_t, 3>& corners);
    // What some makers left, after what is there. Samples of all of them lie together.
    void add(std::span<const std::vector<LevelTriangle>> of_makers);
    // A triangle as the simplifier takes it.
    [[nodiscard]] LevelTriangle unpacked(std::size_t number, std::span<const glm::dvec3> vertices) const;

  private:
    std::pmr::vector<StoredTriangle> triangles_;
    std::pmr::vector<std::pmr::vector<glm::dvec3>> samples_;
};

// The samples that a triangle of the mesh begins with: its middle, and of each side that two triangles have
// the middle once, where they go round it in opposite ways.
std::vector<glm::dvec3> first_samples(const std::array<std::uint32_t, 3>& corners,
                                      std::span<const glm::dvec3> vertices);

}  // namespace oro

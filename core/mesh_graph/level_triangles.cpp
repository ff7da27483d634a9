#include "core/mesh_graph/level_triangles.h"

#include "core/clusters/cluster_graph.h"

namespace oro {

std::vector<glm::dvec3> first_samples(const std::array<std::uint32_t, 3>& corners,
                                      std::span<const glm::dvec3> vertices) {
    const glm::dvec3 &a = vertices[corners[0]], &b = vertices[corners[1]], &c = vertices[corners[2]];
    std::vector<glm::dvec3> samples{(a + b + c) / 3.0};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
        if (from < to) samples.push_back(0.5 * (vertices[from] + vertices[to]));
    }
    return samples;
}

void LevelTriangles::add_original(const std::array<std::uint32_t, 3>& corners) {
    const auto number = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back({corners, number, no_group, 0, 0.0, nullptr});
}

void LevelTriangles::add(std::span<const std::vector<LevelTriangle>> of_makers) {
    std::size_t count = 0;
    for (const std::vector<LevelTriangle>& made : of_makers)
        for (const LevelTriangle& triangle : made) count += triangle.samples.size();
    std::pmr::vector<glm::dvec3>& samples = samples_.emplace_back();
    samples.reserve(count);
    for (const std::vector<LevelTriangle>& made : of_makers)
        for (const LevelTriangle& triangle : made) {
            const glm::dvec3* const first = samples.data() + samples.size();
            samples.insert(samples.end(), triangle.samples.begin(), triangle.samples.end());
            triangles_.push_back({triangle.corners, triangle.original, triangle.made_by,
                                  static_cast<std::uint32_t>(triangle.samples.size()),
                                  triangle.from_original_m, first});
        }
}

LevelTriangle LevelTriangles::unpacked(std::size_t number, std::span<const glm::dvec3> vertices) const {
    const StoredTriangle& stored = triangles_[number];
    LevelTriangle triangle{stored.corners, stored.original, stored.made_by, stored.from_original_m, {}};
    if (stored.made_by == no_group)
        triangle.samples = first_samples(stored.corners, vertices);
    else
        triangle.samples.assign(stored.samples, stored.samples + stored.sample_count);
    return triangle;
}

}  // namespace oro

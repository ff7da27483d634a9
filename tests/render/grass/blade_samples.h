// Which samples of a picture the blades of a clump cover: brute force, in double, of the triangles that every
// way of drawing grass draws.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "render/grass/blade_rule.h"

namespace oro::test {

// A picture of width x height samples.
struct SampleGrid {
    int width{};
    int height{};
};

// Where clip coordinates lie among the samples; sample (0, 0) is at (0.5, 0.5).
inline glm::dvec2 among_samples(const glm::dvec4& clip, const SampleGrid& grid) {
    return {(clip.x / clip.w * 0.5 + 0.5) * grid.width, (clip.y / clip.w * 0.5 + 0.5) * grid.height};
}

// A triangle's part before the near plane: up to four corners.
inline std::vector<glm::dvec4> before_near_plane(const std::array<glm::dvec4, 3>& corners) {
    std::vector<glm::dvec4> kept;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec4 &a = corners[i], &b = corners[(i + 1) % 3];
        const double to_a = a.w - static_cast<double>(gpu::grass_near_m),
                     to_b = b.w - static_cast<double>(gpu::grass_near_m);
        if (to_a >= 0.0) kept.push_back(a);
        if ((to_a >= 0.0) != (to_b >= 0.0)) kept.push_back(a + (b - a) * (to_a / (to_a - to_b)));
    }
    return kept;
}

// Calls visit(x, y) for each sample within a convex polygon.
template <class Visit>
void visit_samples(const std::vector<glm::dvec2>& polygon, const SampleGrid& grid, const Visit& visit) {
    if (polygon.size() < 3) return;
    glm::dvec2 low = polygon[0], high = polygon[0];
    for (const glm::dvec2& p : polygon) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const int first_x = static_cast<int>(std::clamp(std::ceil(low.x - 0.5), 0.0, 1.0 * grid.width));
    const int first_y = static_cast<int>(std::clamp(std::ceil(low.y - 0.5), 0.0, 1.0 * grid.height));
    const int last_x = static_cast<int>(std::clamp(std::floor(high.x - 0.5), -1.0, grid.width - 1.0));
    const int last_y = static_cast<int>(std::clamp(std::floor(high.y - 0.5), -1.0, grid.height - 1.0));
    for (int y = first_y; y <= last_y; ++y)
        for (int x = first_x; x <= last_x; ++x) {
            bool left = true, right = true;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec2 a = polygon[i], along = polygon[(i + 1) % polygon.size()] - a;
                const double side = along.x * (y + 0.5 - a.y) - along.y * (x + 0.5 - a.x);
                left = left && side >= 0.0;
                right = right && side <= 0.0;
            }
            if (left != right) visit(x, y);
        }
}

// ... that the blades of a clump cover, each with so many vertices. wind: its time, seconds; negative: none.
template <class Visit>
void visit_clump(const gpu::GrassView& view, const gpu::GrassClump& clump, float width_m, float wind,
                 std::uint32_t vertices, const SampleGrid& grid, const Visit& visit) {
    for (std::uint32_t number = 0; number < gpu::blades_per_clump; ++number) {
        const gpu::GrassBlade blade = gpu::blade_of(clump, number, width_m, wind);
        std::vector<glm::dvec4> clips;
        for (std::uint32_t i = 0; i < vertices; ++i)
            clips.emplace_back(gpu::grass_clip(view, gpu::blade_vertex(blade, i, vertices)));
        for (std::size_t i = 2; i < clips.size(); ++i) {
            std::vector<glm::dvec2> polygon;
            for (const glm::dvec4& corner : before_near_plane({clips[i - 2], clips[i - 1], clips[i]}))
                polygon.push_back(among_samples(corner, grid));
            visit_samples(polygon, grid, visit);
        }
    }
}

}  // namespace oro::test

#include "apps/bench/whole_collapses.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "apps/bench/cover_bound.h"
#include "core/base/parallel.h"
#include "core/mesh_graph/nearest_triangles.h"
#include "core/mesh_graph/space_simplifier.h"

namespace oro {
namespace {

using Corners = TriangleCorners;

// A bound of how far triangles are from a set; what is above `enough_m` need not be known well.
double bound_m(const std::vector<Corners>& triangles, const NearestTriangles& set, double accepted_m,
               double enough_m) {
    constexpr std::size_t at_a_time = 2048;
    const std::size_t parts = (triangles.size() + at_a_time - 1) / at_a_time;
    std::vector<double> bounds_m(parts, 0.0);
    in_parallel(static_cast<int>(parts), thread_count(), [&](int number) {
        const auto part = static_cast<std::size_t>(number);
        const std::size_t first = part * at_a_time, count = std::min(at_a_time, triangles.size() - first);
        bounds_m[part] = cover_bound_m(std::span(triangles).subspan(first, count), set, accepted_m, enough_m);
    });
    return *std::max_element(bounds_m.begin(), bounds_m.end());
}

// The middle length of sides, as the builder of graphs has it.
double spacing_m(const std::vector<Corners>& triangles) {
    std::vector<double> sides;
    for (const auto& [a, b, c] : triangles)
        for (const double side : {glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)})
            sides.push_back(side);
    const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
    std::nth_element(sides.begin(), middle, sides.end());
    return *middle;
}

std::vector<LevelTriangle> level_of(std::span<const glm::dvec3> vertices,
                                    std::span<const std::array<std::uint32_t, 3>> triangles) {
    std::vector<LevelTriangle> level(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, b, c] = level[i].corners = triangles[i];
        level[i].original = i;
        level[i].samples.push_back((vertices[a] + vertices[b] + vertices[c]) / 3.0);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangles[i][k], to = triangles[i][(k + 1) % 3];
            if (from < to) level[i].samples.push_back(0.5 * (vertices[from] + vertices[to]));
        }
    }
    return level;
}

// Collapses that go on where they stopped.
class WholeCollapses {
  public:
    WholeCollapses(std::span<const glm::dvec3> vertices,
                   std::span<const std::array<std::uint32_t, 3>> triangles)
        : vertices_(vertices),
          mesh_(corners_of(vertices, triangles)),
          tree_(mesh_),
          spacing_m_(spacing_m(mesh_)),
          live_(level_of(vertices, triangles)) {}

    void go_on(double most_m) {
        SpaceSimplifier simplifier(
            vertices_, tree_,
            {reached_m_, most_m, std::min(0.01, 0.05 * spacing_m_), spacing_m_, nullptr, 0.0});
        simplifier.simplify(
            std::move(live_), [](std::uint32_t) { return false; }, 0);
        live_ = simplifier.take();
        reached_m_ = std::max(reached_m_, simplifier.reached_m());
    }
    [[nodiscard]] std::size_t triangles() const { return live_.size(); }
    // A bound of how far what is there and the mesh are from each other.
    [[nodiscard]] double measured_m(double accepted_m, double enough_m) const {
        std::vector<std::array<std::uint32_t, 3>> left;
        for (const LevelTriangle& triangle : live_) left.push_back(triangle.corners);
        const std::vector<Corners> made = corners_of(vertices_, left);
        const double to_mesh_m = bound_m(made, tree_, accepted_m, enough_m);
        if (to_mesh_m > enough_m) return to_mesh_m;
        return std::max(to_mesh_m, bound_m(mesh_, NearestTriangles(made), accepted_m, enough_m));
    }

  private:
    std::span<const glm::dvec3> vertices_;
    std::vector<Corners> mesh_;
    NearestTriangles tree_;
    double spacing_m_;
    std::vector<LevelTriangle> live_;
    double reached_m_{};
};

}  // namespace

std::vector<WholeMesh> whole_collapses(std::span<const glm::dvec3> vertices,
                                       std::span<const std::array<std::uint32_t, 3>> triangles,
                                       std::span<const double> errors_m) {
    WholeCollapses collapses(vertices, triangles);
    constexpr int steps = 12;
    constexpr double least_share = 0.2;
    constexpr double no_limit = std::numeric_limits<double>::infinity();
    std::vector<WholeMesh> found;
    for (const double error_m : errors_m) {
        WholeMesh& one = found.emplace_back();
        one.triangles = triangles.size();
        for (int step = 1; step <= steps; ++step) {
            const bool is_last = step == steps;
            collapses.go_on(error_m * (is_last ? 1.0 : least_share + (1.0 - least_share) * step / steps));
            one.believed = collapses.triangles();
            one.true_m = collapses.measured_m(0.97 * error_m, is_last ? no_limit : error_m);
            if (one.true_m <= error_m) one.triangles = std::min(one.triangles, one.believed);
        }
    }
    return found;
}

}  // namespace oro

// Triangles that sight lines are asked against, in a tree of boxes. Within core.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace oro {

class TriangleBvh {
  public:
    // Boxes lie along the columns of `frame`: around upright steps they are smallest where one of them is up.
    // owners: a number for each triangle, which its hits tell.
    TriangleBvh(std::vector<std::array<glm::dvec3, 3>> triangles, const glm::dmat3& frame,
                std::vector<std::uint32_t> owners);

    struct Hit {
        double along_m{};  // the line, from its start
        std::uint32_t owner{};
    };

    // How far along a line (`direction` of length 1) its first triangle is, less than reach_m and not before
    // its start, from either side. Error: rounding of doubles, so that a line through a common side of two
    // triangles meets one of them at least.
    [[nodiscard]] std::optional<Hit> first_hit(const glm::dvec3& start_m, const glm::dvec3& direction,
                                               double reach_m) const;

  private:
    struct Node {
        glm::dvec3 low{}, high{};  // in the frame, widened by what rounding takes from a line
        std::uint32_t first{};     // of its triangles; of others the first of two nodes below
        std::uint32_t count{};     // of its triangles; 0: it has two nodes
    };
    // In the frame.
    struct Bounds {
        glm::dvec3 low{}, high{}, middle{};
        std::uint32_t triangle{};
    };
    void split(std::uint32_t node, std::vector<Bounds>& bounds, std::uint32_t first, std::uint32_t last);

    glm::dmat3 frame_from_ecef_;
    std::vector<std::array<glm::dvec3, 3>> triangles_;  // ECEF axes
    std::vector<std::uint32_t> owners_;
    std::vector<Node> nodes_;
};

}  // namespace oro

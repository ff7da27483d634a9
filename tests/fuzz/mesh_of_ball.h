// What fuzzers of meshes begin from: a ball on the lattice, and changes of true bytes.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "core/mesh_file/stored_mesh.h"
#include "core/mesh_graph/mesh_graph.h"

namespace oro::test {

inline void expect(bool is_so) {
    if (!is_so) std::abort();
}

struct MeshOfBall {
    std::vector<LatticeSteps> places;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    [[nodiscard]] MeshGraph graph() const {
        std::vector<glm::dvec3> vertices;
        for (const LatticeSteps& place : places)
            vertices.push_back(glm::dvec3(place[0], place[1], place[2]) / lattice_steps_per_m);
        return build_mesh_graph(vertices, triangles, glm::dvec3(0.0));
    }
};

// Closed, of 24 (n - 1) triangles, 20 m in radius.
inline MeshOfBall mesh_of_ball(std::uint32_t n) {
    constexpr std::uint32_t around = 12;
    constexpr double radius_steps = 40000.0;
    MeshOfBall ball;
    ball.places = {{0, 0, 40000}, {0, 0, -40000}};
    for (std::uint32_t i = 1; i < n; ++i)
        for (std::uint32_t k = 0; k < around; ++k) {
            const double a = std::numbers::pi * i / n, b = 2.0 * std::numbers::pi * k / around;
            ball.places.push_back({std::llround(radius_steps * std::sin(a) * std::cos(b)),
                                   std::llround(radius_steps * std::sin(a) * std::sin(b)),
                                   std::llround(radius_steps * std::cos(a))});
        }
    const auto at = [](std::uint32_t i, std::uint32_t k) { return 2 + i * around + k % around; };
    for (std::uint32_t k = 0; k < around; ++k) {
        ball.triangles.push_back({0, at(0, k), at(0, k + 1)});
        ball.triangles.push_back({1, at(n - 2, k + 1), at(n - 2, k)});
        for (std::uint32_t i = 0; i + 2 < n; ++i) {
            ball.triangles.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
            ball.triangles.push_back({at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)});
        }
    }
    return ball;
}

// Three bytes of a fuzzer each: where, and what is there instead.
inline std::vector<std::byte> changed(std::vector<std::byte> bytes, const std::uint8_t* data,
                                      std::size_t size) {
    for (std::size_t i = 0; i + 2 < size && !bytes.empty(); i += 3)
        bytes[(static_cast<std::size_t>(data[i]) << 8U | data[i + 1]) % bytes.size()] =
            static_cast<std::byte>(data[i + 2]);
    return bytes;
}

}  // namespace oro::test

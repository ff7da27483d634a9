#include "tests/support/made_space_meshes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace oro::test {

glm::dvec3 on_lattice(const glm::dvec3& at) {
    return {std::round(at.x * 2048.0) / 2048.0, std::round(at.y * 2048.0) / 2048.0,
            std::round(at.z * 2048.0) / 2048.0};
}

SpaceMesh hilly_ball(std::uint32_t n, double radius_m) {
    SpaceMesh mesh;
    const std::uint32_t around = 2 * n;
    mesh.vertices = {{0.0, 0.0, radius_m}, {0.0, 0.0, -radius_m}};
    for (std::uint32_t i = 1; i < n; ++i)
        for (std::uint32_t k = 0; k < around; ++k) {
            const double a = std::numbers::pi * i / n, b = std::numbers::pi * k / n;
            const double r = radius_m * (1.0 + 0.05 * std::sin(9.0 * a) * std::cos(7.0 * b));
            mesh.vertices.push_back(
                on_lattice({r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a)}));
        }
    const auto at = [&](std::uint32_t i, std::uint32_t k) { return 2 + i * around + k % around; };
    for (std::uint32_t k = 0; k < around; ++k) {
        mesh.triangles.push_back({0, at(0, k), at(0, k + 1)});
        mesh.triangles.push_back({1, at(n - 2, k + 1), at(n - 2, k)});
        for (std::uint32_t i = 0; i + 2 < n; ++i) {
            mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
            mesh.triangles.push_back({at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)});
        }
    }
    return mesh;
}

SpaceMesh box_town(std::uint32_t rows) {
    SpaceMesh mesh;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < rows; ++column) {
            const double height = 4.0 + static_cast<double>((7 * row + 5 * column) % 13);
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (int i = 0; i < 8; ++i)
                mesh.vertices.push_back({20.0 * row + ((i & 1) != 0 ? 9.0 : 0.0),
                                         20.0 * column + ((i & 2) != 0 ? 7.0 : 0.0),
                                         (i & 4) != 0 ? height : 0.0});
            constexpr std::array<std::array<std::uint32_t, 3>, 12> sides{{{0, 2, 1},
                                                                          {1, 2, 3},
                                                                          {4, 5, 6},
                                                                          {5, 7, 6},
                                                                          {0, 1, 4},
                                                                          {1, 5, 4},
                                                                          {2, 6, 3},
                                                                          {3, 6, 7},
                                                                          {0, 4, 2},
                                                                          {2, 4, 6},
                                                                          {1, 3, 5},
                                                                          {3, 7, 5}}};
            for (const auto& [a, b, c] : sides) mesh.triangles.push_back({first + a, first + b, first + c});
        }
    return mesh;
}

MeshGround hills_below_town(std::uint32_t rows) {
    MeshGround ground;
    constexpr double step_m = 12.0;
    const int steps = static_cast<int>(20.0 * rows / step_m) + 4;
    const auto at = [](int i, int k) {
        const double x = step_m * (i - 2), y = step_m * (k - 2);
        return glm::dvec3(x, y, 0.5 + std::sin(0.09 * x) * std::cos(0.05 * y));
    };
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            ground.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            ground.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    return ground;
}

SpaceMesh folded_sheet(std::uint32_t n) {
    SpaceMesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t k = 0; k <= n; ++k) {
            const double along = 60.0 * i / n, turn = std::fmod(along, 20.0),
                         layer = std::floor(along / 20.0);
            const double x = static_cast<int>(layer) % 2 == 0 ? turn : 20.0 - turn;
            mesh.vertices.push_back(
                on_lattice({x, 40.0 * k / n, 0.5 * layer + 0.2 * std::sin(0.7 * along) * std::cos(0.3 * k)}));
        }
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = i * (n + 1) + k, b = a + n + 1;
            mesh.triangles.push_back({a, b, a + 1});
            mesh.triangles.push_back({a + 1, b, b + 1});
        }
    return mesh;
}

SpaceMesh walled_hills(std::uint32_t n) {
    SpaceMesh mesh;
    constexpr double step_m = 2.0;
    const auto number = [&](std::uint32_t row, std::uint32_t column) { return row * (n + 1) + column; };
    const auto add_quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    for (std::uint32_t row = 0; row <= n; ++row)
        for (std::uint32_t column = 0; column <= n; ++column) {
            const double x = step_m * row, y = step_m * column;
            mesh.vertices.push_back(
                on_lattice({x, y, 1.5 * std::sin(x / 9.0) + 1.2 * std::cos(y / 7.0 + x / 15.0)}));
        }
    for (std::uint32_t row = 0; row < n; ++row)
        for (std::uint32_t column = 0; column < n; ++column)
            add_quad(number(row, column), number(row + 1, column), number(row + 1, column + 1),
                     number(row, column + 1));
    for (std::uint32_t row = 3; row < n; row += 3) {
        std::uint32_t below = number(row, 0);
        for (int storey = 1; storey <= 2; ++storey) {
            const auto above = static_cast<std::uint32_t>(mesh.vertices.size());
            for (std::uint32_t column = 0; column <= n; ++column)
                mesh.vertices.push_back(on_lattice(mesh.vertices[number(row, column)] +
                                                   glm::dvec3(0.3 * std::sin(column), 0.0, step_m * storey)));
            for (std::uint32_t column = 0; column < n; ++column)
                add_quad(below + column, below + column + 1, above + column + 1, above + column);
            below = above;
        }
    }
    return mesh;
}

namespace {

double hill_m(double x, double y) {
    return 40.0 *
           (std::sin(0.009 * x) * std::cos(0.005 * y) + 0.3 * std::sin(0.041 * x + 0.3 * std::cos(0.03 * y)));
}

MeshGround hills(double side_m) {
    MeshGround ground;
    ground.off_m = 0.01;
    constexpr double step_m = 90.0;
    const int steps = static_cast<int>(side_m / step_m) + 3;
    for (int i = -1; i < steps; ++i)
        for (int k = -1; k < steps; ++k) {
            const int parts = i < steps / 2 ? 1 : 3;
            const auto at = [&](int part, int other) {
                const double x = step_m * i + step_m / parts * part, y = step_m * k + step_m / parts * other;
                return glm::dvec3(x, y, hill_m(x, y));
            };
            for (int a = 0; a < parts; ++a)
                for (int b = 0; b < parts; ++b) {
                    ground.triangles.push_back({at(a, b), at(a + 1, b), at(a + 1, b + 1)});
                    ground.triangles.push_back({at(a, b), at(a + 1, b + 1), at(a, b + 1)});
                }
        }
    return ground;
}

}  // namespace

TownOnHills town_on_hills(int houses, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<> share(0.0, 1.0);
    const SpaceMesh box = box_town(1);
    const double side_m = 22.0 * std::sqrt(houses);
    TownOnHills town{{}, hills(side_m)};
    for (int i = 0; i < houses; ++i) {
        const double x = side_m * share(random), y = side_m * share(random);
        const double width = 6.0 + 20.0 * std::pow(share(random), 2),
                     depth = 6.0 + 14.0 * std::pow(share(random), 2),
                     height = 3.0 + 40.0 * std::pow(share(random), 4), base = hill_m(x, y) - 3.0;
        const auto first = static_cast<std::uint32_t>(town.houses.vertices.size());
        for (const glm::dvec3& corner : box.vertices)
            town.houses.vertices.push_back(
                on_lattice({x + (corner.x > 0.0 ? width : 0.0), y + (corner.y > 0.0 ? depth : 0.0),
                            base + (corner.z > 0.0 ? height : 0.0)}));
        for (const auto& [a, b, c] : box.triangles)
            town.houses.triangles.push_back({first + a, first + b, first + c});
    }
    return town;
}

}  // namespace oro::test

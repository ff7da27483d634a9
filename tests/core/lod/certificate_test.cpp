// The promise of level choice: nothing in view is farther than tau pixels from where the full resolution has
// it. In double, without a GPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

#include "core/lod/levels.h"
#include "tests/core/lod/pyramid_region.h"
#include "tests/core/truth/world_field.h"
#include "tests/support/net_terrain.h"

namespace oro {
namespace {

using test::Region, test::patchy_field, test::random_camera, test::whole, test::taus_px;

struct Worst {
    std::vector<double> share_of_tau;  // of each place in view
    std::size_t beyond{};
};

// Every full-resolution post in view, and as many places between them, against what is drawn in its stead.
void add_errors(const Region& region, const Camera& camera, const NodeSelection& selection, double tau_px,
                std::mt19937_64& random, Worst& worst) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const glm::dvec3 eye = camera.eye_ecef().m;
    const glm::dvec2 tangent = camera.half_fov_tangent();
    const double pixels = 0.5 * camera.height_px / tangent.y;
    const auto on = [&](const test::PostTriangle& triangle, double row, double column) {
        const auto shares = test::shares_at(triangle, row, column);
        glm::dvec3 at(0.0);
        for (std::size_t i = 0; i < 3; ++i) at += shares[i] * (region.ecef_m(triangle[i]) - eye);
        return view_from_ecef * at;
    };
    const auto compare = [&](const glm::dvec3& truth, const glm::dvec3& drawn) {
        const bool in_view = truth.z < 0.0 && std::abs(truth.x) <= -truth.z * tangent.x &&
                             std::abs(truth.y) <= -truth.z * tangent.y;
        if (!in_view) return;
        const double shift_px = drawn.z < 0.0 ? pixels * std::hypot(truth.x / truth.z - drawn.x / drawn.z,
                                                                    truth.y / truth.z - drawn.y / drawn.z)
                                              : std::numeric_limits<double>::infinity();
        worst.share_of_tau.push_back(shift_px / tau_px);
        worst.beyond += shift_px > tau_px ? 1 : 0;
    };
    for (const DrawnNode& node : selection.nodes) {
        if (node.level == 0 && node.edges == 0) continue;  // the truth itself
        for (const auto& triangle : test::drawn_triangles(region.heights, region.grid(node.level), node.row,
                                                          node.column, node.edges)) {
            const auto& [a, b, c] = triangle;
            const auto plane =
                std::array{on(triangle, a.row, a.column),
                           on(triangle, a.row + 1.0, a.column) - on(triangle, a.row, a.column),
                           on(triangle, a.row, a.column + 1.0) - on(triangle, a.row, a.column)};
            const auto drawn_at = [&](double row, double column) {
                return plane[0] + (row - a.row) * plane[1] + (column - a.column) * plane[2];
            };
            for (int row = std::min({a.row, b.row, c.row}); row <= std::max({a.row, b.row, c.row}); ++row) {
                for (int column = std::min({a.column, b.column, c.column});
                     column <= std::max({a.column, b.column, c.column}); ++column) {
                    const auto shares = test::shares_at(triangle, row, column);
                    if (*std::min_element(shares.begin(), shares.end()) < -1.0e-9) continue;
                    compare(view_from_ecef * (region.ecef_m({row, column}) - eye), drawn_at(row, column));
                }
            }
            const double u = std::sqrt(unit(random)), v = unit(random);
            const double row = (1.0 - u) * a.row + u * (1.0 - v) * b.row + u * v * c.row;
            const double column = (1.0 - u) * a.column + u * (1.0 - v) * b.column + u * v * c.column;
            const auto finest = test::finest_triangle(region.heights, row, column);
            ASSERT_TRUE(finest.has_value());
            compare(on(*finest, row, column), drawn_at(row, column));
        }
    }
}

// The certificate.
TEST(Certificate, NothingInViewIsFartherThanTauFromItsPlace) {
    const unsigned seed = 77;
    std::mt19937_64 random(seed);
    HeightField with_voids = patchy_field(330, 390);
    for (int row = 65; row < 120; ++row) {
        for (int column = 70; column < 129; ++column)
            with_voids.H_m[static_cast<std::size_t>(row * 390 + column)] = void_height_m;
    }
    const Region regions[] = {
        Region(patchy_field(500, 453)), Region(std::move(with_voids)),
        // 2 minutes, up to the pole and round a quarter of the Earth.
        Region(test::world_field(30.0, 2700, 0, 300, 2700, [](double lat_deg, double lon_deg) {
            return 500.0 + 300.0 * std::sin(4.0 * lat_deg) * std::sin(0.5 * lon_deg) +
                   20.0 * std::sin(50.0 * lat_deg);
        })),
        // On nets: turned, and over a pole.
        Region(test::net_field({400, 360, {46.5, 8.0}, 60.0, 27.0}, test::patchy_H_m, 47.0F)),
        Region(test::net_field({300, 300, {89.9, 40.0}, 150.0, 0.0}, test::patchy_H_m))};
    Worst worst;
    for (int i = 0; i < 300; ++i) {
        const Region& region = regions[i % 6 == 5 ? 0 : i % 6];
        const Camera camera = random_camera(random, region);
        const double tau_px = taus_px[i % 3];
        add_errors(region, camera, select_nodes(region.pyramid, camera, whole(camera), tau_px), tau_px,
                   random, worst);
    }
    const auto quantile = [&](double share) {
        const auto place =
            worst.share_of_tau.begin() +
            static_cast<std::ptrdiff_t>(share * static_cast<double>(worst.share_of_tau.size() - 1));
        std::nth_element(worst.share_of_tau.begin(), place, worst.share_of_tau.end());
        return *place;
    };
    std::printf(
        "seed %u: 300 cameras, %zu places in view off the full resolution; distance / tau: median %.4f, 90 "
        "%% "
        "%.4f, "
        "99 %% %.4f, 99.9 %% %.4f, largest %.4f; beyond tau: %zu\n",
        seed, worst.share_of_tau.size(), quantile(0.5), quantile(0.9), quantile(0.99), quantile(0.999),
        quantile(1.0), worst.beyond);
    EXPECT_EQ(worst.beyond, 0U);
    EXPECT_GT(worst.share_of_tau.size(), 1000000U);
    EXPECT_GT(quantile(1.0), 0.7) << "or the promise is wasteful";
}

// The check above is one that can fail: with errors a third too small it does.
TEST(Certificate, TheCertificateIsNotEmpty) {
    std::mt19937_64 random(77);
    Region region(patchy_field(400, 360));
    for (PyramidLevel& level : region.pyramid.levels) {
        for (PyramidPage& page : level.pages) {
            for (gpu::MeshletBounds& node : page.nodes) node.error_m *= 0.67F;
        }
    }
    Worst worst;
    for (int i = 0; i < 20; ++i) {
        const Camera camera = random_camera(random, region);
        add_errors(region, camera, select_nodes(region.pyramid, camera, whole(camera), 1.0), 1.0, random,
                   worst);
    }
    EXPECT_GT(worst.beyond, 0U);
}

}  // namespace
}  // namespace oro

// What a group says of its error, against brute force: at random places, and wherever edges cross.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string>

#include "tests/core/clusters/cluster_terrain.h"
#include "tests/support/cell_rule.h"
#include "tests/support/net_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

// A flat triangle of posts, in space, by row and column.
struct FlatTriangle3 {
    std::array<SurfaceVertex, 3> posts;
    std::array<glm::dvec3, 3> ecef_m;

    FlatTriangle3(const GroundBounds& bounds, const std::array<SurfaceVertex, 3>& corners) : posts(corners) {
        for (std::size_t i = 0; i < 3; ++i) ecef_m[i] = bounds.ecef(corners[i]).m;
    }
    [[nodiscard]] std::array<double, 3> shares_at(double row, double column) const {
        const auto area = [&](const SurfaceVertex& a, const SurfaceVertex& b) {
            return (b.column - a.column) * (row - a.row) - (b.row - a.row) * (column - a.column);
        };
        const double whole = static_cast<double>(twice_area(posts[0], posts[1], posts[2]));
        return {area(posts[1], posts[2]) / whole, area(posts[2], posts[0]) / whole,
                area(posts[0], posts[1]) / whole};
    }
    [[nodiscard]] glm::dvec3 at(double row, double column) const {
        const auto shares = shares_at(row, column);
        return shares[0] * ecef_m[0] + shares[1] * ecef_m[1] + shares[2] * ecef_m[2];
    }
    [[nodiscard]] bool holds(double row, double column) const {
        const auto shares = shares_at(row, column);
        return std::min({shares[0], shares[1], shares[2]}) >= -1.0e-9;
    }
};

class Check {
  public:
    explicit Check(const ClusterTerrain& terrain) : terrain_(terrain) {}

    // From a place of the original to the one drawn in its stead, metres.
    void ask(const FlatTriangle3& drawn, double row, double column, double error_m) {
        const int rows = terrain_.heights.rows, columns = terrain_.heights.columns;
        const int cell_row = std::clamp(static_cast<int>(std::floor(row)), 0, rows - 2);
        const int cell_column = std::clamp(static_cast<int>(std::floor(column)), 0, columns - 2);
        const auto post = [&](int down, int right) {
            return terrain_.surface.vertex(
                static_cast<VertexNumber>((cell_row + down) * columns + cell_column + right));
        };
        const bool south_west = row - cell_row >= column - cell_column;
        const bool north_west = row - cell_row + column - cell_column <= 1.0;
        std::array corners = south_west ? std::array{post(0, 0), post(1, 1), post(1, 0)}
                                        : std::array{post(0, 0), post(0, 1), post(1, 1)};
        if (test::sw_ne_by_rule(terrain_.field, cell_row, cell_column))
            corners = north_west ? std::array{post(0, 0), post(0, 1), post(1, 0)}
                                 : std::array{post(0, 1), post(1, 1), post(1, 0)};
        const FlatTriangle3 original(terrain_.bounds, corners);
        const double off_m = glm::distance(original.at(row, column), drawn.at(row, column));
        ++asked_;
        if (off_m > error_m) ++beyond_;
        if (error_m > 0.0) share_ = std::max(share_, off_m / error_m);
    }

    // All posts and crossings of a triangle, and some places at random.
    void ask_all(const std::array<SurfaceVertex, 3>& corners, double error_m, std::mt19937_64& random) {
        const FlatTriangle3 drawn(terrain_.bounds, corners);
        const auto [top, bottom] = std::minmax({corners[0].row, corners[1].row, corners[2].row});
        const auto [west, east] = std::minmax({corners[0].column, corners[1].column, corners[2].column});
        for (int row = top; row <= bottom; ++row) {
            for (int column = west; column <= east; ++column) {
                if (drawn.holds(row, column)) ask(drawn, row, column, error_m);
            }
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const SurfaceVertex &a = corners[i], &b = corners[(i + 1) % 3];
            const double down = b.row - a.row, right = b.column - a.column;
            // Where the edge is on a row, a column, a diagonal.
            for (int line = std::min(top, west - bottom); line <= std::max(bottom, east); ++line) {
                for (const double at : {(line - a.row) / down, (line - a.column) / right,
                                        (line - (a.column - a.row)) / (right - down)}) {
                    if (at > 0.0 && at < 1.0) ask(drawn, a.row + at * down, a.column + at * right, error_m);
                }
            }
            for (int line = top + west; line <= bottom + east; ++line) {
                const double at = (line - (a.row + a.column)) / (down + right);
                if (at > 0.0 && at < 1.0) ask(drawn, a.row + at * down, a.column + at * right, error_m);
            }
        }
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (int i = 0; i < 6; ++i) {
            double u = unit(random), v = unit(random);
            if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
            const auto mix = [&](double a, double b, double c) { return a + u * (b - a) + v * (c - a); };
            ask(drawn, mix(corners[0].row, corners[1].row, corners[2].row),
                mix(corners[0].column, corners[1].column, corners[2].column), error_m);
        }
    }

    // Of every group, or of one in so many.
    void ask_groups(std::uint64_t seed, std::size_t one_in) {
        std::mt19937_64 random(seed);
        const ClusterGraph& graph = terrain_.graph;
        for (std::size_t i = random() % one_in; i < graph.groups.size(); i += one_in) {
            const ClusterGroup& group = graph.groups[i];
            for (std::uint32_t j = group.first_made; j < group.first_made + group.made; ++j) {
                for (const VertexTriangle& triangle : graph.triangles_of(graph.clusters[j]))
                    ask_all({terrain_.surface.vertex(triangle[0]), terrain_.surface.vertex(triangle[1]),
                             terrain_.surface.vertex(triangle[2])},
                            group.error_m, random);
            }
        }
    }

    std::size_t asked_{};
    std::size_t beyond_{};
    double share_{};  // of the certificate, the largest that was found

  private:
    const ClusterTerrain& terrain_;
};

// Never beyond, and reached in places: it is no mere bound.
void expect_kept(const ClusterTerrain& terrain, std::uint64_t seed, std::size_t one_in = 1) {
    Check check(terrain);
    check.ask_groups(seed, one_in);
    std::printf("seed %llu: %zu places, %zu beyond, largest share of the certificate %.6f\n",
                static_cast<unsigned long long>(seed), check.asked_, check.beyond_, check.share_);
    EXPECT_EQ(check.beyond_, 0U);
    EXPECT_GT(check.asked_, 10000U);
    EXPECT_LE(check.share_, 1.0);
    EXPECT_GT(check.share_, 0.9);
}

TEST(ClusterCertificate, HoldsOverRoughGround) {
    expect_kept(ClusterTerrain(rough_field(47.0, 8.0, 150, 140)), 11);
}

TEST(ClusterCertificate, HoldsAroundHoles) {
    expect_kept(ClusterTerrain(holed_field(110, 120, 9)), 12);
}

// All of a flat group's error is sag; steep walls near a pole.
TEST(ClusterCertificate, HoldsWhereSagIsAllThereIs) {
    const ClusterTerrain flat(flat_field(200, 200));
    Check check(flat);
    check.ask_groups(13, 1);
    EXPECT_EQ(check.beyond_, 0U);
    EXPECT_GT(check.share_, 0.3);
}

TEST(ClusterCertificate, HoldsInTheFarNorth) {
    expect_kept(ClusterTerrain(rough_field(89.0, 8.0, 100, 100)), 14);
}

TEST(ClusterCertificate, HoldsWithPostsFarApart) {
    HeightField field = made_field(60.0, 8.0, 20.0, 80, 90, rough_H_m);
    const ClusterTerrain terrain(std::move(field));
    Check check(terrain);
    check.ask_groups(15, 1);
    EXPECT_EQ(check.beyond_, 0U);
}

TEST(ClusterCertificate, HoldsOnANet) {
    const PlaneOfPosts plane{
        .rows = 90, .columns = 100, .middle = {46.5, 8.5}, .post_m = 30.0, .turn_deg = 20.0};
    const ClusterTerrain terrain(net_field(plane, [](double row, double column) {
        return static_cast<float>(1000.0 + 300.0 * std::sin(0.11 * row) * std::cos(0.13 * column) +
                                  40.0 * std::sin(1.1 * row + 0.7 * column));
    }));
    Check check(terrain);
    check.ask_groups(16, 1);
    EXPECT_EQ(check.beyond_, 0U);
    EXPECT_GT(check.share_, 0.9);
}

}  // namespace
}  // namespace oro

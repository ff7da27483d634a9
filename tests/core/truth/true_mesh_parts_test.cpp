// A mesh that is read part by part: lines meet what they meet of the whole, and read no more than they may
// meet.
#include "core/truth/true_mesh_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include "core/base/parallel.h"

namespace oro {
namespace {

// A rough sheet of n x n cells of 20 m in rows of parts, at 47 N 8 E.
class SheetInParts final : public TriangleSource {
  public:
    explicit SheetInParts(std::uint32_t n) : n_(n) {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> height(500.0, 540.0);
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t k = 0; k <= n; ++k)
                all_.vertices_m.push_back(
                    ecef_from_geodetic({47.0 + i * 20.0 / 111200.0, 8.0 + k * 20.0 / 76000.0, height(random)})
                        .m);
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t k = 0; k < n; ++k) {
                const std::uint32_t at = i * (n + 1) + k;
                all_.triangles.push_back({at, at + 1, at + n + 1});
                all_.triangles.push_back({at + 1, at + n + 2, at + n + 1});
            }
        for (std::uint32_t i = 0; i < all_.triangles.size(); ++i) all_.features.push_back(i % 9);
        for (std::size_t part = 0; part < parts(); ++part) {
            const MeshTriangles triangles = this->part(part)->triangles;
            Sphere sphere{triangles.vertices_m.front(), 0.0};
            for (const glm::dvec3& at : triangles.vertices_m)
                sphere.radius_m = std::max(sphere.radius_m, glm::distance(sphere.centre_m, at));
            spheres_.push_back(sphere);
        }
        reads = 0;
    }
    [[nodiscard]] const MeshTriangles& all() const { return all_; }
    [[nodiscard]] std::size_t parts() const { return n_; }
    [[nodiscard]] std::span<const Sphere> spheres() const override { return spheres_; }
    [[nodiscard]] std::size_t triangles() const override { return all_.triangles.size(); }
    [[nodiscard]] Result<Part> part(std::size_t number) const override {
        ++reads;
        if (number == damaged) return Error{ErrorKind::failed, "sheet", "is damaged"};
        Part part;
        for (std::uint32_t i = 0; i < 2 * n_; ++i) {
            const auto of_all = static_cast<std::uint32_t>(number) * 2 * n_ + i;
            part.numbers.push_back(of_all);
            part.triangles.features.push_back(all_.features[of_all]);
            std::array<std::uint32_t, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k) {
                corners[k] = static_cast<std::uint32_t>(part.triangles.vertices_m.size());
                part.triangles.vertices_m.push_back(all_.vertices_m[all_.triangles[of_all][k]]);
            }
            part.triangles.triangles.push_back(corners);
        }
        return part;
    }
    [[nodiscard]] Result<MeshTriangles> whole() const override {
        if (damaged < n_) return Error{ErrorKind::failed, "sheet", "is damaged"};
        return all_;
    }
    mutable std::atomic<int> reads{};
    std::size_t damaged{~std::size_t{0}};

  private:
    std::uint32_t n_;
    MeshTriangles all_;
    std::vector<Sphere> spheres_;
};

TEST(TrueMeshParts, LinesMeetWhatTheyMeetOfTheWhole) {
    const auto source = std::make_shared<const SheetInParts>(40U);
    const TrueMesh whole(source->all(), 3, 2), parts(source, 3, 2, 200000);
    EXPECT_EQ(parts.size(), 3200U);
    EXPECT_EQ(parts.number(), 3U);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(-0.01, 0.03), height(300.0, 2500.0);
    int met = 0, missed = 0;
    for (int i = 0; i < 60; ++i) {
        const Geodetic eye{47.0 + share(random), 8.0 + share(random), height(random)};
        Air air;
        air.k = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 0.13 : -1.0;
        const Refraction refraction(eye, air);
        const Ecef from = ecef_from_geodetic(eye);
        for (int k = 0; k < 60; ++k) {
            const glm::dvec3 aim = source->all().vertices_m[random() % source->all().vertices_m.size()];
            const glm::dvec3 beside(share(random) * 1e4, share(random) * 1e4, share(random) * 1e4);
            const glm::dvec3 direction = glm::normalize(aim + beside - from.m);
            const auto a = whole.first_hit(from, refraction, glm::dvec3(0.0), direction, 50000.0),
                       b = parts.first_hit(from, refraction, glm::dvec3(0.0), direction, 50000.0);
            ASSERT_EQ(a.has_value(), b.has_value());
            ++(a ? met : missed);
            if (!a) continue;
            EXPECT_EQ(a->along_m, b->along_m);  // to the bit
            EXPECT_EQ(a->triangle, b->triangle);
            EXPECT_EQ(a->feature, b->feature);
        }
    }
    EXPECT_GT(met, 1000);
    EXPECT_GT(missed, 500);
    EXPECT_TRUE(parts.health().ok());
}

TEST(TrueMeshParts, NearestPlacesAreThoseOfTheWhole) {
    const auto source = std::make_shared<const SheetInParts>(40U);
    const TrueMesh whole(source->all(), 1, 2), parts(source, 1, 2, 200000);
    std::mt19937 random(12);
    std::uniform_real_distribution<double> share(-0.002, 0.009), height(480.0, 700.0);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 at =
            ecef_from_geodetic({47.0 + share(random), 8.0 + share(random), height(random)}).m;
        const auto a = whole.nearest_m(at, 300.0), b = parts.nearest_m(at, 300.0);
        ASSERT_EQ(a.has_value(), b.has_value()) << "point " << i;
        if (!a) continue;
        EXPECT_NEAR(glm::distance(*a, at), glm::distance(*b, at), 1.0e-8) << "m";
    }
    const int before = source->reads;
    EXPECT_FALSE(parts.nearest_m(glm::dvec3(0.0), 300.0));
    EXPECT_EQ(source->reads, before) << "far away nothing is read";
}

// One line down reads the row that it meets, and perhaps those beside it; asked once more it reads none.
TEST(TrueMeshParts, ALineReadsTheNearPartsAlone) {
    const auto source = std::make_shared<const SheetInParts>(40U);
    const TrueMesh parts(source, 1, 2, 100'000'000);
    const Geodetic eye{47.0 + 0.5 * 800.0 / 111200.0, 8.0 + 0.5 * 800.0 / 76000.0, 2000.0};
    const Ecef from = ecef_from_geodetic(eye);
    const glm::dvec3 down = glm::normalize(ecef_from_geodetic({eye.lat_deg, eye.lon_deg, 0.0}).m - from.m);
    for (int i = 0; i < 2; ++i) {
        EXPECT_TRUE(parts.first_hit(from, Refraction(eye, Air{}), glm::dvec3(0.0), down, 5000.0));
        EXPECT_GE(source->reads, 1);
        EXPECT_LE(source->reads, 40);
    }
    const int before = source->reads;
    EXPECT_TRUE(parts.first_hit(from, Refraction(eye, Air{}), glm::dvec3(0.0), down, 5000.0));
    EXPECT_EQ(source->reads, before);
    EXPECT_EQ(parts.feature(5), 5U);  // asks all of them
    EXPECT_EQ(parts.vertices_m().size(), source->all().vertices_m.size());
}

// What cannot be read is told, whatever met it first.
TEST(TrueMeshParts, TellWhatCouldNotBeRead) {
    auto sheet = std::make_shared<SheetInParts>(12U);
    sheet->damaged = 3;
    const TrueMesh parts(sheet, 1, 2, 1000);
    EXPECT_TRUE(parts.health().ok());
    const Geodetic eye{47.0, 8.0, 2000.0};
    const Ecef from = ecef_from_geodetic(eye);
    std::atomic<int> met{0};
    in_parallel(400, 4, [&](int i) {
        const glm::dvec3 aim = sheet->all().vertices_m[static_cast<std::size_t>(i) * 7 % 169];
        if (parts.first_hit(from, Refraction(eye, Air{}), glm::dvec3(0.0), glm::normalize(aim - from.m),
                            5000.0))
            ++met;
    });
    EXPECT_GT(met, 100);
    ASSERT_FALSE(parts.health().ok());
    EXPECT_EQ(parts.health().error().line(), "sheet: is damaged");
    EXPECT_EQ(parts.size(), 288U);
    (void)parts.corners_m(287);  // none, but there
}

}  // namespace
}  // namespace oro

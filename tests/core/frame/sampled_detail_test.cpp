// The level at a place against the nodes that a frame is drawn with.
#include "core/frame/sampled_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>
#include <utility>
#include <vector>

#include "core/lod/levels.h"
#include "tests/core/lod/pyramid_region.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

using test::patchy_field, test::random_camera, test::Region, test::whole;

// A few cells of each node that is drawn, its corners among them.
struct Comparison {
    std::size_t cells{};
    std::size_t borderline{};
    int coarsest{};
};
void compare(const Region& region, const RegionPages& pages, const Camera& camera, double tau_px,
             std::mt19937_64& random, Comparison& comparison) {
    SampledDetail detail(pages, camera, tau_px);
    for (const DrawnNode& node : select_nodes(region.pyramid, camera, whole(camera), tau_px).nodes) {
        const int cells = static_cast<int>(gpu::meshlet_quads) << node.level;
        const int first_row = node.row * cells, first_column = node.column * cells;
        const int last_row = std::min(first_row + cells, region.field.grid.rows() - 1) - 1;
        const int last_column = std::min(first_column + cells, region.field.grid.columns() - 1) - 1;
        const std::pair<int, int> places[] = {
            {first_row, first_column},
            {last_row, last_column},
            {first_row + static_cast<int>(random() % static_cast<unsigned>(last_row - first_row + 1)),
             first_column +
                 static_cast<int>(random() % static_cast<unsigned>(last_column - first_column + 1))}};
        for (const auto& [row, column] : places) {
            const auto bound = detail.at(row, column);
            ASSERT_TRUE(bound.ok());
            ++comparison.cells;
            comparison.coarsest = std::max(comparison.coarsest, node.level);
            const SampledDetail::Bound& at = bound.value();
            ASSERT_LE(at.error_px, tau_px);
            if (at.level == node.level) {
                const double error_m =
                    at.level == 0
                        ? 0.0
                        : static_cast<double>(region.pyramid.levels[static_cast<std::size_t>(node.level)]
                                                  .node(node.row, node.column)
                                                  .error_m);
                // On a rim that of a coarser one beside it, if there is one.
                const int quad = 1 << node.level;
                const bool rim = row < first_row + quad || row >= first_row + cells - quad ||
                                 column < first_column + quad || column >= first_column + cells - quad;
                if (rim) {
                    ASSERT_GE(at.error_m, error_m);
                } else {
                    ASSERT_EQ(at.error_m, error_m);
                }
                continue;
            }
            // A frame works the node's centre out in float: the two may part where the error is tau itself.
            ++comparison.borderline;
            ASSERT_EQ(std::abs(at.level - node.level), 1);
        }
    }
}

TEST(SampledDetail, IsOfTheNodesThatAreDrawn) {
    constexpr unsigned seed = 601;
    std::mt19937_64 random(seed);
    HeightField with_voids = patchy_field(420, 470);
    for (int row = 130; row < 200; ++row) {
        for (int column = 129; column < 256; ++column)
            with_voids.H_m[static_cast<std::size_t>(row * 470 + column)] = void_height_m;
    }
    for (HeightField& field : std::vector{patchy_field(600, 521), std::move(with_voids)}) {
        const auto pages = pages_in_memory(field, 1.0, 2);
        const Region region(std::move(field));
        Comparison comparison;
        for (int i = 0; i < 60; ++i) {
            const Camera camera = random_camera(random, region);
            ASSERT_NO_FATAL_FAILURE(
                compare(region, *pages, camera, test::taus_px[i % 3], random, comparison));
        }
        std::printf("seed %u: %zu cells, levels to %d, %zu on the border\n", seed, comparison.cells,
                    comparison.coarsest, comparison.borderline);
        EXPECT_GT(comparison.cells, 5000U);
        EXPECT_GE(comparison.coarsest, 2);
        EXPECT_LE(comparison.borderline, comparison.cells / 10000);
    }
}

TEST(SampledDetail, IsExactAtTauZero) {
    HeightField field = patchy_field(300, 290);
    const auto pages = pages_in_memory(field, 1.0, 2);
    const Region region(std::move(field));
    std::mt19937_64 random(602);
    const Camera camera = random_camera(random, region);
    SampledDetail detail(*pages, camera, 0.0);
    for (int row = 0; row < 299; row += 7) {
        for (int column = 0; column < 289; column += 9) {
            const auto bound = detail.at(row, column);
            ASSERT_TRUE(bound.ok());
            ASSERT_EQ(bound.value().error_m, 0.0);
            ASSERT_EQ(bound.value().error_px, 0.0);
        }
    }
}

// Where the region's last column is its first again, a node there takes on the edge of a coarser one beyond
// it.
TEST(SampledDetail, WrapsAroundTheEarth) {
    // Rough in the west, from post to post; even in the east.
    const auto H_m = [](double lat_deg, double lon_deg) {
        return lon_deg < 0.0 ? 3000.0 * std::sin(9.6 * lat_deg) * std::sin(10.1 * lon_deg) : 0.0;
    };
    constexpr int per_deg = 4, rows = 40 * per_deg + 1, columns = 360 * per_deg + 1;
    const HeightField field = test::world_field(
        per_deg, 20 * per_deg, -180 * per_deg, rows, columns,
        [&](double lat, double lon) { return lon >= 180.0 ? H_m(lat, lon - 360.0) : H_m(lat, lon); });
    const auto pages = pages_in_memory(field, 1.0, 2);
    ASSERT_TRUE(pages->wraps_longitude());
    Camera camera;
    camera.eye = {3.0, 180.0, 400.0e3};
    camera.attitude = {0.0, -90.0, 0.0};
    camera.width_px = camera.height_px = 500;
    int taken_on = 0;
    for (const double tau_px : {1.0, 4.0, 16.0}) {
        SampledDetail detail(*pages, camera, tau_px);
        for (int row = 0; row < rows - 1; ++row) {
            const auto west = detail.at(row, 0);
            ASSERT_TRUE(west.ok());
            // In the middle of the node beyond: its own error, no other's.
            for (int level = pages->levels() - 1; level > 0; --level) {
                const int cells = static_cast<int>(gpu::meshlet_quads) << level;
                const int middle_row = row / cells * cells + cells / 2;
                const int middle_column = (columns - 2) / cells * cells + cells / 2;
                if (middle_row >= rows - 1 || middle_column >= columns - 1) continue;
                const auto beyond = detail.at(middle_row, middle_column);
                ASSERT_TRUE(beyond.ok());
                if (beyond->level != level || level <= west->level) continue;
                ++taken_on;
                ASSERT_GE(west->error_m, beyond->error_m) << "row " << row << ", tau " << tau_px;
                break;
            }
        }
    }
    EXPECT_GT(taken_on, 10) << "or nothing was seen";
}

// Through bending air a node is as far off as the frame takes it for: its error grows by its distance across
// the eye's vertical times the light's curvature.
TEST(SampledDetail, BendsLightAsTheFrameDoes) {
    const HeightField field = patchy_field(600, 521);
    const auto pages = pages_in_memory(field, 1.0, 2);
    Camera camera;
    camera.eye = {46.99, 8.01, 3000.0};
    camera.attitude = attitude_towards(camera.eye, {46.5, 8.4, 1000.0});
    const Air air{0.9};
    const Refraction light(camera.eye, air);
    SampledDetail straight(*pages, camera, 8.0), bent(*pages, camera, 8.0, light);
    int compared = 0;
    for (int row = 100; row < 590; row += 10) {
        for (int column = 100; column < 510; column += 10) {
            const auto before = straight.at(row, column), after = bent.at(row, column);
            ASSERT_TRUE(before.ok() && after.ok());
            if (before->level != after->level || before->error_m == 0.0) continue;
            const Geodetic place{field.grid.lat.at_deg(row), field.grid.lon.at_deg(column), 1000.0};
            const double across_m =
                glm::length(ecef_from_geodetic(place).m - ecef_from_geodetic(camera.eye).m);
            // A node is 8 x 8 of its level's cells, no longer than 150 m here.
            const double node_m = 1700.0 * (1 << before->level);
            const double growth = after->error_m / before->error_m - 1.0;
            EXPECT_NEAR(growth, light.curvature_per_m() * across_m, light.curvature_per_m() * 2.0 * node_m)
                << row << ", " << column;
            ++compared;
        }
    }
    EXPECT_GT(compared, 100);
}

// Behind a page that cannot be read there is no answer, but an error.
class TornPages : public RegionPages {
  public:
    explicit TornPages(const RegionPages& of) : RegionPages(of.facts()), of_(of) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override { return of_.record(page); }
    Result<void> load(const PageIndex&, gpu::PageBlock&) const override {
        return Error{ErrorKind::failed, "torn.oro", "ends too early"};
    }

  private:
    const RegionPages& of_;
};
TEST(SampledDetail, SaysWhenAPageCannotBeRead) {
    const auto pages = pages_in_memory(patchy_field(300, 290), 1.0, 2);
    const TornPages torn(*pages);
    Camera camera;
    camera.eye = {46.9, 8.1, 5000.0};
    SampledDetail detail(torn, camera, 1.0);
    const auto bound = detail.at(10, 10);
    ASSERT_FALSE(bound.ok());
    EXPECT_EQ(bound.error().where, "torn.oro");
}

}  // namespace
}  // namespace oro

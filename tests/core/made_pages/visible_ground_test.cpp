// Must hold: ground of made terrain that the oracle sees is never taken to be hidden, and lies between the
// distances and above the height that are told of it; most ground that is hidden is known to be.
#include "core/made_pages/visible_ground.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"
#include "tests/core/made_pages/made_ground.h"

namespace oro {
namespace {

constexpr double lowest_h_m = -201.0, highest_h_m = 4001.0;

class VisibleGroundOfTests : public testing::Test {
  protected:
    VisibleGroundOfTests()
        : field_(made_ground()),
          surface_(field_, 1.0, 1),
          ground_(surface_),
          terrain_(made_terrain_of_tests()),
          region_(made_region(terrain_, grid_of(terrain_), {})),
          coarse_(region_),
          occluder_(occluder_below(-201.0, 140.0)) {}

    [[nodiscard]] std::unique_ptr<VisibleGround> seen(const FrameView& view) const {
        return VisibleGround::of(coarse_, view, PictureCulling(view, occluder_), lowest_h_m, highest_h_m, 2);
    }
    // Of so many lines through a picture, places that the oracle sees and that are said to be hidden, or to
    // be elsewhere.
    struct Compared {
        int wrong{}, hits{};
        std::size_t nodes{}, listed{};
    };
    Compared compare(const FrameView& view, int lines, std::mt19937& random) const {
        Compared compared;
        const auto found = seen(view);
        if (!found) return compared;
        const Oracle oracle(ground_, sight_from(view.camera.eye, view.model.air));
        std::map<std::pair<int, int>, VisibleGround::Node> nodes;
        for (const VisibleGround::Node& node : found->nodes()) nodes[{node.row, node.column}] = node;
        std::map<std::pair<int, int>, bool> hit_nodes;
        for (int i = 0; i < lines; ++i) {
            const glm::dvec2 at{view.camera.width_px * share(random), view.camera.height_px * share(random)};
            const auto hit = oracle.first_hit(view.camera.ecef_direction_at(at), 1.0e6);
            if (!hit) continue;
            ++compared.hits;
            const std::pair<int, int> key{hit->row / 64, hit->column / 64};
            hit_nodes[key] = true;
            const auto node = nodes.find(key);
            const double distance_m =
                glm::distance(view.camera.eye_ecef().m, ecef_from_geodetic(hit->point).m);
            const bool is_right = found->may_show(3, key.first, key.second) &&
                                  found->may_show(6, key.first / 8, key.second / 8) && node != nodes.end() &&
                                  distance_m >= node->second.nearest_m &&
                                  distance_m <= node->second.farthest_m &&
                                  hit->point.h_m >= node->second.lowest_h_m;
            compared.wrong += is_right ? 0 : 1;
        }
        compared.nodes = hit_nodes.size();
        compared.listed = nodes.size();
        return compared;
    }
    static double share(std::mt19937& random) {
        return std::uniform_real_distribution<double>(0.0, 1.0)(random);
    }

    HeightField field_;
    TrueSurface surface_;
    TrueGround ground_;
    MadeTerrain terrain_;
    MadeRegion region_;
    CoarseGround coarse_;
    HorizonOccluder occluder_;
};

FrameView view_from(const Geodetic& eye, const Attitude& attitude, double fov_deg) {
    Camera camera;
    camera.eye = eye;
    camera.attitude = attitude;
    camera.vertical_fov_deg = fov_deg;
    camera.width_px = 640;
    camera.height_px = 360;
    return {camera, Tile{.width_px = 640, .height_px = 360}, 1.0};
}

TEST_F(VisibleGroundOfTests, HoldsAllThatTheOracleSees) {
    constexpr unsigned seed = 53;
    std::mt19937 random(seed);
    int hits = 0;
    for (int eye = 0; eye < 20; ++eye) {
        Geodetic at{46.05 + 1.6 * share(random), 8.05 + 1.6 * share(random), 0.0};
        at.h_m = *surface_.h_m(at.lat_deg, at.lon_deg) + 2.0 + 4000.0 * share(random) * share(random);
        FrameView view = view_from(at,
                                   {.heading_deg = 360.0 * share(random),
                                    .pitch_deg = 10.0 - 50.0 * share(random),
                                    .roll_deg = eye % 3 == 0 ? 360.0 * share(random) : 0.0},
                                   10.0 + 80.0 * share(random));
        if (eye % 2 == 0) view.model.air.k = 0.13;
        const Compared compared = compare(view, 1000, random);
        EXPECT_EQ(compared.wrong, 0) << "seed " << seed << ", eye " << eye;
        hits += compared.hits;
    }
    EXPECT_GT(hits, 5'000);
}

// Less than a third of the ground in the frustum is listed.
TEST_F(VisibleGroundOfTests, LeavesOutWhatHillsHide) {
    std::mt19937 random(53);
    const Geodetic at{46.3, 8.8, *surface_.h_m(46.3, 8.8) + 500.0};
    const FrameView view = view_from(at, {.heading_deg = 0.0, .pitch_deg = -4.0}, 30.0);
    const PictureCulling culling(view, occluder_);
    std::size_t in_frustum = 0;
    for (int row = 0; row < 32; ++row)
        for (int column = 0; column < 32; ++column) {
            PageBound bound;
            bound.centre = ecef_from_geodetic({grid_of(terrain_).lat.at_deg(64 * row + 32),
                                               grid_of(terrain_).lon.at_deg(64 * column + 32), 1900.0});
            bound.radius_m = 5000.0;
            bound.horizon.angle_rad = 4.0;
            in_frustum += culling.may_show(bound) ? 1 : 0;
        }
    const Compared compared = compare(view, 4000, random);
    std::printf("%zu nodes of level 3 in the frustum, %zu may show, the oracle sees %zu\n", in_frustum,
                compared.listed, compared.nodes);
    EXPECT_EQ(compared.wrong, 0);
    EXPECT_GT(compared.nodes, 5U);
    EXPECT_LT(3 * compared.listed, in_frustum);
}

}  // namespace
}  // namespace oro

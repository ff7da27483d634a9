// Frames of clusters against frames of nodes, and one way of drawing against the other.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/support/drawn/cluster_scene.h"
#include "tests/support/drawn/cracks.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/drawn/plain_style.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int side_px = test::crack_side_px;

struct Picture {
    test::DrawnFrame frame;
    std::vector<float> depths;
    std::vector<std::uint8_t> rgba;
};

class Clusters : public test::GpuTest {
  protected:
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 260, 310)};

    test::DrawnScene scene(RasterPath path, bool clusters, std::uint64_t bytes = std::uint64_t{64} << 20U) {
        test::DrawnScene drawn(*gpu_, pages_in_memory(terrain_.field, 1.0, 2), path, side_px, side_px);
        if (clusters) test::draw_by_clusters(*gpu_, terrain_, drawn.scene(), bytes);
        return drawn;
    }
    static Picture picture(test::DrawnScene& scene, const Camera& camera, double tau_px) {
        Picture drawn{scene.draw(camera, tau_px, test::plain_style()), {}, {}};
        drawn.depths = *scene.renderer().read_depths(side_px, side_px);
        drawn.rgba = *scene.renderer().read_picture(side_px, side_px);
        return drawn;
    }
};

class ClustersByPath : public Clusters, public ::testing::WithParamInterface<RasterPath> {};

// Where nothing may be left out both draw the original: the same pixels of ground, the same depth.
TEST_P(ClustersByPath, WithoutAnErrorAreTheOriginal) {
    constexpr unsigned seed = 311;
    test::DrawnScene nodes = scene(GetParam(), false), clusters = scene(GetParam(), true);
    std::mt19937_64 random(seed);
    std::size_t ground = 0, colours_off = 0;
    for (int i = 0; i < 20; ++i) {
        const Camera camera = test::random_camera(random, terrain_.field);
        const Picture a = picture(nodes, camera, 0.0), b = picture(clusters, camera, 0.0);
        for (std::size_t at = 0; at < a.depths.size(); ++at) {
            ASSERT_EQ(a.frame.ids[at] == 0, b.frame.ids[at] == 0) << "seed " << seed << ", camera " << i;
            // Corners come in another order: depths are rounded otherwise.
            ASSERT_NEAR(a.depths[at], b.depths[at], 4.0e-6F * a.depths[at]) << "camera " << i;
            ground += a.frame.ids[at] != 0 ? 1U : 0U;
            for (std::size_t c = 0; c < 4; ++c)
                colours_off += std::abs(int{a.rgba[4 * at + c]} - int{b.rgba[4 * at + c]}) > 2 ? 1U : 0U;
        }
    }
    std::printf("seed %u: 20 cameras, %zu pixels of ground, %zu colours off by more than 2\n", seed, ground,
                colours_off);
    EXPECT_GT(ground, 20000U);
    EXPECT_LE(colours_off, ground / 1000);
}

// The same picture twice, by another renderer and after others: the same bytes.
TEST_P(ClustersByPath, ThePictureIsTheSameAgain) {
    std::mt19937_64 random(312);
    test::DrawnScene first = scene(GetParam(), true), second = scene(GetParam(), true);
    std::vector<Camera> cameras;
    for (int i = 0; i < 6; ++i) cameras.push_back(test::random_camera(random, terrain_.field));
    std::vector<Picture> there;
    for (const Camera& camera : cameras) there.push_back(picture(first, camera, 1.0));
    for (std::size_t i = cameras.size(); i-- > 0;) {
        const Picture back = picture(second, cameras[i], 1.0);
        EXPECT_EQ(there[i].rgba, back.rgba) << "seed 312, camera " << i;
        EXPECT_EQ(there[i].frame.ids, back.frame.ids) << "seed 312, camera " << i;
    }
}

// With room for no more than the largest frame's clusters, what was there makes room, and pictures are as
// before.
TEST_P(ClustersByPath, MakeRoomForEachOther) {
    std::mt19937_64 random(313);
    test::DrawnScene all = scene(GetParam(), true);
    std::vector<Camera> cameras;
    std::size_t most = 0, sum = 0;
    for (int i = 0; i < 12; ++i) {
        cameras.push_back(test::random_camera(random, terrain_.field));
        const std::size_t drawn = picture(all, cameras.back(), 1.0).frame.plan.grids[0].clusters.drawn.size();
        most = std::max(most, drawn);
        sum += drawn;
    }
    ASSERT_GT(sum, 2 * most);
    test::DrawnScene few = scene(GetParam(), true, most * sizeof(gpu::ClusterBlock));
    for (const Camera& camera : cameras) {
        const Picture a = picture(all, camera, 1.0), b = picture(few, camera, 1.0);
        EXPECT_EQ(a.rgba, b.rgba) << "seed 313";
        EXPECT_LE(few.scene().grids()[0].clusters()->store().size(), most);
    }
}

INSTANTIATE_TEST_SUITE_P(Paths, ClustersByPath, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });

// Ids number the same clusters by either way; where pixels differ both triangles are as near.
TEST_F(Clusters, BothWaysShowTheSameTriangles) {
    constexpr unsigned seed = 314;
    test::DrawnScene mesh = scene(RasterPath::mesh, true), compute = scene(RasterPath::compute, true);
    std::mt19937_64 random(seed);
    std::size_t ground = 0, differ = 0, rims = 0;
    for (int i = 0; i < 25; ++i) {
        const Camera camera = test::random_camera(random, terrain_.field);
        const double tau_px = i % 3 == 0 ? 4.0 : 1.0;
        const Picture a = picture(mesh, camera, tau_px), b = picture(compute, camera, tau_px);
        EXPECT_EQ(a.frame.report.counts.triangles_drawn, b.frame.report.counts.triangles_drawn);
        EXPECT_EQ(a.frame.report.counts.meshlets_drawn, b.frame.report.counts.meshlets_drawn);
        for (std::size_t at = 0; at < a.depths.size(); ++at) {
            ground += a.frame.ids[at] != 0 ? 1U : 0U;
            if (a.frame.ids[at] == b.frame.ids[at]) continue;
            ++differ;
            rims += std::abs(a.depths[at] - b.depths[at]) > 1.0e-3F * std::max(a.depths[at], b.depths[at])
                        ? 1U
                        : 0U;
        }
    }
    std::printf("seed %u: 25 cameras, %zu pixels of ground, %zu show another triangle, %zu of them at rims\n",
                seed, ground, differ, rims);
    EXPECT_GT(ground, 20000U);
    EXPECT_LE(differ, ground / 100);
    EXPECT_LE(rims, ground / 500);
}

}  // namespace
}  // namespace oro

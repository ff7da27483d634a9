// Pixels of clusters are shaded as those of nodes, whatever the style asks for: compared where nothing is
// left out, so that both show the same triangles.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "core/lod/ground_means.h"
#include "core/terrain/ground.h"
#include "render/frame/picture_renderer.h"
#include "tests/support/drawn/cluster_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int width_px = 120, height_px = 80;

gpu::FrameStyle lit_style() {
    gpu::FrameStyle style{};
    style.tint_count = 1;
    style.tints[0].colour = gpu::vec3(0.5F);
    const double sun = 20.0 * std::numbers::pi / 180.0;
    style.sun_enu = gpu::vec3(0.0F, -std::cos(sun), std::sin(sun));
    style.ambient = 0.2F;
    style.relief = 1.0F;
    style.haze_distance_m = 1e5F;
    style.sky_scale_height_m = 8000.0F;
    style.shadows = 1;
    style.smooth_edges = 1;
    return style;
}

// Source of the air: S. Hillaire 2020, table 1.
gpu::FrameStyle in_air() {
    gpu::FrameStyle style = lit_style();
    style.sky_openness = 1;
    style.footprint = gpu::footprint_mean;
    gpu::AirModel& air = style.air;
    air.on = 1;
    air.molecules_per_m = {5.802e-6F, 13.558e-6F, 33.1e-6F};
    air.molecules_scale_m = 8000.0F;
    air.dust_extinction_per_m = 1.2522e-5F;
    air.dust_scattering_per_m = 1.1372e-5F;
    air.dust_scale_m = 1200.0F;
    air.dust_forward = 0.8F;
    air.ozone_per_m = {0.650e-6F, 1.881e-6F, 0.085e-6F};
    air.ground_albedo = 0.25F;
    air.exposure = 1.0F;
    return style;
}

gpu::FrameStyle as_map() {
    gpu::FrameStyle style = lit_style();
    style.colour_by = gpu::colour_by_slope;
    style.light = gpu::light_hillshade;
    style.contours.interval_m = 50.0F;
    return style;
}

class ClustersShaded : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 260, 310)};

    std::vector<std::uint8_t> draw(const gpu::FrameStyle& style, bool clusters) {
        auto scene = Scene::create(*gpu_, pages_in_memory(terrain_.field, 1.0, 2),
                                   {std::uint64_t{256} << 20U, 0}, HeightStorage::f32, asks_for_means(style));
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        if (clusters) test::draw_by_clusters(*gpu_, terrain_, *scene);
        Camera camera;
        camera.width_px = width_px;
        camera.height_px = height_px;
        camera.eye = {46.85, 8.12, ground_h_m(terrain_.field, 46.85, 8.12).value_or(0.0) + 900.0};
        camera.attitude.pitch_deg = -12.0;
        PictureOptions options;
        options.path = GetParam();
        options.tau_px = 0.0;
        std::vector<std::uint8_t> rows;
        const auto report = render_picture(*gpu_, *scene, camera, style, options,
                                           [&](std::span<const std::uint8_t> row) -> Result<void> {
                                               rows.insert(rows.end(), row.begin(), row.end());
                                               return {};
                                           },
                                           {});
        EXPECT_TRUE(report.ok()) << report.error().line();
        return rows;
    }

    void expect_alike(const char* name, const gpu::FrameStyle& style) {
        const std::vector<std::uint8_t> nodes = draw(style, false), clusters = draw(style, true);
        ASSERT_EQ(nodes.size(), clusters.size());
        std::size_t far = 0, differ = 0;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const int off = std::abs(int{nodes[i]} - int{clusters[i]});
            differ += off > 0 ? 1U : 0U;
            far += off > 8 ? 1U : 0U;
        }
        std::printf("%s: of %zu colours %zu differ, %zu by more than 8\n", name, nodes.size(), differ, far);
        // Places are rounded otherwise, and an edge that is smoothed may be found in a triangle or in the
        // next.
        EXPECT_LE(far, nodes.size() / 500);
        EXPECT_LE(differ, nodes.size() / 20);
    }
};

TEST_P(ClustersShaded, InSunlight) {
    expect_alike("sunlight, shadows, smooth edges", lit_style());
}
TEST_P(ClustersShaded, InAir) {
    expect_alike("air, shadows, open sky, means, smooth edges", in_air());
}
TEST_P(ClustersShaded, AsAMap) {
    expect_alike("slopes, hillshade, contours", as_map());
}

INSTANTIATE_TEST_SUITE_P(Paths, ClustersShaded, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });

}  // namespace
}  // namespace oro

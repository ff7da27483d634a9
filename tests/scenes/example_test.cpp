// From a file to a pixel, and from the pixel back to the ground: the program's main types together, as the
// comments above each of them show.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/parallel.h"
#include "core/terrain/ground.h"
#include "core/truth/oracle.h"
#include "geo/opening/open_region.h"
#include "geo/region/region.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

struct Seen {
    float depth;        // of the drawn pixel, reversed
    double distance_m;  // that the oracle finds in the same direction
};

Result<Seen> example(const std::string& path) {
    RegionRequest request;
    request.paths = {path};
    request.box = BoundingBox{-84.3, 36.5, -84.2, 36.6};
    ORO_TRY(const Region region, open_region(request));

    Camera camera{{36.55, -84.25, 0.0}, {30.0, -10.0, 0.0}, 45.0, 320, 240};  // heading, pitch, roll
    camera.eye.h_m = ground_h_m(region.grids[0].field, 36.55, -84.25, 1.0).value() + 100.0;

    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    ORO_TRY(Scene scene, Scene::create(*gpu, pages_in_memory(region.grids[0].field, 1.0, thread_count())));
    FrameRendererOptions options;
    options.extent = {320, 240};
    options.keep_depths = true;
    ORO_TRY(options.path, raster_path_for("auto", gpu->report()));
    ORO_TRY(FrameRenderer renderer, FrameRenderer::create(*gpu, options));
    ORO_TRY(FramePlan plan, scene.settled_plan({camera, {0, 0, 320, 240, {0.5, 0.5}}, 1.0}));
    ORO_TRY(const FrameReport report, renderer.draw(std::move(plan), {}));
    EXPECT_GT(report.counts.triangles_drawn, 0U);
    ORO_TRY(const std::vector<float> depths, renderer.read_depths(320, 240));

    const TrueSurface surface(region.grids[0].field, 1.0, thread_count());
    const Oracle oracle(surface, sight_from(camera.eye));
    const auto hit = oracle.first_hit(camera.ecef_direction_at({160.5, 180.5}), 1.0e6);
    if (!hit) return Error{ErrorKind::no_data, path, "the sight line meets no ground"};
    return Seen{depths[180 * 320 + 160], hit->distance_m};
}

// The pixel's depth is the near plane over the distance along the camera's axis: within a pixel's share of
// it.
TEST(Example, FromFileToPixelAndBack) {
    const auto seen = example((test::bundled_data() / "jacksboro.tif").string());
    ASSERT_TRUE(seen.ok()) << seen.error().line();
    const double along_axis =
        seen->distance_m * std::cos(std::atan(60.5 / 120.0 * std::tan(22.5 * M_PI / 180.0)));
    EXPECT_NEAR(near_plane_m / static_cast<double>(seen->depth) / along_axis, 1.0, 0.02);
}

}  // namespace
}  // namespace oro

#include "render/frame/calibration.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/frame/frame_plan.h"
#include "core/frame/region_pages.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"

namespace oro {
namespace {

constexpr int most_rounds = 5;
constexpr double rounds_end_s = 0.08;

// A frame for slow devices and one for fast ones, on which the first would time the setting out rather than
// the drawing (an H200: mesh 0.046 ms and compute 0.060 ms for the small one, 0.474 ms and 0.054 ms for the
// large one). Triangles are equally large in both.
struct FrameSize {
    int pages;  // along each side
    int width_px;
    int height_px;
};
constexpr FrameSize small_frame{1, 256, 144};
constexpr FrameSize large_frame{4, 1024, 576};
constexpr double fast_s = 1e-3;  // a small frame by both ways: the device is to draw the large one

// Hills on all scales down to the post spacing. A page is some 12 km x 8 km at 46 degrees north.
HeightField made_field(int pages) {
    constexpr double posts_per_deg = 1200.0;
    constexpr int octaves = 4;
    const int posts = pages * static_cast<int>(gpu::page_quads) + 1;
    HeightField field;
    field.grid.lat = {posts_per_deg, 46.0 + posts / posts_per_deg, 0, -1, posts};
    field.grid.lon = {posts_per_deg, 8.0, 0, 1, posts};
    std::vector<float> of_row, of_column;
    for (int post = 0; post < posts; ++post) {
        double height_m = 200.0, scale = 0.05;
        for (int octave = 0; octave < octaves; ++octave, height_m *= 0.5, scale *= 2.1) {
            of_row.push_back(static_cast<float>(height_m * std::sin(scale * post + octave)));
            of_column.push_back(static_cast<float>(std::cos(scale * post - octave)));
        }
    }
    field.H_m.reserve(field.grid.post_count());
    for (auto row = of_row.begin(); row != of_row.end(); row += octaves) {
        for (auto column = of_column.begin(); column != of_column.end(); column += octaves)
            field.H_m.push_back(std::inner_product(row, row + octaves, column, 750.0F));
    }
    return field;
}

// From over the southern part to the north: triangles of all sizes, most of them far.
Camera eye_over(const PostGrid& grid, const FrameSize& size) {
    Camera camera;
    camera.width_px = size.width_px;
    camera.height_px = size.height_px;
    camera.eye = {grid.south_deg() + 0.025 * size.pages, 0.5 * (grid.west_deg() + grid.east_deg()),
                  2000.0 * size.pages};
    camera.attitude.pitch_deg = -15.0;
    return camera;
}

// What both ways draw, ready on the GPU: the plan's pages are the scene's.
struct Terrain {
    Scene scene;
    FramePlan plan;
};

Result<Terrain> made_terrain(const Gpu& gpu, const FrameSize& size) {
    const HeightField field = made_field(size.pages);
    const auto most_pages = static_cast<std::uint64_t>(2 * size.pages * size.pages);
    ORO_TRY(Scene scene, Scene::create(gpu, pages_in_memory(field, 1.0, thread_count()),
                                       {most_pages * sizeof(gpu::PageBlock), 0}));
    const Camera camera = eye_over(field.grid, size);
    ORO_TRY(FramePlan plan,
            scene.settled_plan({camera, {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}}, 0.0}));
    assert(plan.is_settled());
    return Terrain{std::move(scene), std::move(plan)};
}

// Both ways of drawing.
struct Renderers {
    FrameRenderer mesh;
    FrameRenderer compute;
};

Result<Renderers> renderers_for(const Gpu& gpu, const FrameSize& size) {
    FrameRendererOptions options;
    options.extent = {static_cast<std::uint32_t>(size.width_px), static_cast<std::uint32_t>(size.height_px)};
    options.shades = false;
    options.path = RasterPath::mesh;
    ORO_TRY(FrameRenderer mesh, FrameRenderer::create(gpu, options));
    options.path = RasterPath::compute;
    ORO_TRY(FrameRenderer compute, FrameRenderer::create(gpu, options));
    return Renderers{std::move(mesh), std::move(compute)};
}

Result<double> frame_s(FrameRenderer& renderer, const FramePlan& plan) {
    ORO_TRY(const FrameReport report, renderer.draw(plan, {}));
    constexpr double tick_s = 1e-9;  // a time is a time, however coarse the device's clock
    return std::max(report.choose_s + report.raster_s, tick_s);
}

// The best of some frames by either way, in turn.
Result<void> time_frames(Renderers& renderers, const FramePlan& plan, Clock::time_point start,
                         Calibration& result) {
    // A driver may compile shaders when it first draws with them: those frames tell nothing.
    ORO_CHECK(frame_s(renderers.mesh, plan));
    ORO_CHECK(frame_s(renderers.compute, plan));
    result.mesh_s = result.compute_s = std::numeric_limits<double>::infinity();
    result.rounds = 0;
    do {
        ORO_TRY(const double mesh_s, frame_s(renderers.mesh, plan));
        ORO_TRY(const double compute_s, frame_s(renderers.compute, plan));
        result.mesh_s = std::min(result.mesh_s, mesh_s);
        result.compute_s = std::min(result.compute_s, compute_s);
        ++result.rounds;
    } while (result.rounds < most_rounds && seconds_since(start) < rounds_end_s);
    return {};
}

}  // namespace

Result<Calibration> calibrate(const Gpu& gpu) {
    assert(gpu.report().mesh_shader && gpu.report().compute_raster);
    const auto start = Clock::now();
    ORO_TRY(Renderers renderers, renderers_for(gpu, small_frame));
    Calibration result;
    {
        ORO_TRY(const Terrain terrain, made_terrain(gpu, small_frame));
        ORO_CHECK(time_frames(renderers, terrain.plan, start, result));
    }
    if (std::max(result.mesh_s, result.compute_s) < fast_s) {
        const VkExtent2D extent{large_frame.width_px, large_frame.height_px};
        ORO_CHECK(renderers.mesh.resize(extent));
        ORO_CHECK(renderers.compute.resize(extent));
        ORO_TRY(const Terrain terrain, made_terrain(gpu, large_frame));
        ORO_CHECK(time_frames(renderers, terrain.plan, start, result));
    }
    result.took_s = seconds_since(start);
    return result;
}

}  // namespace oro

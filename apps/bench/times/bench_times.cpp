#include "apps/bench/times/bench_times.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/bench/times/bench_passes.h"
#include "apps/bench/times/bench_region.h"
#include "core/base/elapsed.h"
#include "core/base/median.h"
#include "core/base/parallel.h"

namespace oro {

using nlohmann::ordered_json;

namespace {

// Triangles over those that the workgroups that were started have room for.
double lanes_used(const gpu::FrameCounts& counts) {
    const double lanes = static_cast<double>(gpu::meshlet_triangles) * counts.meshlets_drawn -
                         static_cast<double>(gpu::half_triangles) * counts.halves_left_out;
    return lanes == 0.0 ? 0.0 : counts.triangles_drawn / lanes;
}

// Longer than all that a view asks for takes to come.
constexpr double longest_wait_s = 60.0;

// As a picture's, which waits for all that it asks for, or as a window's.
Result<FramePlan> whole_plan(Scene& scene, const Camera& camera, const Tile& tile,
                             const BenchOptions& options) {
    if (!options.as_window) return scene.settled_plan({camera, tile, options.tau_px});
    return settled_as_window(scene, camera, tile, options);
}

}  // namespace

Result<FramePlan> settled_as_window(Scene& scene, const Camera& camera, const Tile& tile,
                                    const BenchOptions& options) {
    // What a device's choice lacks is known once it is drawn.
    if (options.choose_on_device) return scene.settled_plan({camera, tile, options.tau_px});
    for (const auto start = Clock::now(); seconds_since(start) < longest_wait_s;) {
        ORO_TRY(FramePlan plan, scene.plan({camera, tile, options.tau_px}));
        if (plan.is_settled()) return plan;
        ORO_TRY(const bool better, scene.advance());
        if (!better) std::this_thread::yield();
    }
    return Error{ErrorKind::failed, "--gpu-memory", "is too small for this view"};
}

Result<std::vector<RasterPath>> raster_paths_of(const BenchOptions& options, const DeviceReport& device) {
    std::vector<RasterPath> paths;
    for (const std::string& name : options.pipeline == "both" ? std::vector<std::string>{"compute", "mesh"}
                                                              : std::vector<std::string>{options.pipeline}) {
        ORO_TRY(const RasterPath path, raster_path_for(name, device));
        paths.push_back(path);
    }
    return paths;
}

Result<BenchTimes> time_frames(Scene& scene, FrameRenderer& renderer, const Camera& camera,
                               const BenchOptions& options) {
    const Tile tile{0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
    const gpu::FrameStyle& style = options.style;
    scene.require_fields(style);
    std::vector<double> choose, raster, shade, whole, planned, frame;
    TimesOfPasses passes;
    BenchTimes times;
    const auto beginning = Clock::now();
    ORO_TRY(FramePlan plan, whole_plan(scene, camera, tile, options));
    if (!plan.grids[0].missing.empty())
        return Error{ErrorKind::failed, "--gpu-memory", "is too small for this view"};
    ORO_TRY(times.first, renderer.draw(plan, style));
    times.settled_s = seconds_since(beginning);
    // Frames without a pause, until clocks are up, and then those that count.
    for (const auto start = Clock::now(); seconds_since(start) < options.warm_up_s;)
        ORO_CHECK(renderer.draw(plan, style));
    for (int i = 0; i < options.frames; ++i) {
        const auto start = Clock::now();
        ORO_TRY(times.last, renderer.draw(plan, style));
        frame.push_back(seconds_since(start));
        choose.push_back(times.last.choose_s);
        raster.push_back(times.last.raster_s);
        shade.push_back(times.last.shade_s);
        whole.push_back(times.last.gpu_s());
        passes.add(times.last.passes);
    }
    for (int i = 0; i < options.frames; ++i) {
        const auto start = Clock::now();
        ORO_CHECK(whole_plan(scene, camera, tile, options));
        planned.push_back(seconds_since(start));
    }
    times.passes = passes.medians();
    times.choose_s = median_of(std::move(choose));
    times.raster_s = median_of(std::move(raster));
    times.shade_s = median_of(std::move(shade));
    times.gpu_s = median_of(std::move(whole));
    times.plan_s = median_of(std::move(planned));
    times.frame_s = median_of(std::move(frame));
    const GridScene& grid = scene.grids()[0];
    times.pages_on_gpu = grid.store().size();
    times.bytes_on_gpu = grid.store().bytes();
    if (grid.clusters()) {
        times.clusters_on_gpu = grid.clusters()->store().size();
        times.clusters_in_cut = plan.grids[0].clusters.in_cut;
        times.clusters_coarser = plan.grids[0].clusters.drawn.size() - plan.grids[0].clusters.in_cut;
        times.bytes_on_gpu += grid.clusters()->store().bytes();
        times.bytes_of_groups = grid.clusters()->groups().bytes();
    }
    return times;
}

Result<FrameRenderer> renderer_for(const Gpu& gpu, RasterPath path, const BenchOptions& options) {
    FrameRendererOptions renderer_options;
    renderer_options.extent = {static_cast<std::uint32_t>(options.width_px),
                               static_cast<std::uint32_t>(options.height_px)};
    renderer_options.path = path;
    renderer_options.occlusion = options.occlusion == "on"    ? OcclusionUse::on
                                 : options.occlusion == "off" ? OcclusionUse::off
                                                              : OcclusionUse::if_it_pays;
    renderer_options.split = options.split;
    renderer_options.leave_out_small = options.leave_out_small;
    renderer_options.smooth_edges = options.style.smooth_edges != 0;
    renderer_options.time_passes = options.passes;
    return FrameRenderer::create(gpu, renderer_options);
}

Result<double> peak_triangles_per_s(const Gpu& gpu, RasterPath path, BenchOptions options) {
    const HeightField field = made_region(512);
    ORO_TRY(Scene scene, Scene::create(gpu, pages_in_memory(field, 1.0, thread_count())));
    ORO_TRY(FrameRenderer renderer, renderer_for(gpu, path, options));
    options.tau_px = 0.0;
    options.style = bench_style();
    const Camera camera = eye_above(field, options.width_px, options.height_px);
    ORO_TRY(const BenchTimes times, time_frames(scene, renderer, camera, options));
    return times.last.counts.triangles_drawn / times.raster_s;
}

Result<std::uint64_t> pixels_without_occlusion(const Gpu& gpu, RasterPath path, Scene& scene,
                                               FrameRenderer& renderer, Camera camera, BenchOptions options) {
    options.occlusion = "off";
    options.leave_out_small = false;
    ORO_TRY(FrameRenderer plain, renderer_for(gpu, path, options));
    const auto width = static_cast<std::uint32_t>(options.width_px),
               height = static_cast<std::uint32_t>(options.height_px);
    std::uint64_t differ = 0;
    struct Step {
        double north_deg, up_m, turn_deg;
    };
    for (const Step& step :
         {Step{}, Step{}, Step{1e-6, 0.0, 0.1}, Step{1e-5, 0.0, 1.0}, Step{1e-3, 5.0, 20.0},
          Step{0.0, 0.0, 90.0}, Step{0.01, 0.0, 1.0}, Step{-0.04, 20.0, 120.0}}) {
        camera.eye.lat_deg += step.north_deg;
        camera.eye.h_m += step.up_m;
        camera.attitude.heading_deg = std::fmod(camera.attitude.heading_deg + step.turn_deg, 360.0);
        ORO_TRY(FramePlan plan,
                scene.settled_plan(
                    {camera, {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}}, options.tau_px}));
        ORO_CHECK(renderer.draw(plan, options.style));
        ORO_CHECK(plain.draw(plan, options.style));
        ORO_TRY(const std::vector<std::uint32_t> with, renderer.read_ids(width, height));
        ORO_TRY(const std::vector<std::uint32_t> without, plain.read_ids(width, height));
        for (std::size_t i = 0; i < with.size(); ++i) differ += with[i] != without[i] ? 1U : 0U;
    }
    return differ;
}

ordered_json times_json(const BenchTimes& times) {
    const gpu::FrameCounts& counts = times.last.counts;
    ordered_json json = ordered_json::object();
    json["gpu_ms"] = 1e3 * times.gpu_s;
    json["choose_ms"] = 1e3 * times.choose_s;
    json["raster_ms"] = 1e3 * times.raster_s;
    json["shade_ms"] = 1e3 * times.shade_s;
    for (const PassTime& one : times.passes) json["passes_ms"][one.pass] = 1e3 * one.s;
    json["cpu_plan_ms"] = 1e3 * times.plan_s;
    json["cpu_frame_ms"] = 1e3 * times.frame_s;
    json["first_settled_ms"] = 1e3 * times.settled_s;
    json["triangles"] = counts.triangles_drawn;
    json["triangles_left_out"] = counts.triangles_left_out;
    json["meshlets"] = counts.meshlets_drawn;
    json["halves_left_out"] = counts.halves_left_out;
    json["lanes_used"] = lanes_used(counts);
    json["task_workgroups"] = counts.task_groups;
    json["mesh_workgroups"] = counts.mesh_groups;
    json["pages_in_frame"] = times.last.pages;
    json["pages_live"] = counts.pages_live;
    json["meshlets_tested"] = counts.meshlets_tested;
    json["meshlets_hidden"] = counts.meshlets_hidden;
    json["meshlets_drawn_later"] = counts.meshlets_drawn_later;
    json["first_raster_ms"] = 1e3 * times.first.raster_s;
    json["first_meshlets"] = times.first.counts.meshlets_drawn;
    json["pages_on_gpu"] = times.pages_on_gpu;
    json["bytes_on_gpu"] = times.bytes_on_gpu;
    if (times.clusters_on_gpu > 0) {
        json["clusters_on_gpu"] = times.clusters_on_gpu;
        json["bytes_of_groups"] = times.bytes_of_groups;
        json["clusters_in_cut"] = times.clusters_in_cut;
        json["clusters_coarser"] = times.clusters_coarser;
    }
    json["triangles_per_s"] = counts.triangles_drawn / times.raster_s;
    return json;
}

}  // namespace oro

// Frames of one eye, timed: what each mode of the benchmark does with an eye.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/bench/times/bench_options.h"
#include "core/earth/camera.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"

namespace oro {

// Medians over the frames that count.
struct BenchTimes {
    FrameReport first;  // of a renderer that knows nothing of the frame before
    FrameReport last;
    double choose_s{};
    double raster_s{};
    double shade_s{};
    double gpu_s{};
    double plan_s{};               // processor: pages chosen
    double frame_s{};              // processor: a frame that is planned, the wait for the GPU included
    std::vector<PassTime> passes;  // where they are asked for
    double settled_s{};            // the first frame, with all that had to be read
    std::size_t pages_on_gpu{};
    std::uint64_t bytes_on_gpu{};
    std::size_t clusters_on_gpu{};
    std::uint64_t bytes_of_groups{};  // of the processor's memory
    std::size_t clusters_in_cut{};    // that the frame is offered: those of the processor's cut,
    std::size_t clusters_coarser{};   // and those above them, of which the GPU makes its own
};

// The ways of drawing that are asked for.
Result<std::vector<RasterPath>> raster_paths_of(const BenchOptions& options, const DeviceReport& device);
Result<FrameRenderer> renderer_for(const Gpu& gpu, RasterPath path, const BenchOptions& options);
// A plan as a window makes it, of what is here, once that is all. Errors: --gpu-memory that is too small; the
// device.
Result<FramePlan> settled_as_window(Scene& scene, const Camera& camera, const Tile& tile,
                                    const BenchOptions& options);
// Errors: --gpu-memory that is too small for the view; the device.
Result<BenchTimes> time_frames(Scene& scene, FrameRenderer& renderer, const Camera& camera,
                               const BenchOptions& options);
// Triangles a second that a way of drawing reaches when all of them are visible and small.
Result<double> peak_triangles_per_s(const Gpu& gpu, RasterPath path, BenchOptions options);
// Pixels whose triangle is another without occlusion, and with all small triangles: from the eye, and from
// eyes a step or a turn away, one after the other.
Result<std::uint64_t> pixels_without_occlusion(const Gpu& gpu, RasterPath path, Scene& scene,
                                               FrameRenderer& renderer, Camera camera, BenchOptions options);
nlohmann::ordered_json times_json(const BenchTimes& times);

}  // namespace oro

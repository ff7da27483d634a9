// What orograph-bench is asked for.
#pragma once

#include <cstdint>
#include <string>

#include "apps/bench/bench_style.h"
#include "core/frame/height_quantization.h"
#include "render/device/gpu.h"
#include "render/device/raster_request.h"
#include "render/pipelines/pipelines.h"

namespace oro {

struct BenchOptions {
    std::string region;  // a region file; "": terrain by a formula
    std::string path;    // of eyes
    int patches{64};     // of the formula's terrain: along each side, 8 x 8 quads each
    int frames{30};
    double warm_up_s{1.0};   // of frames that do not count, before those of an eye
    std::string style_file;  // "": bench_style()
    gpu::FrameStyle style{bench_style()};
    double sun_azimuth_deg{315.0};
    double sun_elevation_deg{45.0};
    int width_px{1920};
    int height_px{1080};
    std::string pipeline{raster_requests.front().first};  // or "both"
    std::string occlusion{"auto"};
    bool compare_occlusion{false};
    double tau_px{1.0};
    int gpu_memory_mb{0};
    std::string mesh{"grid"};  // or "clusters"; of flights "both"
    bool as_window{false};     // plans of what is here, as a window's, in place of those that wait
    HeightStorage heights{HeightStorage::f32};
    MeshletSplit split{MeshletSplit::by_device};
    bool leave_out_small{false};   // mesh path: triangles that cover no pixel's centre
    int random_eyes{0};            // 0: those of `path`
    int moving{0};                 // flights; 0: eyes that rest
    double frame_rate_hz{0.0};     // of flights: frames that are begun a second; 0: as many as there can be
    bool plan_on_device{false};    // plans leave to the device what it can make of them
    bool choose_on_device{false};  // ... and the choice of pages
    bool compare_plans{false};     // of flights: by the processor and by the device
    bool fingerprint{false};       // of flights: of their plans, in place of times
    std::uint64_t seed{1};         // of random eyes and flights
    int houses{0};                 // before each eye, beside frames without them; 0: none
    bool tables{false};
    bool floor{false};
    bool passes{false};  // of shading, each by itself
    bool json{false};
};

}  // namespace oro

// What --pipeline auto means on a device: the faster way of drawing, measured once and remembered in the
// user's cache folder for that device, driver and version of the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "render/device/gpu.h"

namespace oro {

// GPU times of one calibration frame (render/frame/calibration.h) by either way, and when they were taken.
struct PipelineTimes {
    double mesh_s{};
    double compute_s{};
    std::int64_t measured_utc_s{};
};

// OROGRAPH_CACHE, else `orograph` in $XDG_CACHE_HOME, else in $HOME/.cache. Empty where none of them is set;
// the latter two count only as absolute paths.
std::filesystem::path cache_folder();

// What the cache folder holds of this device with this driver, as this version of the program measured it;
// nothing where it is missing, unreadable or damaged.
std::optional<PipelineTimes> remembered_times(const DeviceReport& device);
// Adds to what the cache folder holds, which is made if need be; true when it is there now.
bool remember_times(const DeviceReport& device, const PipelineTimes& times);

// What auto chooses, and from what.
struct PipelineChoice {
    RasterPath path{RasterPath::mesh};
    std::optional<PipelineTimes> times;  // nothing: the device has one way only
    bool measured_now{false};
};

// For a device that can draw. Measures (up to some 0.1 s; a driver that compiles shaders anew may take
// longer) where a device has both ways and nothing is remembered, at most once a run for a device. Errors:
// those of the device.
Result<PipelineChoice> choose_pipeline(const Gpu& gpu);
// Without measuring: nothing where that would be needed.
std::optional<PipelineChoice> known_choice(const DeviceReport& device);

// "compute: 3.1 times faster than mesh shaders here (measured 2026-11-21)", "mesh: the only way here".
std::string text_of(const PipelineChoice& choice);

// The way that a request ("auto", "mesh", "compute") means on a device. A processor that stands in for a GPU
// draws by `compute` unless choose_pipeline() has found otherwise before: to measure takes it longer than to
// draw (docs/notes, first-picture-without-a-gpu). Errors: those of choose_pipeline(), and as
// raster_path_for().
Result<RasterPath> choose_path(const std::string& request, const Gpu& gpu);

}  // namespace oro

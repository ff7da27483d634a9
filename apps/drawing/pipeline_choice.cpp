#include "apps/drawing/pipeline_choice.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/settings/user_folders.h"
#include "geo/files/whole_file.h"
#include "render/device/raster_request.h"
#include "render/frame/calibration.h"

namespace oro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr int cache_format = 1;
constexpr std::size_t most_remembered = 32;  // drivers come and go: the oldest are forgotten
constexpr double longest_s = 1e4;
constexpr std::int64_t last_second = 253402300799;  // of the year 9999

bool has_both_ways(const DeviceReport& device) {
    return device.mesh_shader && device.compute_raster;
}

PipelineChoice choice_of(const PipelineTimes& times, bool measured_now) {
    return {times.mesh_s <= times.compute_s ? RasterPath::mesh : RasterPath::compute, times, measured_now};
}

fs::path cache_file() {
    const fs::path folder = cache_folder();
    return folder.empty() ? fs::path() : folder / "pipelines.json";
}

bool is_about(const json& entry, const DeviceReport& device) {
    return json_string(entry, "device") == device.name && json_string(entry, "driver") == device.driver &&
           json_string(entry, "program") == OROGRAPH_VERSION;
}

PipelineTimes times_of(const json& entry) {
    constexpr double shortest_s = 1e-9;
    return {json_number(entry, "mesh_s", shortest_s, longest_s),
            json_number(entry, "compute_s", shortest_s, longest_s),
            json_whole(entry, "measured_utc_s", 0, last_second)};
}

// The entries of the cache, oldest first; none where it cannot be understood.
std::vector<json> entries_in(const fs::path& file) {
    const auto text = file.empty() ? Result<std::string>(std::string()) : read_own_text_file(file.string());
    if (!text.ok() || text->empty()) return {};
    try {
        const json all = parsed_json(*text);
        if (json_whole(all, "orograph_pipelines", 0, INT64_MAX) != cache_format) return {};
        const json& measured = json_field(all, "measured");
        if (!measured.is_array()) return {};
        return {measured.begin(), measured.end()};
    } catch (const JsonFault&) {
        return {};
    }
}

// Where an entry is damaged, the others still count.
bool is_valid(const json& entry, const DeviceReport& device, PipelineTimes& times) {
    try {
        if (!is_about(entry, device)) return false;
        times = times_of(entry);
        return true;
    } catch (const JsonFault&) {
        return false;
    }
}

// Of this run: where nothing can be kept, nothing is measured twice all the same. By device and driver.
std::map<std::pair<std::string, std::string>, PipelineTimes>& measured_in_this_run() {
    static std::map<std::pair<std::string, std::string>, PipelineTimes> times;
    return times;
}

Result<PipelineTimes> measure(const Gpu& gpu) {
    const DeviceReport& device = gpu.report();
    auto& known = measured_in_this_run();
    const std::pair key{device.name, device.driver};
    if (const auto found = known.find(key); found != known.end()) return found->second;
    ORO_TRY(const Calibration calibration, calibrate(gpu));
    const PipelineTimes times{calibration.mesh_s, calibration.compute_s,
                              std::clamp<std::int64_t>(time_now_s(), 0, last_second)};
    known[key] = times;
    remember_times(device, times);
    return times;
}

}  // namespace

fs::path cache_folder() {
    const auto folder = user_cache_folder();
    return folder.ok() ? *folder : fs::path();
}

std::optional<PipelineTimes> remembered_times(const DeviceReport& device) {
    std::optional<PipelineTimes> newest;
    for (const json& entry : entries_in(cache_file())) {
        PipelineTimes times;
        if (is_valid(entry, device, times)) newest = times;
    }
    return newest;
}

bool remember_times(const DeviceReport& device, const PipelineTimes& times) {
    const fs::path file = cache_file();
    if (file.empty()) return false;
    std::error_code failed;
    fs::create_directories(file.parent_path(), failed);
    if (failed) return false;
    std::vector<json> entries = entries_in(file);
    std::erase_if(entries, [&](const json& entry) {
        PipelineTimes old;
        return is_valid(entry, device, old);
    });
    if (entries.size() >= most_remembered)
        entries.erase(entries.begin(),
                      entries.begin() + static_cast<std::ptrdiff_t>(entries.size() - most_remembered + 1));
    entries.push_back(json_object<json>("device", device.name, "driver", device.driver, "program",
                                        OROGRAPH_VERSION, "mesh_s", times.mesh_s, "compute_s",
                                        times.compute_s, "measured_utc_s", times.measured_utc_s));
    const ordered_json all = json_object("orograph_pipelines", cache_format, "measured", entries);
    return write_whole_file(file.string(), json_text(all, true) + "\n", true).ok();
}

std::optional<PipelineChoice> known_choice(const DeviceReport& device) {
    if (!has_both_ways(device))
        return PipelineChoice{device.mesh_shader ? RasterPath::mesh : RasterPath::compute, {}, false};
    if (const auto times = remembered_times(device)) return choice_of(*times, false);
    return std::nullopt;
}

Result<PipelineChoice> choose_pipeline(const Gpu& gpu) {
    if (const auto known = known_choice(gpu.report())) return *known;
    ORO_TRY(const PipelineTimes times, measure(gpu));
    return choice_of(times, true);
}

std::string text_of(const PipelineChoice& choice) {
    const std::string path = name_of(choice.path);
    if (!choice.times) return path + ": the only way here";
    const auto [mesh_s, compute_s, measured_utc_s] = *choice.times;
    const double ratio = mesh_s > compute_s ? mesh_s / compute_s : compute_s / mesh_s;
    const std::string other = choice.path == RasterPath::mesh ? "compute" : "mesh shaders";
    char faster[60];
    std::snprintf(faster, sizeof faster, ": %.1f times faster than ", ratio);
    const std::string when =
        choice.measured_now ? "now, for the first time" : time_text(measured_utc_s).substr(0, 10);
    return path + (ratio < 1.05 ? ": as fast as " : faster) + other + " here (measured " + when + ")";
}

Result<RasterPath> choose_path(const std::string& request, const Gpu& gpu) {
    if (raster_request_named(request) != RasterRequest::automatic || !has_both_ways(gpu.report()))
        return raster_path_for(request, gpu.report());
    const bool is_processor = gpu.report().kind == VK_PHYSICAL_DEVICE_TYPE_CPU;
    if (is_processor && !remembered_times(gpu.report())) return RasterPath::compute;
    ORO_TRY(const PipelineChoice choice, choose_pipeline(gpu));
    return choice.path;
}

}  // namespace oro

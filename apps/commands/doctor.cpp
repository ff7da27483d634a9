// orograph doctor: what this machine has, and what each lack means.
#include <cstdio>

#include "apps/commands/commands.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/output/data_folder.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "geo/sources/library_report.h"
#include "render/device/device_words.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

bool has_data_folder() {
    std::error_code unreadable;
    return std::filesystem::is_directory(data_folder(), unreadable);
}

std::vector<std::string> lacks_of(const DeviceReport& device) {
    std::vector<std::string> words;
    for (const DeviceLack lack : device.lacks) words.push_back(lack_words(lack));
    return words;
}

std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    return all;
}

// A device, and what --pipeline auto chooses on it: nothing where it cannot draw or does not let itself be
// measured.
struct Finding {
    DeviceReport device;
    std::optional<PipelineChoice> choice;
    std::string no_choice;  // why there is none

    [[nodiscard]] std::string choice_text() const { return choice ? text_of(*choice) : no_choice; }
};

// Number `number` of the survey, which may have to be measured first.
Finding finding_of(const DeviceReport& device, std::size_t number, GpuOptions options) {
    if (!device.can_draw()) return {device, {}, "the device cannot draw"};
    if (const auto known = known_choice(device)) return {device, known, ""};
    std::string problem = "the device cannot be told from another";
    // Its name may be a part of another's, and its number, too.
    for (const std::string& name : {device.name, std::to_string(number)}) {
        options.device_name = name;
        const auto gpu = Gpu::create(options);
        if (!gpu.ok()) {
            problem = gpu.error().line();
            continue;
        }
        if ((*gpu)->report().name != device.name || (*gpu)->report().driver != device.driver) continue;
        const auto choice = choose_pipeline(**gpu);
        if (choice.ok()) return {device, *choice, ""};
        return {device, {}, choice.error().line()};
    }
    return {device, {}, problem};
}

ordered_json choice_json(const Finding& finding) {
    ordered_json json = json_object("pipeline", nullptr, "why", finding.choice_text(), "mesh_ms", nullptr,
                                    "compute_ms", nullptr, "measured", nullptr, "measured_now", false);
    if (!finding.choice) return json;
    json["pipeline"] = name_of(finding.choice->path);
    json["measured_now"] = finding.choice->measured_now;
    if (const auto& times = finding.choice->times) {
        json["mesh_ms"] = 1e3 * times->mesh_s;
        json["compute_ms"] = 1e3 * times->compute_s;
        json["measured"] = time_text(times->measured_utc_s);
    }
    return json;
}

ordered_json mesh_shader_json(const DeviceReport& d) {
    ordered_json json = json_object("present", d.mesh_shader);
    json["preferred_task_invocations"] = d.mesh.preferred_task_invocations;
    json["preferred_mesh_invocations"] = d.mesh.preferred_mesh_invocations;
    json["max_task_invocations"] = d.mesh.max_task_invocations;
    json["max_mesh_invocations"] = d.mesh.max_mesh_invocations;
    json["max_output_vertices"] = d.mesh.max_output_vertices;
    json["max_output_primitives"] = d.mesh.max_output_primitives;
    json["max_task_groups_total"] = d.mesh.max_task_groups_total;
    return json;
}

ordered_json device_json(const Finding& finding) {
    const DeviceReport& d = finding.device;
    ordered_json json = ordered_json::object();
    json["name"] = d.name;
    json["type"] = kind_words(d.kind);
    json["driver"] = d.driver;
    json["api"] = version_words(d.vulkan_version);
    json["can_draw"] = d.can_draw();
    json["lacks"] = lacks_of(d);
    json["mesh_shader"] = mesh_shader_json(d);
    json["pipelines"] = json_object("mesh", d.mesh_shader, "compute", d.compute_raster);
    json["auto"] = choice_json(finding);
    json["subgroup_size"] = d.subgroup_size;
    json["max_picture_side_px"] = d.max_picture_side_px;
    json["memory_bytes"] = d.memory_bytes;
    return json;
}

ordered_json geoid_json(const GeoidGridReport& g) {
    ordered_json json = json_object("name", g.name, "file", g.file, "found", g.found, "damage", nullptr);
    if (!g.damage.empty()) json["damage"] = g.damage;
    json["meaning"] = g.meaning;
    return json;
}

ordered_json doctor_json(const std::vector<Finding>& devices, const std::string& no_device,
                         const LibraryReport& libraries) {
    ordered_json json = ordered_json::object();
    json["version"] = OROGRAPH_VERSION;
    json["devices"] = ordered_json::array();
    for (const Finding& device : devices) json["devices"].push_back(device_json(device));
    json["device_problem"] = nullptr;
    if (!no_device.empty()) json["device_problem"] = no_device;
    json["libraries"] =
        json_object("gdal", libraries.gdal, "proj", libraries.proj, "geographiclib", libraries.geographiclib);
    json["geoids"] = ordered_json::array();
    for (const GeoidGridReport& g : libraries.geoids) json["geoids"].push_back(geoid_json(g));
    json["data_folder"] = json_object("path", data_folder().string(), "found", has_data_folder());
    return json;
}

// "23.5 GiB"
std::string memory_text(std::uint64_t bytes) {
    constexpr double gib = 1024.0 * 1024.0 * 1024.0;
    char text[40];
    std::snprintf(text, sizeof text, "%.1f GiB", static_cast<double>(bytes) / gib);
    return text;
}

void print_device(std::size_t number, const Finding& finding) {
    const DeviceReport& d = finding.device;
    std::printf("GPU %zu        %s (%s), %s, Vulkan %s\n", number, d.name.c_str(), kind_words(d.kind).c_str(),
                d.driver.c_str(), version_words(d.vulkan_version).c_str());
    if (!d.can_draw()) {
        std::printf(
            "             cannot draw: lacks %s; a current driver for it, or the software driver "
            "(scripts/set-up), is needed\n",
            joined(lacks_of(d)).c_str());
        return;
    }
    std::printf("             draws with mesh shaders: %s\n",
                d.mesh_shader ? "yes" : "no (VK_EXT_mesh_shader is missing); with compute shaders alone");
    std::printf("             draws with compute shaders: %s\n",
                d.compute_raster ? "yes" : "no (64-bit atomics are missing); with mesh shaders alone");
    std::printf("             --pipeline auto%s %s\n", finding.choice ? " takes" : ":",
                finding.choice_text().c_str());
    std::printf("             pictures in parts of up to %u px a side, %s of memory\n", d.max_picture_side_px,
                memory_text(d.memory_bytes).c_str());
    if (d.kind == VK_PHYSICAL_DEVICE_TYPE_CPU)
        std::printf("             draws without a GPU: correct, but slow\n");
}

void print_doctor(const std::vector<Finding>& devices, const std::string& no_device,
                  const LibraryReport& libraries) {
    std::printf("orograph     %s\n", OROGRAPH_VERSION);
    for (std::size_t i = 0; i < devices.size(); ++i) print_device(i, devices[i]);
    if (!no_device.empty()) std::printf("GPU          none: %s\n", no_device.c_str());
    std::printf("GDAL         %s\nPROJ         %s\nGeographicLib %s\n", libraries.gdal.c_str(),
                libraries.proj.c_str(), libraries.geographiclib.c_str());
    for (const GeoidGridReport& g : libraries.geoids) {
        const std::string state = !g.found           ? "not found"
                                  : g.damage.empty() ? "found"
                                                     : "DAMAGED: " + g.damage;
        std::printf("geoid        %s: %s %s; %s\n", g.name.c_str(), g.file.c_str(), one_line(state).c_str(),
                    g.meaning.c_str());
    }
    std::printf("data         %s%s\n", data_folder().c_str(),
                has_data_folder() ? "" : " (not there: styles must be given by path)");
}

}  // namespace

Result<void> run_doctor(const DoctorOptions& options) {
    const GpuOptions gpu_options = gpu_options_from_environment();
    const auto devices = Gpu::survey(gpu_options);
    const std::string no_device = devices.ok() ? "" : devices.error().line();
    std::vector<Finding> found;
    for (std::size_t i = 0; devices.ok() && i < devices->size(); ++i)
        found.push_back(finding_of((*devices)[i], i, gpu_options));
    const LibraryReport libraries = report_libraries();
    if (options.json) {
        std::printf("%s\n", json_text(doctor_json(found, no_device, libraries), true).c_str());
    } else {
        print_doctor(found, no_device, libraries);
    }
    return {};
}

}  // namespace oro

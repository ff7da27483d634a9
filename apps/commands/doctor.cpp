// orograph doctor: what this machine has, and what each lack means.
#include <cstdio>

#include "apps/commands/commands.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/library_versions.h"
#include "apps/styles/data_folder.h"
#include "geo/sources/library_report.h"
#include "render/device/device_report.h"

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
    for (const LibraryVersion& library : library_versions()) json["libraries"][library.key] = library.version;
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

// Of drivers, libraries and the environment it is not known what they say.
void print_line(const std::string& line) {
    std::printf("%s\n", one_line(line).c_str());
}

void print_device(std::size_t number, const Finding& finding) {
    const DeviceReport& d = finding.device;
    const std::string indent(13, ' ');
    print_line("GPU " + std::to_string(number) + "        " + d.name + " (" + kind_words(d.kind) + "), " +
               d.driver + ", Vulkan " + version_words(d.vulkan_version));
    if (!d.can_draw()) {
        print_line(indent + "cannot draw: lacks " + joined(lacks_of(d)) +
                   "; a current driver for it, or the software driver (scripts/set-up), is needed");
        return;
    }
    print_line(indent + "draws with mesh shaders: " +
               (d.mesh_shader ? "yes" : "no (VK_EXT_mesh_shader is missing); with compute shaders alone"));
    print_line(indent + "draws with compute shaders: " +
               (d.compute_raster ? "yes" : "no (64-bit atomics are missing); with mesh shaders alone"));
    print_line(indent + "--pipeline auto" + (finding.choice ? " takes " : ": ") + finding.choice_text());
    print_line(indent + "pictures in parts of up to " + std::to_string(d.max_picture_side_px) +
               " px a side, " + memory_text(d.memory_bytes) + " of memory");
    if (d.kind == VK_PHYSICAL_DEVICE_TYPE_CPU) print_line(indent + "draws without a GPU: correct, but slow");
}

void print_doctor(const std::vector<Finding>& devices, const std::string& no_device,
                  const LibraryReport& libraries) {
    print_line("orograph     " OROGRAPH_VERSION);
    for (std::size_t i = 0; i < devices.size(); ++i) print_device(i, devices[i]);
    if (!no_device.empty()) print_line("GPU          none: " + no_device);
    print_line("GDAL         " + libraries.gdal);
    print_line("PROJ         " + libraries.proj);
    print_line("GeographicLib " + libraries.geographiclib);
    std::vector<std::string> others;
    for (const LibraryVersion& library : library_versions())
        others.push_back(library.name + " " + library.version);
    print_line("libraries    " + joined(others));
    for (const GeoidGridReport& g : libraries.geoids) {
        const std::string state = !g.found           ? "not found"
                                  : g.damage.empty() ? "found"
                                                     : "DAMAGED: " + g.damage;
        print_line("geoid        " + g.name + ": " + g.file + " " + state + "; " + g.meaning);
    }
    print_line("data         " + data_folder().string() +
               (has_data_folder() ? "" : " (not there: styles must be given by path)"));
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

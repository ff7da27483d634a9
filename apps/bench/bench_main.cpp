// orograph-bench: how fast this machine's GPU draws a region file from fixed eyes, or terrain by a formula.
// Links core and render alone.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/bench/bench_path.h"
#include "apps/bench/bench_style.h"
#include "apps/bench/bench_terrain.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/option_words.h"
#include "apps/styles/style_json.h"
#include "core/baked/file_pages.h"
#include "core/base/elapsed.h"
#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/light/sun_position.h"
#include "core/lod/ground_means.h"
#include "render/device/raster_request.h"
#include "render/frame/picture_renderer.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

struct BenchOptions {
    std::string region;  // a region file; "": terrain by a formula
    std::string path;    // of eyes
    int patches{64};     // of the formula's terrain: along each side, 8 x 8 quads each
    int frames{30};
    std::string style_file;  // "": bench_style()
    gpu::FrameStyle style{bench_style()};
    double sun_azimuth_deg{315.0};
    double sun_elevation_deg{45.0};
    int width_px{1920};
    int height_px{1080};
    std::string pipeline{raster_requests.front().first};
    std::string occlusion{"auto"};
    bool compare_occlusion{false};
    double tau_px{1.0};
    int gpu_memory_mb{0};
    bool floor{false};
    bool json{false};
};

// Medians over the frames that count.
struct BenchTimes {
    FrameReport first;  // of a renderer that knows nothing of the frame before
    FrameReport last;
    double choose_s{};
    double raster_s{};
    double shade_s{};
    double gpu_s{};
    double plan_s{};     // processor: pages chosen
    double frame_s{};    // processor: a frame that is planned, the wait for the GPU included
    double settled_s{};  // the first frame, with all that had to be read
    std::size_t pages_on_gpu{};
    std::uint64_t bytes_on_gpu{};
};

Result<BenchTimes> time_frames(Scene& scene, FrameRenderer& renderer, const Camera& camera,
                               const BenchOptions& options) {
    const Tile tile{0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
    const gpu::FrameStyle& style = options.style;
    scene.cast(cast_request(style));
    std::vector<double> choose, raster, shade, whole, planned, frame;
    BenchTimes times;
    const auto beginning = Clock::now();
    ORO_TRY(FramePlan plan, scene.settled_plan(camera, tile, options.tau_px));
    if (!plan.missing.empty()) return Error{ErrorKind::failed, "--gpu-memory", "is too small for this view"};
    ORO_TRY(times.first, renderer.draw(plan, style));
    times.settled_s = seconds_since(beginning);
    // Frames without a pause, until clocks are up, and then those that count.
    constexpr double warm_up_s = 1.0;
    for (const auto start = Clock::now(); seconds_since(start) < warm_up_s;)
        ORO_CHECK(renderer.draw(plan, style));
    for (int i = 0; i < options.frames; ++i) {
        const auto start = Clock::now();
        ORO_TRY(times.last, renderer.draw(plan, style));
        frame.push_back(seconds_since(start));
        choose.push_back(times.last.choose_s);
        raster.push_back(times.last.raster_s);
        shade.push_back(times.last.shade_s);
        whole.push_back(times.last.gpu_s());
    }
    for (int i = 0; i < options.frames; ++i) {
        const auto start = Clock::now();
        ORO_CHECK(scene.settled_plan(camera, tile, options.tau_px));
        planned.push_back(seconds_since(start));
    }
    times.choose_s = median_of(std::move(choose));
    times.raster_s = median_of(std::move(raster));
    times.shade_s = median_of(std::move(shade));
    times.gpu_s = median_of(std::move(whole));
    times.plan_s = median_of(std::move(planned));
    times.frame_s = median_of(std::move(frame));
    times.pages_on_gpu = scene.store().size();
    times.bytes_on_gpu = scene.store().bytes();
    return times;
}

Result<void> read_style(BenchOptions& options) {
    if (options.style_file.empty()) return {};
    ORO_TRY(const std::string text, read_text_file(options.style_file));
    ORO_TRY(const Style style, style_of_text(text, options.style_file));
    options.style = style.frame;
    options.style.sun_enu = gpu::vec3(enu_towards(options.sun_azimuth_deg, options.sun_elevation_deg));
    options.style.sun_hidden = options.sun_elevation_deg < 0.0 ? 1.0F : 0.0F;
    return {};
}

Result<FrameRenderer> renderer_for(const Gpu& gpu, RasterPath path, const BenchOptions& options) {
    FrameRendererOptions renderer_options;
    renderer_options.extent = {static_cast<std::uint32_t>(options.width_px),
                               static_cast<std::uint32_t>(options.height_px)};
    renderer_options.path = path;
    renderer_options.occlusion = options.occlusion == "on"    ? OcclusionUse::on
                                 : options.occlusion == "off" ? OcclusionUse::off
                                                              : OcclusionUse::if_it_pays;
    renderer_options.smooth_edges = options.style.smooth_edges != 0;
    return FrameRenderer::create(gpu, renderer_options);
}

// Triangles a second that a way of drawing reaches when all of them are visible and small.
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

// Pixels whose triangle is another without occlusion: from the eye, and from eyes a step or a turn away, one
// after the other.
Result<std::uint64_t> pixels_without_occlusion(const Gpu& gpu, RasterPath path, Scene& scene,
                                               FrameRenderer& renderer, Camera camera, BenchOptions options) {
    options.occlusion = "off";
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
                scene.settled_plan(camera, {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}},
                                   options.tau_px));
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
    json["cpu_plan_ms"] = 1e3 * times.plan_s;
    json["cpu_frame_ms"] = 1e3 * times.frame_s;
    json["first_settled_ms"] = 1e3 * times.settled_s;
    json["triangles"] = counts.triangles_drawn;
    json["meshlets"] = counts.meshlets_drawn;
    json["lanes_used"] =
        counts.meshlets_drawn == 0
            ? 0.0
            : counts.triangles_drawn / (static_cast<double>(gpu::meshlet_triangles) * counts.meshlets_drawn);
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
    json["triangles_per_s"] = counts.triangles_drawn / times.raster_s;
    return json;
}

void print_times(const std::string& name, const ordered_json& json) {
    std::printf("%-6s", name.c_str());
    for (const auto& [key, value] : json.items()) {
        std::printf(
            " %s %s", key.c_str(),
            value.is_number_float() ? (std::to_string(value.get<double>())).c_str() : value.dump().c_str());
    }
    std::printf("\n");
}

// A region file, or one that is made.
struct BenchRegion {
    HeightField made;
    std::shared_ptr<const RegionFile> file;
    std::unique_ptr<RegionPages> pages;
};
Result<BenchRegion> open_bench_region(const BenchOptions& options) {
    BenchRegion region;
    if (options.region.empty()) {
        region.made = made_region(options.patches);
        region.pages = pages_in_memory(region.made, 1.0, thread_count());
        return region;
    }
    ORO_TRY(RegionFile opened, RegionFile::open(options.region));
    region.file = std::make_shared<const RegionFile>(std::move(opened));
    region.pages = pages_of_file(region.file);
    return region;
}

Result<std::vector<BenchEye>> eyes_of(const BenchOptions& options, const BenchRegion& region) {
    if (!region.file)
        return std::vector<BenchEye>{{"above", eye_above(region.made, options.width_px, options.height_px)}};
    if (options.path.empty()) return Error{ErrorKind::usage, "--path", "is missing: name a file with eyes"};
    return read_bench_path(options.path, region.file->outline().undulation, options.width_px,
                           options.height_px);
}

Result<void> run_bench(const BenchOptions& options) {
#ifndef NDEBUG
    return Error{ErrorKind::failed, "orograph-bench",
                 "is a debug build; times would mean nothing (use the release preset)"};
#endif
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    ORO_TRY(const RasterPath path, raster_path_for(options.pipeline, gpu->report()));
    const auto opening = Clock::now();
    ORO_TRY(BenchRegion region, open_bench_region(options));
    const double open_s = seconds_since(opening);
    ORO_TRY(const std::vector<BenchEye> eyes, eyes_of(options, region));
    ORO_TRY(Scene scene, Scene::create(*gpu, std::move(region.pages),
                                       {static_cast<std::uint64_t>(options.gpu_memory_mb) * 1000000U, 0},
                                       HeightStorage::f32, asks_for_means(options.style)));
    if (asks_for_means(options.style) && !scene.pages().knows_means())
        std::fputs("orograph-bench: note: the region has too many posts for means of the ground\n", stderr);
    ORO_TRY(FrameRenderer renderer, renderer_for(*gpu, path, options));
    ordered_json json = ordered_json::object();
    json["device"] = gpu->report().name;
    json["driver"] = gpu->report().driver;
    json["pipeline"] = name_of(path);
    json["region"] = options.region.empty() ? std::to_string(options.patches) + " patches" : options.region;
    json["size_px"] = json_list(options.width_px, options.height_px);
    json["tau_px"] = options.tau_px;
    json["frames"] = options.frames;
    json["open_ms"] = 1e3 * open_s;
    double peak = 0.0;
    if (options.floor) {
        ORO_TRY(peak, peak_triangles_per_s(*gpu, path, options));
        json["peak_triangles_per_s"] = peak;
    }
    if (!options.json) {
        std::printf("%s (%s), %s path, %d x %d px, tau %g px, medians of %d frames; opened in %.1f ms\n",
                    gpu->report().name.c_str(), gpu->report().driver.c_str(), name_of(path).c_str(),
                    options.width_px, options.height_px, options.tau_px, options.frames, 1e3 * open_s);
    }
    json["eyes"] = ordered_json::object();
    for (const BenchEye& eye : eyes) {
        ORO_TRY(const BenchTimes times, time_frames(scene, renderer, eye.camera, options));
        ordered_json one = times_json(times);
        if (options.floor) {
            const double floor_s = times.last.counts.triangles_drawn / peak + times.shade_s;
            one["floor_ms"] = 1e3 * floor_s;
            one["times_floor"] = times.gpu_s / floor_s;
        }
        if (options.compare_occlusion) {
            ORO_TRY(const std::uint64_t differ,
                    pixels_without_occlusion(*gpu, path, scene, renderer, eye.camera, options));
            one["pixels_that_differ"] = differ;
        }
        if (!options.json) print_times(eye.name, one);
        json["eyes"][eye.name] = std::move(one);
    }
    if (options.json) std::printf("%s\n", json.dump().c_str());
    return {};
}

Result<void> set_size(const std::string& text, BenchOptions& options) {
    int read = 0;
    if (std::sscanf(text.c_str(), "%dx%d%n", &options.width_px, &options.height_px, &read) != 2 ||
        read != static_cast<int>(text.size()) || options.width_px < 1 || options.height_px < 1 ||
        options.width_px > 8192 || options.height_px > 8192)
        return Error{ErrorKind::usage, "--size",
                     "'" + text + "' is not WIDTHxHEIGHT in pixels, each 1 to 8192"};
    return {};
}

}  // namespace
}  // namespace oro

int main(int argc, char** argv) {
    CLI::App app{"Times how fast this machine's GPU draws: medians of GPU timestamps.", "orograph-bench"};
    oro::BenchOptions options;
    std::string size = "1920x1080";
    app.add_option("REGION", options.region,
                   "A region file (orograph bake makes one); without: terrain by a formula");
    app.add_option("--path", options.path, "Eyes to draw from: a .json file like those in data/paths");
    app.add_option("--patches", options.patches, "Of the formula's terrain: meshlets along each side")
        ->check(CLI::Range(1, 1280));
    app.add_option("--tau", options.tau_px, "Largest error, pixels; 0: full resolution")
        ->check(CLI::Range(0.0, 1000.0));
    app.add_option("--size", size, "Picture size, WIDTHxHEIGHT pixels");
    app.add_option("--frames", options.frames, "Frames that count, after a second of frames that do not")
        ->check(CLI::Range(1, 10000));
    app.add_option("--pipeline", options.pipeline, "mesh, compute or auto")
        ->check(CLI::IsMember(oro::words_of(oro::raster_requests)));
    app.add_option(
           "--occlusion", options.occlusion,
           "Leave out what other ground hides: on, off, or auto (where it pays). The picture is the same")
        ->check(CLI::IsMember({"on", "off", "auto"}));
    app.add_flag("--compare-occlusion", options.compare_occlusion,
                 "Count the pixels whose triangle is another without occlusion, from eight eyes in motion");
    app.add_option("--gpu-memory", options.gpu_memory_mb, "Megabytes of terrain on the GPU at most")
        ->check(CLI::Range(0, 1000000));
    app.add_flag("--floor", options.floor,
                 "Measure the path's peak triangle rate, too, and tell times as multiples of the least that "
                 "it allows");
    app.add_option(
        "--style", options.style_file,
        "A style: a .json file like those in data/styles. Without it: plain colours of the benchmark's own, "
        "without "
        "shadows, air or means of the ground; orograph's default, natural, is data/styles/natural.json");
    app.add_option("--sun-azimuth", options.sun_azimuth_deg, "Of that style, degrees clockwise from north")
        ->check(CLI::Range(-360.0, 360.0));
    app.add_option("--sun-elevation", options.sun_elevation_deg, "Of that style, degrees above level")
        ->check(CLI::Range(-90.0, 90.0));
    app.add_flag("--json", options.json, "Print one JSON object");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        std::fprintf(stderr, "orograph-bench: %s\n", e.what());
        return static_cast<int>(oro::ErrorKind::usage);
    }
    oro::Result<void> done = oro::set_size(size, options);
    if (done.ok()) done = oro::read_style(options);
    if (done.ok()) done = oro::run_bench(options);
    if (done.ok()) return 0;
    std::fprintf(stderr, "orograph-bench: %s\n", done.error().line().c_str());
    return static_cast<int>(done.error().kind);
}

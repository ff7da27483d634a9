// orograph-bench: how fast this machine's GPU draws a region file from fixed or random eyes, or terrain by a
// formula. Links core and render alone.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/bench/times/bench_grass.h"
#include "apps/bench/times/bench_houses.h"
#include "apps/bench/times/bench_made.h"
#include "apps/bench/times/bench_made_pages.h"
#include "apps/bench/times/bench_moving.h"
#include "apps/bench/times/bench_passes.h"
#include "apps/bench/times/bench_patches.h"
#include "apps/bench/times/bench_random.h"
#include "apps/bench/times/bench_region.h"
#include "apps/bench/times/bench_tables.h"
#include "apps/bench/times/bench_times.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/option_words.h"
#include "apps/styles/style_json.h"
#include "core/base/elapsed.h"
#include "core/light/sun_position.h"
#include "core/lod/ground_means.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

Result<void> read_style(BenchOptions& options) {
    if (options.style_file.empty()) return {};
    ORO_TRY(const std::string text, read_text_file(options.style_file));
    ORO_TRY(const Style style, style_of_text(text, options.style_file));
    options.style = style.frame;
    options.style.sun_enu = gpu::vec3(enu_towards(options.sun_azimuth_deg, options.sun_elevation_deg));
    options.style.sun_hidden = options.sun_elevation_deg < 0.0 ? 1.0F : 0.0F;
    return {};
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

// Of all eyes: the median, 95 % of them and the worst, and which the worst are.
ordered_json spread_json(const std::vector<BenchEye>& eyes, const std::vector<BenchTimes>& times,
                         double BenchTimes::*time_s) {
    std::vector<double> values;
    for (const BenchTimes& one : times) values.push_back(1e3 * (one.*time_s));
    const SpreadOfEyes spread = spread_of(values);
    ordered_json json = ordered_json::object();
    json["median_ms"] = spread.median;
    json["at_95_percent_ms"] = spread.high;
    json["worst_ms"] = spread.worst;
    json["worst_eyes"] = ordered_json::array();
    for (const std::size_t eye : spread.worst_eyes) {
        const BenchTimes& one = times[eye];
        ordered_json worst = ordered_json::object();
        worst["eye"] = eyes[eye].name;
        worst["gpu_ms"] = 1e3 * one.gpu_s;
        worst["raster_ms"] = 1e3 * one.raster_s;
        worst["triangles"] = one.last.counts.triangles_drawn;
        json["worst_eyes"].push_back(std::move(worst));
    }
    return json;
}

void print_spread(const ordered_json& of_frame, const ordered_json& of_raster) {
    std::printf("  frame: median %.3f ms, 95 %% %.3f, worst %.3f; raster: %.3f, %.3f, %.3f\n",
                of_frame["median_ms"].get<double>(), of_frame["at_95_percent_ms"].get<double>(),
                of_frame["worst_ms"].get<double>(), of_raster["median_ms"].get<double>(),
                of_raster["at_95_percent_ms"].get<double>(), of_raster["worst_ms"].get<double>());
    for (const ordered_json& eye : of_frame["worst_eyes"])
        std::printf("  %.3f ms (raster %.3f, %u triangles): %s\n", eye["gpu_ms"].get<double>(),
                    eye["raster_ms"].get<double>(), eye["triangles"].get<unsigned>(),
                    eye["eye"].get<std::string>().c_str());
}

// All eyes by one way of drawing.
Result<ordered_json> run_path(const Gpu& gpu, RasterPath path, Scene& scene,
                              const std::vector<BenchEye>& eyes, const BenchOptions& options) {
    ORO_TRY(FrameRenderer renderer, renderer_for(gpu, path, options));
    ordered_json json = ordered_json::object();
    double peak = 0.0;
    if (options.floor) {
        ORO_TRY(peak, peak_triangles_per_s(gpu, path, options));
        json["peak_triangles_per_s"] = peak;
    }
    if (!options.json) std::printf("%s path\n", name_of(path).c_str());
    if (options.houses > 0) {
        ORO_TRY(json["houses"], time_houses(gpu, scene, renderer, eyes, options));
        return json;
    }
    json["eyes"] = ordered_json::object();
    std::vector<BenchTimes> all;
    for (const BenchEye& eye : eyes) {
        ORO_TRY(const BenchTimes times, time_frames(scene, renderer, eye.camera, options));
        all.push_back(times);
        ordered_json one = times_json(times);
        if (options.floor) {
            const double floor_s = times.last.counts.triangles_drawn / peak + times.shade_s;
            one["floor_ms"] = 1e3 * floor_s;
            one["times_floor"] = times.gpu_s / floor_s;
        }
        if (options.compare_occlusion) {
            ORO_TRY(const std::uint64_t differ,
                    pixels_without_occlusion(gpu, path, scene, renderer, eye.camera, options));
            one["pixels_that_differ"] = differ;
        }
        if (!options.json && options.random_eyes == 0) print_times(eye.name, one);
        json["eyes"][eye.name] = std::move(one);
    }
    if (options.passes) json["passes"] = passes_of_eyes(all, options.json);
    if (options.random_eyes == 0) return json;
    json["frame"] = spread_json(eyes, all, &BenchTimes::gpu_s);
    json["raster"] = spread_json(eyes, all, &BenchTimes::raster_s);
    if (!options.json) print_spread(json["frame"], json["raster"]);
    return json;
}

ordered_json asked_json(const BenchOptions& options, const DeviceReport& device) {
    ordered_json json = ordered_json::object();
    json["device"] = device.name;
    json["driver"] = device.driver;
    json["region"] = options.region.empty() ? std::to_string(options.patches) + " patches" : options.region;
    json["size_px"] = json_list(options.width_px, options.height_px);
    json["mesh"] = options.mesh;
    json["as_window"] = options.as_window;
    json["tau_px"] = options.tau_px;
    json["frames"] = options.frames;
    json["occlusion"] = options.occlusion;
    json["meshlets"] = meshlet_split_for(options.split, device) == MeshletSplit::halves ? "halves" : "whole";
    json["small_triangles"] = options.leave_out_small ? "skip" : "draw";
    if (options.random_eyes > 0) json["seed"] = options.seed;
    json["heights"] = options.heights == HeightStorage::i16      ? "16"
                      : options.heights == HeightStorage::packed ? "packed"
                                                                 : "32";
    return json;
}

Result<void> run_bench(const BenchOptions& options) {
#ifndef NDEBUG
    return Error{ErrorKind::failed, "orograph-bench",
                 "is a debug build; times would mean nothing (use the release preset)"};
#endif
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    if (options.tables) return print_tables(*gpu, options);
    if (options.moving > 0) return run_moving(*gpu, options);
    if (options.mesh == "both") return Error{ErrorKind::usage, "--mesh both", "is for --moving alone"};
    ORO_TRY(const std::vector<RasterPath> paths, raster_paths_of(options, gpu->report()));
    const auto opening = Clock::now();
    ORO_TRY(BenchRegion region, open_bench_region(options));
    const double open_s = seconds_since(opening);
    ORO_TRY(const std::vector<BenchEye> eyes, eyes_of(options, region));
    ORO_TRY(Scene scene, scene_of(*gpu, options, region));
    if (asks_for_means(options.style) && !scene.grids()[0].pages().knows_means())
        std::fputs("orograph-bench: note: the region has too many posts for means of the ground\n", stderr);
    ordered_json json = asked_json(options, gpu->report());
    json["open_ms"] = 1e3 * open_s;
    if (!options.json) {
        std::printf("%s (%s), %d x %d px, tau %g px, medians of %d frames; opened in %.1f ms\n",
                    gpu->report().name.c_str(), gpu->report().driver.c_str(), options.width_px,
                    options.height_px, options.tau_px, options.frames, 1e3 * open_s);
        if (options.random_eyes > 0)
            std::printf("%d random eyes, seed %llu\n", options.random_eyes,
                        static_cast<unsigned long long>(options.seed));
    }
    for (const RasterPath path : paths) {
        ORO_TRY(ordered_json one, run_path(*gpu, path, scene, eyes, options));
        if (paths.size() > 1) {
            json[name_of(path)] = std::move(one);
            continue;
        }
        json["pipeline"] = name_of(path);
        for (auto& [key, value] : one.items()) json[key] = std::move(value);
    }
    // Asked now: houses that were put into the scene have moved its grids.
    const GridScene& grid = scene.grids()[0];
    json["page_bytes"] = grid.store().bytes_a_page();
    json["bytes_a_post"] = grid.store().bytes_a_post();
    json["means_bytes_a_post"] = grid.store().means_bytes_a_post();
    if (options.json)
        std::printf("%s\n", json.dump().c_str());
    else
        std::printf(
            "%.2f bytes a post, bounds of nodes apart; %.0f bytes a page; "
            "means and places on a net take %.2f more a post\n",
            grid.store().bytes_a_post(), grid.store().bytes_a_page(), grid.store().means_bytes_a_post());
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

// Words that become options once all are read.
struct BenchWords {
    std::string size{"1920x1080"}, heights{"32"}, small{"draw"}, meshlets{"auto"}, plan{"cpu"};
};

void add_what_is_drawn(CLI::App& app, BenchOptions& options, BenchWords& words) {
    app.add_option("REGION", options.region,
                   "A region file (orograph bake makes one); without: terrain by a formula");
    app.add_option("--path", options.path, "Eyes to draw from: a .json file like those in data/paths");
    app.add_option("--patches", options.patches, "Of the formula's terrain: meshlets along each side")
        ->check(CLI::Range(1, 1280));
    app.add_option("--tau", options.tau_px, "Largest error, pixels; 0: full resolution")
        ->check(CLI::Range(0.0, 1000.0));
    app.add_option("--size", words.size, "Picture size, WIDTHxHEIGHT pixels");
    app.add_option("--frames", options.frames, "Frames that count, after a second of frames that do not")
        ->check(CLI::Range(1, 10000));
    app.add_option("--warm-up", options.warm_up_s, "Seconds of frames that do not count, for each eye")
        ->check(CLI::Range(0.0, 60.0));
}

void add_ways_of_drawing(CLI::App& app, BenchOptions& options, BenchWords& words) {
    std::vector<std::string> paths = words_of(raster_requests);
    paths.emplace_back("both");
    app.add_option("--pipeline", options.pipeline, "mesh, compute, auto, or both in turn")
        ->check(CLI::IsMember(paths));
    app.add_option("--mesh", options.mesh,
                   "What triangles are taken from: grid, clusters, or (with --moving) both in turn")
        ->check(CLI::IsMember({"grid", "clusters", "both"}));
    app.add_flag("--as-window", options.as_window,
                 "Plan frames as a window does: of what is here, once that is all. Clusters come with those "
                 "above them, of which the GPU makes its own cut. The picture is the same");
    app.add_option(
           "--occlusion", options.occlusion,
           "Leave out what other ground hides: on, off, or auto (where it pays). The picture is the same")
        ->check(CLI::IsMember({"on", "off", "auto"}));
    app.add_flag("--compare-occlusion", options.compare_occlusion,
                 "Count the pixels whose triangle is another without occlusion, from eight eyes in motion");
    app.add_option("--gpu-memory", options.gpu_memory_mb, "Megabytes of terrain on the GPU at most")
        ->check(CLI::Range(0, 1000000));
    app.add_option("--heights", words.heights,
                   "Bits that the GPU keeps of a height: 32 or 16; packed: as few as the same heights as "
                   "with 32 need")
        ->check(CLI::IsMember({"32", "16", "packed"}));
    app.add_option(
           "--meshlets", words.meshlets,
           "Mesh path: a workgroup for each whole meshlet, for each half of one, or auto (as the device "
           "does it). The picture is the same")
        ->check(CLI::IsMember({"auto", "whole", "halves"}));
    app.add_option(
           "--small-triangles", words.small,
           "Mesh path: draw triangles that cover no pixel's centre, or skip them. The picture is the same")
        ->check(CLI::IsMember({"draw", "skip"}));
}

void add_modes(CLI::App& app, BenchOptions& options, BenchWords& words) {
    app.add_option("--random-eyes", options.random_eyes,
                   "So many eyes over posts of the region in place of --path: 2 m to 400 km above ground, "
                   "log-uniform, with any heading; tells the median, 95 % and the worst")
        ->check(CLI::Range(1, 100000));
    app.add_option(
           "--moving", options.moving,
           "So many random flights of --frames frames each in place of eyes that rest, 50 m/s near the "
           "ground to 5 km/s above, drawn as a window draws them; tells times of whole frames, "
           "processor, GPU and waiting apart. With --style: by plain colours and by that style")
        ->check(CLI::Range(1, 10000));
    app.add_option(
           "--plan", words.plan,
           "What makes the tables of plans and the places of their pages: cpu or gpu, which takes one "
           "with doubles; pages: the GPU chooses the pages of plain frames, too (default: cpu)")
        ->check(CLI::IsMember({"cpu", "gpu", "pages"}));
    app.add_flag(
        "--compare-plans", options.compare_plans,
        "With --moving: tell in how many pixels of all eyes --plan gpu, or pages where that is given, shows "
        "another triangle than --plan cpu, in place of times");
    app.add_option("--frame-rate", options.frame_rate_hz,
                   "With --moving: frames begun a second, as a window begins them on a display of that rate, "
                   "where pages have time to come. Without it: as many as there can be")
        ->check(CLI::Range(1.0, 1000.0));
    app.add_flag(
        "--fingerprint", options.fingerprint,
        "With --moving: tell a checksum of all plans in place of times, each made once all it asks for "
        "is here. Programs that plan alike tell the same");
    app.add_option("--seed", options.seed, "Of random eyes and flights: one seed, the same eyes");
    app.add_option("--houses", options.houses,
                   "Time each eye without houses, with so many of 10 triangles each on the ground before it, "
                   "and with nine times as many behind it as well")
        ->check(CLI::Range(1, 100000));
    app.add_flag(
        "--tables", options.tables,
        "Print tables of the eyes of --path: triangles and times without level of detail, with it and with "
        "occlusion; by how heights are kept; mesh shaders against compute at tau 1/4 to 4");
    app.add_flag("--floor", options.floor,
                 "Measure the path's peak triangle rate, too, and tell times as multiples of the least that "
                 "it allows");
    app.add_flag("--passes", options.passes,
                 "Tell what each pass of shading takes, too, and of all eyes the median, 95 % and the worst. "
                 "Frames take a little longer so");
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
}

// Options of --grass; whether it is asked for.
struct GrassWords {
    bool grass{};
    GrassBenchOptions options;
};

void add_grass(CLI::App& app, GrassWords& words) {
    CLI::Option* const grass = app.add_flag(
        "--grass", words.grass,
        "Time a field of grass seen straight down, by the vertex pipeline, by mesh shaders with a clump a "
        "group "
        "and packed, and by compute: eyes 50 to 300 m up, blades finer up to 100 to 300 m; 1291x1026 pixels "
        "unless --size says otherwise. Takes --frames, --warm-up, --size and --json, too");
    app.add_option("--blades", words.options.blades,
                   "Of that field, in the same area; the eye 300 m up sees all")
        ->check(CLI::Range(1000U, grass_blades_max))
        ->needs(grass);
    app.add_flag("--boxes", words.options.by_boxes,
                 "Of that field: leave clumps out by boxes around all that they may cover, not by their feet")
        ->needs(grass);
    app.add_flag("--thin", words.options.thins,
                 "Of that field: no blade is narrower than a pixel; the farther, the fewer and wider")
        ->needs(grass);
    app.add_flag("--wind", words.options.wind, "Of that field: blades lean in wind")->needs(grass);
}

Result<void> run_made(const BenchOptions& options, int side) {
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    return print_made(*gpu, {side, options.frames, options.json});
}

void add_made_pages(CLI::App& app, int& side) {
    app.add_option(
           "--made-pages", side,
           "Time pages of made terrain in frames, made by the GPU where it keeps them and made by the "
           "processor and sent: all pages of so many by so many posts, and the first picture of a world of "
           "5.6e11 posts, 640x360 pixels unless --size says otherwise. Takes --frames, --size, --tau, "
           "--pipeline and --json, too")
        ->check(CLI::Range(300, 16000));
}

Result<void> run_made_pages(const CLI::App& app, const BenchOptions& options, int side) {
    const auto start = Clock::now();
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    const double device_s = seconds_since(start);
    MadePagesBenchOptions made;
    made.side = side;
    made.frames = options.frames;
    made.tau_px = options.tau_px;
    made.json = options.json;
    if (app.count("--size") > 0) {
        made.width_px = options.width_px;
        made.height_px = options.height_px;
    }
    ORO_TRY(const std::vector<RasterPath> paths, raster_paths_of(options, gpu->report()));
    made.path = paths.front();
    return print_made_pages(*gpu, device_s, made);
}

Result<void> run_patches(const CLI::App& app, BenchOptions options, int most) {
    if (app.count("--warm-up") == 0) options.warm_up_s = 0.1;
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    return print_patches(*gpu, {options, most});
}

Result<void> run_grass(const CLI::App& app, const BenchOptions& options, GrassBenchOptions grass) {
#ifndef NDEBUG
    return Error{ErrorKind::failed, "orograph-bench",
                 "is a debug build; times would mean nothing (use the release preset)"};
#endif
    if (app.count("--size") > 0) {
        grass.width_px = static_cast<std::uint32_t>(options.width_px);
        grass.height_px = static_cast<std::uint32_t>(options.height_px);
    }
    if (app.count("--warm-up") > 0) grass.warm_up_s = options.warm_up_s;
    grass.frames = options.frames;
    grass.json = options.json;
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    return print_grass(*gpu, grass);
}

}  // namespace
}  // namespace oro

int main(int argc, char** argv) {
    CLI::App app{"Times how fast this machine's GPU draws: medians of GPU timestamps.", "orograph-bench"};
    oro::BenchOptions options;
    oro::BenchWords words;
    oro::GrassWords grass;
    oro::add_what_is_drawn(app, options, words);
    oro::add_ways_of_drawing(app, options, words);
    oro::add_modes(app, options, words);
    oro::add_grass(app, grass);
    int made_side = 0;
    app.add_option(
           "--made", made_side,
           "Make so many by so many posts of each kind of made terrain on the GPU, 3163 for some 10^7, "
           "hold them to the processor's bits, and time a page. Takes --frames and --json, too")
        ->check(CLI::Range(1100, 16000));
    int made_pages_side = 0;
    oro::add_made_pages(app, made_pages_side);
    int patches = 0;
    app.add_option(
           "--fixed-patches", patches,
           "Time made terrain by patches of fixed size, with 2, 3, 5 or 9 posts a side or chosen by "
           "distance, "
           "and by levels: squares of 64, 128, 256, 512 and 640 patches a side up to so many, or of so many "
           "where that is fewer; noise, choice and drawing apart. Takes --frames, --warm-up, --size, --tau "
           "and "
           "--json, too")
        ->check(CLI::Range(8, 640));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        std::fprintf(stderr, "orograph-bench: %s\n", e.what());
        return static_cast<int>(oro::ErrorKind::usage);
    }
    options.heights = words.heights == "16"       ? oro::HeightStorage::i16
                      : words.heights == "packed" ? oro::HeightStorage::packed
                                                  : oro::HeightStorage::f32;
    options.choose_on_device = words.plan == "pages";
    options.plan_on_device = words.plan == "gpu" || options.choose_on_device;
    options.leave_out_small = words.small == "skip";
    options.split = words.meshlets == "whole"    ? oro::MeshletSplit::whole
                    : words.meshlets == "halves" ? oro::MeshletSplit::halves
                                                 : oro::MeshletSplit::by_device;
    oro::Result<void> done = oro::set_size(words.size, options);
    if (done.ok()) done = oro::read_style(options);
    if (done.ok())
        done = grass.grass           ? oro::run_grass(app, options, grass.options)
               : made_side > 0       ? oro::run_made(options, made_side)
               : made_pages_side > 0 ? oro::run_made_pages(app, options, made_pages_side)
               : patches > 0         ? oro::run_patches(app, options, patches)
                                     : oro::run_bench(options);
    if (done.ok()) return 0;
    std::fprintf(stderr, "orograph-bench: %s\n", done.error().line().c_str());
    return static_cast<int>(done.error().kind);
}

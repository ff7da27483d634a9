// orograph-bench: how fast a device draws, apart from everything else. Links core and render alone, so that
// it runs where GDAL and PROJ are not installed; its terrain is made by a formula.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/ground.h"
#include "render/picture_renderer.h"

namespace oro {
namespace {

struct BenchOptions {
    int patches{64};  // along each side, 8 x 8 quads each
    int frames{30};
    int width_px{1920};
    int height_px{1080};
    std::string pipeline{"auto"};
    bool json{false};
};

// Hills on all scales down to the post spacing, 0 to some 1,500 m; the same on every machine up to the last
// digits of sine.
HeightField made_region(int patches) {
    constexpr double posts_per_deg = 1200.0;
    const int posts = patches * static_cast<int>(gpu::meshlet_quads) + 1;
    HeightField field;
    field.grid.lat = {posts_per_deg, 46.0 + posts / posts_per_deg, 0, -1, posts};
    field.grid.lon = {posts_per_deg, 8.0, 0, 1, posts};
    field.H_m.reserve(field.grid.post_count());
    for (int row = 0; row < posts; ++row) {
        for (int column = 0; column < posts; ++column) {
            double H_m = 750.0, height_m = 400.0, scale = 0.002;
            for (int octave = 0; octave < 8; ++octave, height_m *= 0.5, scale *= 2.1)
                H_m += height_m * std::sin(scale * row + octave) * std::cos(scale * column - octave);
            field.H_m.push_back(static_cast<float>(H_m));
        }
    }
    return field;
}

// An eye straight above the middle, from where the whole square just fits: every meshlet is drawn.
Camera eye_above(const HeightField& field, int width_px, int height_px) {
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    const double lat_deg = 0.5 * (field.grid.north_deg() + field.grid.south_deg());
    const double half_m = 0.5 * (field.grid.north_deg() - field.grid.south_deg()) * 111200.0;
    camera.eye = {lat_deg, 0.5 * (field.grid.west_deg() + field.grid.east_deg()),
                  2000.0 + 1.05 * half_m / camera.half_fov_tangent().y};
    camera.attitude.pitch_deg = -90.0;
    return camera;
}

gpu::FrameStyle plain_style() {
    gpu::FrameStyle style{};
    style.tint_count = 2;
    style.tints[0] = {0.0F, gpu::vec3(0.2F, 0.3F, 0.1F)};
    style.tints[1] = {1500.0F, gpu::vec3(0.8F)};
    style.sun_enu = gpu::vec3(-0.5F, 0.5F, 0.7071F);
    style.ambient = 0.2F;
    style.relief = 1.0F;
    style.haze_distance_m = 1e5F;
    style.sky_scale_height_m = 8000.0F;
    return style;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

struct BenchTimes {
    FrameReport last;
    double raster_s{};
    double shade_s{};
    double whole_s{};
};

Result<BenchTimes> time_frames(const Gpu& gpu, const Scene& scene, const Camera& camera, RasterPath path,
                               int frames) {
    FrameRendererOptions options;
    options.extent = {static_cast<std::uint32_t>(camera.width_px),
                      static_cast<std::uint32_t>(camera.height_px)};
    options.path = path;
    ORO_TRY(FrameRenderer renderer, FrameRenderer::create(gpu, options));
    const Tile tile{0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
    const FramePlan plan = plan_frame(scene.pages, scene.shape, camera, tile);
    const gpu::FrameStyle style = plain_style();
    std::vector<double> raster, shade, whole;
    BenchTimes times;
    constexpr int warm_up = 3;
    for (int i = 0; i < frames + warm_up; ++i) {
        ORO_TRY(times.last, renderer.draw(scene.store, plan, style));
        if (i < warm_up) continue;
        raster.push_back(times.last.raster_s);
        shade.push_back(times.last.shade_s);
        whole.push_back(times.last.raster_s + times.last.shade_s);
    }
    times.raster_s = median(raster);
    times.shade_s = median(shade);
    times.whole_s = median(whole);
    return times;
}

Result<void> run_bench(const BenchOptions& options) {
#ifndef NDEBUG
    return Error{ErrorKind::failed, "orograph-bench",
                 "is a debug build; times would mean nothing (use the release preset)"};
#endif
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    ORO_TRY(const RasterPath path, raster_path_for(options.pipeline, gpu->report()));
    const HeightField field = made_region(options.patches);
    ORO_TRY(const Scene scene, create_scene(*gpu, field, 1.0));
    const Camera camera = eye_above(field, options.width_px, options.height_px);
    ORO_TRY(const BenchTimes times, time_frames(*gpu, scene, camera, path, options.frames));
    const double triangles = times.last.counts.triangles_drawn;
    const char* const form =
        options.json
            ? "{\"device\": \"%s\", \"driver\": \"%s\", \"pipeline\": \"%s\", \"patches\": %d, \"size_px\": "
              "[%d, %d], \"frames\": %d, "
              "\"triangles\": %.0f, \"meshlets\": %u, \"pages\": %zu, \"page_bytes\": %llu, \"raster_ms\": "
              "%.4f, \"shade_ms\": %.4f, "
              "\"gpu_ms\": %.4f, \"triangles_per_s\": %.4g}\n"
            : "%s (%s), %s path, %d patches a side, %d x %d px, median of %d frames\n%.0f triangles in %u "
              "meshlets of %zu pages (%llu "
              "bytes): raster %.4f ms, shade %.4f ms, together %.4f ms on the GPU; %.4g triangles/s\n";
    std::printf(form, gpu->report().name.c_str(), gpu->report().driver.c_str(), name_of(path).c_str(),
                options.patches, options.width_px, options.height_px, options.frames, triangles,
                times.last.counts.meshlets_drawn, scene.pages.size(),
                static_cast<unsigned long long>(scene.store.bytes()), 1e3 * times.raster_s,
                1e3 * times.shade_s, 1e3 * times.whole_s, triangles / times.raster_s);
    return {};
}

}  // namespace
}  // namespace oro

int main(int argc, char** argv) {
    CLI::App app{"Times how fast this machine's GPU draws made-up terrain: medians of GPU timestamps.",
                 "orograph-bench"};
    oro::BenchOptions options;
    app.add_option("--patches", options.patches, "Meshlets along each side of the square")
        ->check(CLI::Range(1, 1280));
    app.add_option("--frames", options.frames, "Frames that count, after three that do not")
        ->check(CLI::Range(1, 10000));
    app.add_option("--width", options.width_px, "Pixels")->check(CLI::Range(1, 8192));
    app.add_option("--height", options.height_px, "Pixels")->check(CLI::Range(1, 8192));
    app.add_option("--pipeline", options.pipeline, "mesh, compute or auto")
        ->check(CLI::IsMember({"auto", "mesh", "compute"}));
    app.add_flag("--json", options.json, "Print one JSON object");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        std::fprintf(stderr, "orograph-bench: %s\n", e.what());
        return static_cast<int>(oro::ErrorKind::usage);
    }
    const auto done = oro::run_bench(options);
    if (done.ok()) return 0;
    std::fprintf(stderr, "orograph-bench: %s\n", done.error().line().c_str());
    return static_cast<int>(done.error().kind);
}

#include "apps/bench/times/bench_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/bench/times/bench_region.h"
#include "apps/bench/times/bench_times.h"
#include "core/base/elapsed.h"
#include "core/base/median.h"
#include "core/base/parallel.h"
#include "render/patches/fixed_patches.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

constexpr std::array published_patches{64, 128, 256, 512, 640};

struct PatchArm {
    const char* name;
    std::optional<std::uint32_t> level;
    PatchBorders borders;
};
constexpr std::array patch_arms{PatchArm{"2 posts", 0U, PatchBorders::open},
                                PatchArm{"3 posts", 1U, PatchBorders::open},
                                PatchArm{"5 posts", 2U, PatchBorders::open},
                                PatchArm{"9 posts", 3U, PatchBorders::open},
                                PatchArm{"by distance", {}, PatchBorders::open},
                                PatchArm{"by distance, borders as published", {}, PatchBorders::mean},
                                PatchArm{"by distance, borders shared", {}, PatchBorders::shared}};

// fbm of nine octaves, 0 to 1,500 m, posts of 3 seconds from 46 N 8 E on.
MadeTerrain square_of(int patches) {
    MadeTerrain terrain;
    terrain.seed = 7;
    terrain.high = 1500 * 2048;
    terrain.posts_per_deg = 1200;
    terrain.west = 8 * 1200;
    terrain.east = terrain.west + 8 * patches;
    terrain.south = 46 * 1200;
    terrain.north = terrain.south + 8 * patches;
    return terrain;
}

// From the south, where all of the square is in the picture, and near patches are three times as near as far
// ones.
Camera eye_south_of(const MadeTerrain& terrain, const BenchOptions& options) {
    const double side_deg = static_cast<double>(terrain.north - terrain.south) / 1200.0;
    const double south_deg = static_cast<double>(terrain.south) / 1200.0;
    Camera camera;
    camera.width_px = options.width_px;
    camera.height_px = options.height_px;
    camera.vertical_fov_deg = 60.0;
    camera.eye = {south_deg - 0.25 * side_deg, static_cast<double>(terrain.west) / 1200.0 + 0.5 * side_deg,
                  1500.0 + 0.45 * side_deg * 111200.0};
    camera.attitude.pitch_deg = -41.0;
    return camera;
}

HeightField field_of(const MadeTerrain& terrain, const std::vector<std::int32_t>& steps) {
    HeightField field;
    field.grid.lat = {1200.0, 46.0 + (terrain.rows() - 1) / 1200.0, 0, -1, terrain.rows()};
    field.grid.lon = {1200.0, 8.0, 0, 1, terrain.columns()};
    field.H_m.reserve(steps.size());
    for (const std::int32_t step : steps) field.H_m.push_back(static_cast<float>(made_step_m * step));
    return field;
}

struct PatchCell {
    double noise_ms{}, choose_ms{}, draw_ms{};
    std::uint64_t triangles{};
};

Result<PatchCell> time_patches(FixedPatches& patches, PatchWay way, PatchRequest request,
                               const BenchOptions& options) {
    PatchCell cell;
    for (const auto start = Clock::now(); seconds_since(start) < options.warm_up_s;)
        ORO_CHECK(patches.draw(way, request));
    std::vector<double> noise, choose, draw;
    for (int i = 0; i < options.frames; ++i) {
        ORO_TRY(const PatchFrameReport report, patches.draw(way, request));
        noise.push_back(1e3 * report.noise_s);
        choose.push_back(1e3 * report.choose_s);
        draw.push_back(1e3 * report.draw_s);
    }
    cell.noise_ms = median_of(std::move(noise));
    cell.choose_ms = median_of(std::move(choose));
    cell.draw_ms = median_of(std::move(draw));
    ORO_TRY(const auto of_levels, patches.patches_of_levels());
    for (std::uint32_t level = 0; level < of_levels.size(); ++level)
        cell.triangles += std::uint64_t{of_levels[level]} * 2U << (2U * level);
    return cell;
}

void print_patch_row(int patches, const std::string& way, const char* arm, const PatchCell& cell) {
    std::printf("| %d | %s | %s | %llu | %.3f | %.3f | %.3f | %.3f | %.3f |\n", patches, way.c_str(), arm,
                static_cast<unsigned long long>(cell.triangles), cell.noise_ms, cell.choose_ms, cell.draw_ms,
                cell.noise_ms + cell.choose_ms + cell.draw_ms, cell.choose_ms + cell.draw_ms);
    std::fflush(stdout);
}
ordered_json json_of_cell(int patches, const std::string& way, const char* arm, const PatchCell& cell) {
    return {{"patches", patches},
            {"way", way},
            {"arm", arm},
            {"triangles", cell.triangles},
            {"noise_ms", cell.noise_ms},
            {"choose_ms", cell.choose_ms},
            {"draw_ms", cell.draw_ms}};
}

// Milliseconds for as many posts as pages hold, by squares of the terrain one after the other.
Result<double> noise_of_pages_ms(const Gpu& gpu, const MadeTerrain& terrain, std::size_t pages, int frames) {
    const int side = std::min(static_cast<int>(gpu::height_stride), terrain.rows());
    const int across = terrain.columns() / side;
    std::vector<MadeRectangle> rectangles;
    for (int page = 0; page < static_cast<int>(pages); ++page)
        rectangles.push_back({page / across % across * side, side, page % across * side, side});
    ORO_TRY(MadePosts posts, MadePosts::create(gpu, terrain));
    std::vector<std::int32_t> steps(rectangles.size() * rectangles[0].count());
    std::vector<double> ms;
    for (int frame = 0; frame < frames; ++frame) {
        ORO_TRY(const double s, posts.make(rectangles, steps));
        ms.push_back(1e3 * s);
    }
    return median_of(std::move(ms));
}

// The levels over the same posts, by mesh shaders and by compute.
Result<void> time_levels(const Gpu& gpu, const MadeTerrain& terrain, const std::vector<std::int32_t>& steps,
                         const PatchBenchOptions& options, ordered_json& cells) {
    BenchRegion region;
    region.made = field_of(terrain, steps);
    region.pages = pages_in_memory(region.made, 1.0, thread_count());
    ORO_TRY(Scene scene, scene_of(gpu, options.bench, region));
    const Camera camera = eye_south_of(terrain, options.bench);
    // The GPU has waited for the processor to measure the levels, and its clock is low.
    BenchOptions levels = options.bench;
    levels.warm_up_s = std::max(levels.warm_up_s, 1.0);
    for (const auto& [way, path] :
         {std::pair{"mesh", RasterPath::mesh}, std::pair{"compute", RasterPath::compute}}) {
        if (!raster_path_for(way, gpu.report()).ok()) continue;
        ORO_TRY(FrameRenderer renderer, renderer_for(gpu, path, levels));
        ORO_TRY(const BenchTimes times, time_frames(scene, renderer, camera, levels));
        PatchCell cell{0.0, 1e3 * times.choose_s, 1e3 * times.raster_s, times.last.counts.triangles_drawn};
        ORO_TRY(cell.noise_ms,
                noise_of_pages_ms(gpu, terrain, static_cast<std::size_t>(times.last.pages), 30));
        const int patches = (terrain.rows() - 1) / 8;
        if (!options.bench.json) print_patch_row(patches, way, "levels", cell);
        cells.push_back(json_of_cell(patches, way, "levels", cell));
    }
    return {};
}

Result<void> time_square(const Gpu& gpu, int patches_a_side, const PatchBenchOptions& options,
                         ordered_json& cells) {
    const MadeTerrain terrain = square_of(patches_a_side);
    ORO_TRY(FixedPatches patches,
            FixedPatches::create(gpu, terrain, static_cast<std::uint32_t>(options.bench.width_px),
                                 static_cast<std::uint32_t>(options.bench.height_px)));
    for (const PatchWay way : patch_ways) {
        const Result<void> can = patches.check(way);
        if (!can.ok()) {
            std::fprintf(stderr, "orograph-bench: left out: %s\n", can.error().line().c_str());
            continue;
        }
        for (const PatchArm& arm : patch_arms) {
            const PatchRequest request{eye_south_of(terrain, options.bench), arm.level, arm.borders, true};
            ORO_TRY(const PatchCell cell, time_patches(patches, way, request, options.bench));
            if (!options.bench.json) print_patch_row(patches_a_side, name_of(way), arm.name, cell);
            cells.push_back(json_of_cell(patches_a_side, name_of(way), arm.name, cell));
        }
    }
    ORO_TRY(const std::vector<std::int32_t> steps, patches.heights());
    return time_levels(gpu, terrain, steps, options, cells);
}

}  // namespace

Result<void> print_patches(const Gpu& gpu, const PatchBenchOptions& options) {
    const BenchOptions& bench = options.bench;
    if (!bench.json)
        std::printf(
            "%s (%s), made terrain by patches of 8 x 8 quads of posts and by levels, %d x %d px, tau %g px, "
            "medians of %d frames, ms\n\n| patches a side | way | arm | triangles | noise | choice | drawing "
            "| noise each frame | cached |\n|---|---|---|---|---|---|---|---|---|\n",
            gpu.report().name.c_str(), gpu.report().driver.c_str(), bench.width_px, bench.height_px,
            bench.tau_px, bench.frames);
    ordered_json cells = ordered_json::array();
    if (options.most < published_patches[0]) ORO_CHECK(time_square(gpu, options.most, options, cells));
    for (const int patches : published_patches)
        if (patches <= options.most) ORO_CHECK(time_square(gpu, patches, options, cells));
    if (bench.json)
        std::printf("%s\n", ordered_json{{"device", gpu.report().name},
                                         {"driver", gpu.report().driver},
                                         {"size_px", {bench.width_px, bench.height_px}},
                                         {"tau_px", bench.tau_px},
                                         {"frames", bench.frames},
                                         {"cells", cells}}
                                .dump()
                                .c_str());
    return {};
}

}  // namespace oro

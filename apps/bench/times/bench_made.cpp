#include "apps/bench/times/bench_made.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/elapsed.h"
#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/made/made_heights.h"
#include "render/made/made_posts.h"
#include "shaders/shared.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, 8> kind_names{"fbm",  "ridged", "plane",  "cone",
                                                "sine", "step",   "sphere", "checker"};
constexpr int page_side = static_cast<int>(gpu::height_stride);
constexpr int pages_at_once = 64;

// By the CPU, as many threads as there are.
std::vector<std::int32_t> heights_by_cpu(const MadeTerrain& terrain) {
    const gpu::MadeRule rule = made_rule(terrain);
    const std::vector<MadeColumn> columns = made_columns(terrain, 0, terrain.columns());
    std::vector<std::int32_t> steps(static_cast<std::size_t>(terrain.rows()) * columns.size());
    in_parallel(terrain.rows(), thread_count(), [&](int row) {
        made_row_heights(
            terrain, rule, row, 0, columns,
            std::span(steps).subspan(static_cast<std::size_t>(row) * columns.size(), columns.size()));
    });
    return steps;
}

double page_by_cpu_us(const MadeTerrain& terrain, int frames) {
    const gpu::MadeRule rule = made_rule(terrain);
    const std::vector<MadeColumn> columns = made_columns(terrain, 0, page_side);
    std::vector<std::int32_t> steps(columns.size());
    std::vector<double> us;
    for (int frame = 0; frame < frames; ++frame) {
        const auto start = Clock::now();
        for (int row = 0; row < page_side; ++row) made_row_heights(terrain, rule, row, 0, columns, steps);
        us.push_back(1e6 * seconds_since(start));
    }
    return median_of(std::move(us));
}

Result<double> pages_us(MadePosts& posts, int pages, const MadeBenchOptions& options) {
    std::vector<MadeRectangle> rectangles;
    const int across = options.side / page_side;
    for (int page = 0; page < pages; ++page)
        rectangles.push_back(
            {page / across % across * page_side, page_side, page % across * page_side, page_side});
    std::vector<std::int32_t> steps(static_cast<std::size_t>(pages) * page_side * page_side);
    std::vector<double> us;
    for (int frame = 0; frame < options.frames; ++frame) {
        ORO_TRY(const double s, posts.make(rectangles, steps));
        us.push_back(1e6 * s / pages);
    }
    return median_of(std::move(us));
}

}  // namespace

MadeTerrain bench_terrain(MadeKind kind, int side) {
    MadeTerrain terrain;
    terrain.kind = kind;
    terrain.seed = 7;
    terrain.low = -200 * 2048;
    terrain.high = 4000 * 2048;
    terrain.west = 8 * 3600;
    terrain.east = terrain.west + side - 1;
    terrain.south = 46 * 3600;
    terrain.north = terrain.south + side - 1;
    terrain.length_m = 27000;
    terrain.radius_m = 15000;
    terrain.azimuth_deg = 30;
    return terrain;
}

Result<void> print_made(const Gpu& gpu, const MadeBenchOptions& options) {
    ordered_json json = ordered_json::object();
    json["device"] = gpu.report().name;
    if (!options.json)
        std::printf("%s: made terrain, %d x %d posts of each kind; microseconds a page of %d x %d posts\n",
                    gpu.report().name.c_str(), options.side, options.side, page_side, page_side);
    std::uint64_t all_differ = 0;
    for (std::size_t kind = 0; kind < kind_names.size(); ++kind) {
        const MadeTerrain terrain = bench_terrain(static_cast<MadeKind>(kind), options.side);
        ORO_TRY(MadePosts posts, MadePosts::create(gpu, terrain));
        const std::vector<std::int32_t> truth = heights_by_cpu(terrain);
        std::vector<std::int32_t> steps(truth.size());
        const std::array whole{MadeRectangle{0, terrain.rows(), 0, terrain.columns()}};
        ORO_TRY(const double whole_s, posts.make(whole, steps));
        std::uint64_t differ = 0;
        for (std::size_t post = 0; post < truth.size(); ++post) differ += steps[post] != truth[post] ? 1 : 0;
        all_differ += differ;
        ORO_TRY(const double alone_us, pages_us(posts, 1, options));
        ORO_TRY(const double among_us, pages_us(posts, pages_at_once, options));
        const double cpu_us = page_by_cpu_us(terrain, options.frames);
        ordered_json one = ordered_json::object();
        one["posts"] = truth.size();
        one["differ"] = differ;
        one["all_ms"] = 1e3 * whole_s;
        one["page_us"] = alone_us;
        one["page_of_64_us"] = among_us;
        one["page_by_cpu_us"] = cpu_us;
        if (!options.json)
            std::printf(
                "%-8s %zu posts, %llu differ; all %.3f ms; a page alone %.1f us, of %d %.2f us, CPU %.0f "
                "us\n",
                kind_names[kind], truth.size(), static_cast<unsigned long long>(differ), 1e3 * whole_s,
                alone_us, pages_at_once, among_us, cpu_us);
        json[kind_names[kind]] = std::move(one);
    }
    if (options.json) std::printf("%s\n", json.dump().c_str());
    if (all_differ > 0)
        return Error{ErrorKind::failed, "made terrain",
                     std::to_string(all_differ) + " posts of the GPU are not those of the CPU"};
    return {};
}

}  // namespace oro

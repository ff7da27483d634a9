#include "apps/bench/times/bench_made_pages.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "apps/bench/bench_style.h"
#include "apps/bench/times/bench_made.h"
#include "core/base/elapsed.h"
#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/made/made_heights.h"
#include "core/made_pages/made_pages.h"
#include "core/made_pages/page_sources.h"
#include "render/device/timestamps.h"
#include "render/frame/frame_renderer.h"
#include "render/made/gpu_post_maker.h"
#include "render/scene/scene.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

constexpr std::array<std::pair<HeightMaker, const char*>, 2> makers{
    {{HeightMaker::processor, "sent"}, {HeightMaker::gpu, "made"}}};
constexpr std::size_t pages_at_once = 64;

PostGrid grid_of(const MadeTerrain& terrain) {
    const auto per_deg = static_cast<double>(terrain.posts_per_deg);
    PostGrid grid;
    grid.lat = {per_deg, 0.0, terrain.north, -1, terrain.rows()};
    grid.lon = {per_deg, 0.0, terrain.west, 1, terrain.columns()};
    return grid;
}

// N at nodes a quarter of a degree apart, as a geoid has them.
UndulationField undulation_over(const PostGrid& grid) {
    UndulationField undulation;
    const auto node = [](double deg) { return static_cast<std::int64_t>(std::floor(4.0 * deg)); };
    const std::int64_t north = node(grid.north_deg()) + 1, west = node(grid.west_deg());
    undulation.lat = {4.0, 0.0, north, -1, static_cast<int>(north - node(grid.south_deg()) + 1)};
    undulation.lon = {4.0, 0.0, west, 1, static_cast<int>(node(grid.east_deg()) - west + 2)};
    for (int i = 0; i < undulation.lat.count * undulation.lon.count; ++i)
        undulation.N_m.push_back(45.0F + 0.37F * static_cast<float>(i % 11));
    return undulation;
}

// Posts in memory with all levels, as a region that is opened has them.
std::unique_ptr<RegionPages> bounded_pages(const MadeTerrain& terrain) {
    HeightField field;
    field.grid = grid_of(terrain);
    field.undulation = undulation_over(field.grid);
    const gpu::MadeRule rule = made_rule(terrain);
    const std::vector<MadeColumn> columns = made_columns(terrain, 0, terrain.columns());
    field.H_m.resize(field.grid.post_count());
    in_parallel(terrain.rows(), thread_count(), [&](int row) {
        std::vector<std::int32_t> steps(columns.size());
        made_row_heights(terrain, rule, row, 0, columns, steps);
        for (std::size_t i = 0; i < steps.size(); ++i)
            field.H_m[static_cast<std::size_t>(row) * columns.size() + i] =
                static_cast<float>(steps[i] * made_step_m);
    });
    auto pages = pages_in_memory(field, 1.0, thread_count());
    pages->set_made_ground(std::make_shared<const MadeGround>(
        MadeGround{rule, terrain.posts_per_deg, terrain.north, terrain.west}));
    return pages;
}

Result<std::shared_ptr<const MadePageHeights>> heights_of(const Gpu& gpu, const RegionPages& pages) {
    return MadePageHeights::create(gpu, *pages.made_ground(), pages.facts().undulation, 1.0, {});
}

// Microseconds of the GPU a page, where so many are made in one submission.
Result<double> gpu_us(const Gpu& gpu, const RegionPages& pages, std::size_t count, int frames) {
    ORO_TRY(const std::shared_ptr<const MadePageHeights> heights, heights_of(gpu, pages));
    constexpr VkBufferUsageFlags shaders =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    ORO_TRY(const Buffer sources, create_buffer(gpu, count * sizeof(gpu::MadePageSource), shaders,
                                                MemoryKind::upload, "sources of pages"));
    ORO_TRY(const Buffer blocks, create_buffer(gpu, count * sizeof(gpu::PageBlock::heights), shaders,
                                               MemoryKind::device, "heights of pages"));
    const int across = pages.layout(0).columns;
    for (std::size_t i = 0; i < count; ++i) {
        gpu::MadePageSource source;
        const auto page = static_cast<int>(i % pages.layout(0).count());
        set_page_source(pages.facts().grid, pages.facts().undulation, *pages.made_ground(),
                        {page / across, page % across, 0}, source);
        std::memcpy(sources.mapped + i * sizeof source, &source, sizeof source);
    }
    ORO_TRY(const OwnedQueryPool timestamps, create_timestamps(gpu, 2, "timestamps of pages"));
    const VkQueryPool pool = timestamps.get();
    ORO_TRY(Commands commands, Commands::create(gpu, "heights of pages"));
    std::vector<double> us;
    for (int frame = 0; frame < frames; ++frame) {
        ORO_CHECK(commands.run(gpu, [&](VkCommandBuffer recorded) {
            wait_for_earlier(recorded);
            vkCmdResetQueryPool(recorded, pool, 0, 2);
            vkCmdWriteTimestamp2(recorded, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, 0);
            for (std::size_t i = 0; i < count; ++i)
                heights->record(recorded, sources.address + i * sizeof(gpu::MadePageSource),
                                blocks.address + i * sizeof(gpu::PageBlock::heights));
            vkCmdWriteTimestamp2(recorded, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, 1);
        }));
        std::array<std::uint64_t, 2> ticks{};
        ORO_VK(vkGetQueryPoolResults(gpu.device(), pool, 0, 2, sizeof ticks, ticks.data(), sizeof ticks[0],
                                     VK_QUERY_RESULT_64_BIT));
        us.push_back(1e6 * gpu.seconds_between(ticks[0], ticks[1]) / static_cast<double>(count));
    }
    return median_of(std::move(us));
}

// Of one thread, microseconds a page until it can be sent.
double processor_us(const RegionPages& pages, HeightMaker maker) {
    const PageLayout layout = pages.layout(0);
    std::vector<double> us;
    const auto block = std::make_unique<gpu::PageBlock>();
    const auto source = std::make_unique<gpu::MadePageSource>();
    const PageSources sources(pages.facts().grid, pages.facts().undulation, *pages.made_ground());
    for (int row = 0; row < layout.rows; ++row)
        for (int column = 0; column < layout.columns; ++column) {
            const auto start = Clock::now();
            if (maker == HeightMaker::gpu) {
                static_cast<void>(pages.load_without_heights({row, column, 0}, *block));
                sources.set({row, column, 0}, *source);
            } else {
                static_cast<void>(pages.load({row, column, 0}, *block));
            }
            us.push_back(1e6 * seconds_since(start));
        }
    return median_of(std::move(us));
}

struct Loads {
    double page_us{};  // of the clock
    double bytes_a_page{};
    std::map<PageIndex, std::vector<std::byte>> blocks;
};

// All pages of level 0, again and again, as a scene loads them.
Result<Loads> time_loads(const Gpu& gpu, const RegionPages& pages, HeightMaker maker, int frames) {
    std::shared_ptr<const MadePageHeights> heights;
    if (maker == HeightMaker::gpu) {
        ORO_TRY(heights, heights_of(gpu, pages));
    }
    const PageLayout layout = pages.layout(0);
    const auto count = static_cast<std::size_t>(layout.count());
    PageStore store(gpu, std::make_shared<MemoryBudget>((count + 1) * sizeof(gpu::PageBlock)), {}, {},
                    heights);
    const auto loader = page_loader(pages, thread_count(), main_bytes(0) / sizeof(gpu::PageBlock), {}, false,
                                    heights != nullptr);
    std::vector<PageIndex> all;
    for (int row = 0; row < layout.rows; ++row)
        for (int column = 0; column < layout.columns; ++column) all.push_back({row, column, 0});
    std::vector<double> us;
    for (int frame = 0; frame < frames; ++frame) {
        store.clear();
        store.begin_frame();
        gpu.wait_idle();
        const auto start = Clock::now();
        loader->request(all);
        while (store.size() < count) {
            ORO_TRY(const std::vector<LoadedPage> ready, loader->take(true));
            ORO_TRY(const std::size_t sent, store.send(ready));
            if (sent < ready.size()) return Error{ErrorKind::failed, "--made-pages", "too little GPU memory"};
        }
        gpu.wait_idle();
        us.push_back(1e6 * seconds_since(start) / static_cast<double>(count));
    }
    Loads loads;
    loads.page_us = median_of(std::move(us));
    loads.bytes_a_page = static_cast<double>(store.bytes_sent()) / static_cast<double>(store.pages_sent());
    ORO_TRY(std::vector<PageStore::KeptBlock> blocks, store.read_blocks(gpu));
    for (PageStore::KeptBlock& block : blocks) loads.blocks.emplace(block.index, std::move(block.bytes));
    return loads;
}

Result<ordered_json> time_bounded(const Gpu& gpu, const MadePagesBenchOptions& options) {
    const std::unique_ptr<RegionPages> pages = bounded_pages(bench_terrain(MadeKind::fbm, options.side));
    ordered_json json = ordered_json::object();
    json["pages"] = pages->layout(0).count();
    ORO_TRY(json["gpu_us_alone"], gpu_us(gpu, *pages, 1, options.frames));
    ORO_TRY(json["gpu_us_of_64"], gpu_us(gpu, *pages, pages_at_once, options.frames));
    std::vector<Loads> both;
    for (const auto& [maker, name] : makers) {
        ORO_TRY(Loads loads, time_loads(gpu, *pages, maker, options.frames));
        ordered_json one = ordered_json::object();
        one["page_us"] = loads.page_us;
        one["processor_us"] = processor_us(*pages, maker);
        one["bytes_a_page"] = loads.bytes_a_page;
        json[name] = std::move(one);
        both.push_back(std::move(loads));
    }
    std::size_t differ = 0;
    for (const auto& [page, bytes] : both[0].blocks) differ += both[1].blocks.at(page) == bytes ? 0 : 1;
    json["pages_that_differ"] = differ;
    return json;
}

// That of docs/notes/2026-11-29-made-worlds.md: a second apart from 60 S to 60 N.
MadeTerrain world_terrain() {
    MadeTerrain terrain = bench_terrain(MadeKind::fbm, 2);
    terrain.octaves = 12;
    terrain.west = std::int64_t{-179} * 3600;
    terrain.east = std::int64_t{179} * 3600;
    terrain.south = std::int64_t{-60} * 3600;
    terrain.north = std::int64_t{60} * 3600;
    return terrain;
}

FrameView world_view(const MadeTerrain& terrain, const MadePagesBenchOptions& options) {
    Camera camera;
    camera.width_px = options.width_px;
    camera.height_px = options.height_px;
    camera.eye = {46.5, 8.3, made_height_m(terrain, made_rule(terrain), 46.5, 8.3) + 1200.0};
    camera.attitude = {0.0, -6.0, 0.0};
    FrameView view;
    view.camera = camera;
    view.tile = {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
    view.tau_px = options.tau_px;
    return view;
}

// How a world's pages come: made and measured by the processor; posts that are measured made by the GPU; and
// heights of pages as well. By bounds: within so many times the error, as a window begins
// (apps/window/world_levels.h); its picture is another.
struct WorldWay {
    const char* name;
    bool measures_by_gpu;
    HeightMaker maker;
    bool is_by_bounds{};
};
constexpr std::array<WorldWay, 5> world_ways{{{"sent", false, HeightMaker::processor},
                                              {"sent, posts made", true, HeightMaker::processor},
                                              {"made", true, HeightMaker::gpu},
                                              {"by bounds, sent", false, HeightMaker::processor, true},
                                              {"by bounds, made", true, HeightMaker::gpu, true}}};
constexpr std::size_t first_by_bounds = 3;
constexpr double times_tau_by_bounds = 32.0;

// Of a world's first picture, seconds.
struct WorldTimes {
    double pages_s{};  // what of the ground may show
    double plan_s{};   // pages chosen, measured, made and sent
    double draw_s{};
    std::uint64_t pages{}, made{};
    std::vector<std::uint8_t> picture;
    [[nodiscard]] double all_s() const { return pages_s + plan_s + draw_s; }
};

Result<WorldTimes> time_world(const Gpu& gpu, FrameRenderer& renderer, const WorldWay& way,
                              const MadePagesBenchOptions& options) {
    WorldTimes times;
    auto start = Clock::now();
    const MadeTerrain terrain = world_terrain();
    const HeightField field = made_field(terrain, grid_of(terrain), {});
    FrameView view = world_view(terrain, options);
    if (way.is_by_bounds) view.tau_px *= times_tau_by_bounds;
    KnownPictures known;
    known.views = {view};
    const MadePostSource& posts = *made_posts_of(field);
    std::unique_ptr<RegionPages> pages =
        way.is_by_bounds ? posts.pages_by_bounds(field) : posts.pages(field, known);
    if (way.measures_by_gpu) make_posts_by(*pages, gpu_post_maker(gpu));
    times.pages_s = seconds_since(start);
    start = Clock::now();
    ORO_TRY(Scene scene, Scene::create(gpu, std::move(pages), {}, HeightStorage::f32, false, way.maker));
    // All threads that load pages make their records, too, as in a window.
    if (way.is_by_bounds) scene.wait_for_records(false);
    ORO_TRY(FramePlan plan, scene.settled_plan(view));
    times.plan_s = seconds_since(start);
    start = Clock::now();
    ORO_CHECK(renderer.draw(std::move(plan), bench_style()));
    ORO_TRY(times.picture, renderer.read_picture(view.width_px(), view.height_px()));
    times.draw_s = seconds_since(start);
    times.pages = scene.grids()[0].store().pages_sent();
    times.made = scene.grids()[0].store().pages_made();
    return times;
}

ordered_json world_json(const std::vector<WorldTimes>& runs) {
    const auto median = [&](const auto& value) {
        std::vector<double> values;
        for (const WorldTimes& run : runs) values.push_back(value(run));
        return median_of(std::move(values));
    };
    ordered_json json = ordered_json::object();
    json["picture_s"] = median([](const WorldTimes& run) { return run.all_s(); });
    json["what_shows_s"] = median([](const WorldTimes& run) { return run.pages_s; });
    json["pages_s"] = median([](const WorldTimes& run) { return run.plan_s; });
    json["draw_s"] = median([](const WorldTimes& run) { return run.draw_s; });
    json["pages"] = runs.back().pages;
    json["made"] = runs.back().made;
    return json;
}

// All ways in turn.
Result<ordered_json> time_worlds(const Gpu& gpu, double device_s, const MadePagesBenchOptions& options) {
    const auto start = Clock::now();
    FrameRendererOptions wanted;
    wanted.extent = {static_cast<std::uint32_t>(options.width_px),
                     static_cast<std::uint32_t>(options.height_px)};
    wanted.path = options.path;
    ORO_TRY(FrameRenderer renderer, FrameRenderer::create(gpu, wanted));
    ordered_json json = ordered_json::object();
    json["device_and_programs_s"] = device_s + seconds_since(start);
    std::array<std::vector<WorldTimes>, world_ways.size()> runs;
    for (int run = 0; run < std::max(3, options.frames / 6); ++run)
        for (std::size_t i = 0; i < world_ways.size(); ++i) {
            ORO_TRY(WorldTimes times, time_world(gpu, renderer, world_ways[i], options));
            runs[i].push_back(std::move(times));
        }
    std::size_t differ = 0;
    for (std::size_t i = 0; i < world_ways.size(); ++i)
        for (const WorldTimes& one : runs[i])
            differ +=
                one.picture == runs[world_ways[i].is_by_bounds ? first_by_bounds : 0][0].picture ? 0 : 1;
    for (std::size_t i = 0; i < world_ways.size(); ++i) json[world_ways[i].name] = world_json(runs[i]);
    json["pictures_that_differ"] = differ;
    return json;
}

void print_bounded(const ordered_json& json) {
    std::printf("terrain in memory, %d pages: heights on the GPU %.2f us a page alone, %.2f of 64\n",
                json["pages"].get<int>(), json["gpu_us_alone"].get<double>(),
                json["gpu_us_of_64"].get<double>());
    for (const auto& [maker, name] : makers) {
        const ordered_json& one = json[name];
        std::printf("  %s: %.1f us of the clock a page, %.1f us of one thread, %.0f bytes sent\n", name,
                    one["page_us"].get<double>(), one["processor_us"].get<double>(),
                    one["bytes_a_page"].get<double>());
    }
    std::printf("  pages that differ: %d\n", json["pages_that_differ"].get<int>());
}

void print_worlds(const ordered_json& json) {
    std::printf("world of 5.6e11 posts, first picture; device and programs before it %.3f s\n",
                json["device_and_programs_s"].get<double>());
    for (const WorldWay& way : world_ways) {
        const char* const name = way.name;
        const ordered_json& one = json[name];
        std::printf(
            "  %s: %.3f s (what shows %.3f, pages %.3f, drawing %.3f); %d pages, heights of %d made by the "
            "GPU\n",
            name, one["picture_s"].get<double>(), one["what_shows_s"].get<double>(),
            one["pages_s"].get<double>(), one["draw_s"].get<double>(), one["pages"].get<int>(),
            one["made"].get<int>());
    }
    std::printf("  pictures that differ: %d\n", json["pictures_that_differ"].get<int>());
}

}  // namespace

Result<void> print_made_pages(const Gpu& gpu, double device_s, const MadePagesBenchOptions& options) {
    ordered_json json = ordered_json::object();
    json["device"] = gpu.report().name;
    json["threads"] = thread_count();
    if (!options.json) std::printf("%s, %d threads\n", gpu.report().name.c_str(), thread_count());
    ORO_TRY(json["bounded"], time_bounded(gpu, options));
    if (!options.json) print_bounded(json["bounded"]);
    ORO_TRY(json["world"], time_worlds(gpu, device_s, options));
    if (options.json)
        std::printf("%s\n", json.dump().c_str());
    else
        print_worlds(json["world"]);
    if (json["bounded"]["pages_that_differ"] != 0 || json["world"]["pictures_that_differ"] != 0)
        return Error{ErrorKind::failed, "made pages", "those of the GPU are not those of the CPU"};
    return {};
}

}  // namespace oro

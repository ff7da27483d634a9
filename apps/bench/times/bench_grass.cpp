#include "apps/bench/times/bench_grass.h"

#include <array>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/base/elapsed.h"
#include "core/base/median.h"
#include "render/grass/grass_renderer.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

// Medians of the frames of one cell of a table.
struct GrassCell {
    GrassFrameReport last;
    double cull_ms{};
    double draw_ms{};
    double all_ms{};
};
// By the eye's height, then by the switch distance.
using GrassTable =
    std::array<std::array<GrassCell, grass_switch_distances_m.size()>, grass_eye_heights_m.size()>;

struct TimedWay {
    GrassWay way{};
    GrassTable table{};
    // Of each height: pixels that show another blade than by the first way, all blades with the most
    // vertices.
    std::array<std::size_t, grass_eye_heights_m.size()> other_pixels{};
};

GrassRequest grass_request(const GrassBenchOptions& options, int eye_height_m, float switch_m) {
    GrassRequest request;
    request.view = grass_view_down(static_cast<float>(eye_height_m), options.width_px, options.height_px);
    request.switch_m = switch_m;
    if (options.wind) request.wind_time_s = 10.0F;
    request.by_boxes = options.by_boxes;
    request.thins = options.thins;
    return request;
}

Result<GrassCell> time_cell(GrassRenderer& renderer, GrassWay way, const GrassRequest& request,
                            const GrassBenchOptions& options) {
    GrassCell cell;
    ORO_TRY(cell.last, renderer.draw(way, request));
    for (const auto start = Clock::now(); seconds_since(start) < options.warm_up_s;)
        ORO_CHECK(renderer.draw(way, request));
    std::vector<double> cull, draw, all;
    for (int i = 0; i < options.frames; ++i) {
        ORO_TRY(cell.last, renderer.draw(way, request));
        cull.push_back(1e3 * cell.last.cull_s);
        draw.push_back(1e3 * cell.last.draw_s);
        all.push_back(cull.back() + draw.back());
    }
    cell.cull_ms = median_of(std::move(cull));
    cell.draw_ms = median_of(std::move(draw));
    cell.all_ms = median_of(std::move(all));
    return cell;
}

Result<GrassTable> time_table(GrassRenderer& renderer, GrassWay way, const GrassBenchOptions& options) {
    GrassTable table;
    for (std::size_t row = 0; row < table.size(); ++row)
        for (std::size_t column = 0; column < table[row].size(); ++column) {
            const auto switch_m = static_cast<float>(grass_switch_distances_m[column]);
            ORO_TRY(table[row][column],
                    time_cell(renderer, way, grass_request(options, grass_eye_heights_m[row], switch_m),
                              options));
        }
    return table;
}

// Pixels of each height that show another blade than those of `first`, which the first way fills.
Result<void> compare_pixels(GrassRenderer& renderer, TimedWay& timed,
                            std::array<std::vector<std::uint32_t>, grass_eye_heights_m.size()>& first,
                            const GrassBenchOptions& options) {
    for (std::size_t row = 0; row < first.size(); ++row) {
        ORO_CHECK(renderer.draw(timed.way, grass_request(options, grass_eye_heights_m[row],
                                                         std::numeric_limits<float>::infinity())));
        ORO_TRY(std::vector<std::uint32_t> blades, renderer.blades());
        if (first[row].empty()) first[row] = blades;
        for (std::size_t i = 0; i < blades.size(); ++i)
            timed.other_pixels[row] += blades[i] != first[row][i] ? 1 : 0;
    }
    return {};
}

void print_head(const char* corner) {
    std::printf("| %s |", corner);
    for (const int distance_m : grass_switch_distances_m) std::printf(" %d |", distance_m);
    std::printf("\n|---|");
    for (std::size_t i = 0; i < grass_switch_distances_m.size(); ++i) std::printf("---|");
    std::printf("\n");
}

// One table; value(cell of row and column) as text.
template <class Value>
void print_table(const std::string& title, const Value& value) {
    std::printf("\n%s\n\n", title.c_str());
    print_head("eye \\ switch, m");
    for (std::size_t row = 0; row < grass_eye_heights_m.size(); ++row) {
        std::printf("| %d |", grass_eye_heights_m[row]);
        for (std::size_t column = 0; column < grass_switch_distances_m.size(); ++column)
            std::printf(" %.3f |", value(row, column));
        std::printf("\n");
    }
}

std::string title_of(GrassWay way) {
    const char* published = way == GrassWay::vertex   ? " (the dissertation's Table 4)"
                            : way == GrassWay::clumps ? " (the dissertation's Table 8)"
                                                      : "";
    return name_of(way) + published + ", ms: clumps chosen and drawn";
}

// The dissertation's Table 1 is of a field of as many blades alone.
void print_counts(const GrassBenchOptions& options, const std::vector<TimedWay>& ways) {
    const bool published = options.blades == grass_published_blades.back();
    std::printf(
        "\nBlades drawn, and pixels that show another blade than by the first way, all with 32 vertices\n\n");
    std::printf("| eye, m | blades |%s", published ? " in Table 1 |" : "");
    for (const TimedWay& timed : ways) std::printf(" other pixels: %s |", name_of(timed.way).c_str());
    std::printf("\n|---|---|%s", published ? "---|" : "");
    for (std::size_t i = 0; i < ways.size(); ++i) std::printf("---|");
    std::printf("\n");
    for (std::size_t row = 0; row < grass_eye_heights_m.size(); ++row) {
        const GrassFrameReport& last = ways[0].table[row][0].last;
        std::printf("| %d | %u |", grass_eye_heights_m[row], last.blades_near + last.blades_far);
        if (published) std::printf(" %u |", grass_published_blades[row]);
        for (const TimedWay& timed : ways) std::printf(" %zu |", timed.other_pixels[row]);
        std::printf("\n");
    }
}

void print_tables_of_ways(const GrassBenchOptions& options, const std::vector<TimedWay>& ways) {
    for (const TimedWay& timed : ways) {
        print_table(title_of(timed.way),
                    [&](std::size_t row, std::size_t column) { return timed.table[row][column].all_ms; });
        const double cull_ms = timed.table.back().back().cull_ms;
        std::printf("\nOf the last cell clumps take %.3f ms to choose.\n", cull_ms);
    }
    for (std::size_t i = 1; i < ways.size(); ++i)
        print_table(name_of(ways[i].way) + " over " + name_of(ways[0].way),
                    [&](std::size_t row, std::size_t column) {
                        return ways[i].table[row][column].all_ms / ways[0].table[row][column].all_ms;
                    });
    for (const TimedWay& timed : ways)
        if (timed.way == GrassWay::clumps || timed.way == GrassWay::packed)
            print_table(name_of(timed.way) + ": thousands of mesh workgroups",
                        [&](std::size_t row, std::size_t column) {
                            return 1e-3 * timed.table[row][column].last.mesh_groups;
                        });
    print_counts(options, ways);
}

ordered_json json_of_way(const TimedWay& timed) {
    ordered_json json = ordered_json::object();
    json["way"] = name_of(timed.way);
    json["cells"] = ordered_json::array();
    for (std::size_t row = 0; row < timed.table.size(); ++row)
        for (std::size_t column = 0; column < timed.table[row].size(); ++column) {
            const GrassCell& cell = timed.table[row][column];
            json["cells"].push_back({{"eye_m", grass_eye_heights_m[row]},
                                     {"switch_m", grass_switch_distances_m[column]},
                                     {"cull_ms", cell.cull_ms},
                                     {"draw_ms", cell.draw_ms},
                                     {"ms", cell.all_ms},
                                     {"blades_near", cell.last.blades_near},
                                     {"blades_far", cell.last.blades_far},
                                     {"mesh_groups", cell.last.mesh_groups}});
        }
    json["other_pixels"] = timed.other_pixels;
    return json;
}

ordered_json json_of_grass(const Gpu& gpu, const GrassBenchOptions& options,
                           const std::vector<TimedWay>& ways) {
    ordered_json json = ordered_json::object();
    json["device"] = gpu.report().name;
    json["driver"] = gpu.report().driver;
    json["blades"] = options.blades;
    json["size_px"] = {options.width_px, options.height_px};
    json["frames"] = options.frames;
    json["boxes"] = options.by_boxes;
    json["thinning"] = options.thins;
    json["wind"] = options.wind;
    json["ways"] = ordered_json::array();
    for (const TimedWay& timed : ways) json["ways"].push_back(json_of_way(timed));
    return json;
}

}  // namespace

Result<void> print_grass(const Gpu& gpu, const GrassBenchOptions& options) {
    ORO_TRY(GrassRenderer renderer,
            GrassRenderer::create(gpu, grass_field(options.blades), options.width_px, options.height_px));
    if (!options.json)
        std::printf(
            "%s (%s), grass: a field of %u blades, %u x %u px, straight down, clumps left out by their %s, "
            "%s, %s; "
            "medians of %d frames\n",
            gpu.report().name.c_str(), gpu.report().driver.c_str(), options.blades, options.width_px,
            options.height_px, options.by_boxes ? "boxes" : "feet",
            options.thins ? "no blade below a pixel" : "all blades", options.wind ? "wind" : "no wind",
            options.frames);
    std::vector<TimedWay> ways;
    std::array<std::vector<std::uint32_t>, grass_eye_heights_m.size()> first;
    for (const GrassWay way : grass_ways) {
        const Result<void> can = renderer.check(way);
        if (!can.ok()) {
            std::fprintf(stderr, "orograph-bench: left out: %s\n", can.error().line().c_str());
            continue;
        }
        std::fprintf(stderr, "orograph-bench: %s ...\n", name_of(way).c_str());
        TimedWay timed;
        timed.way = way;
        ORO_CHECK(compare_pixels(renderer, timed, first, options));
        ORO_TRY(timed.table, time_table(renderer, way, options));
        ways.push_back(timed);
    }
    if (options.json)
        std::printf("%s\n", json_of_grass(gpu, options, ways).dump().c_str());
    else
        print_tables_of_ways(options, ways);
    return {};
}

}  // namespace oro

#include "apps/bench/times/bench_moving.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <deque>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/bench/times/bench_flights.h"
#include "apps/bench/times/bench_plans.h"
#include "apps/bench/times/bench_random.h"
#include "apps/bench/times/bench_region.h"
#include "apps/bench/times/bench_times.h"
#include "apps/report/json_object.h"
#include "core/base/checksum.h"
#include "core/base/elapsed.h"
#include "core/lod/ground_means.h"
#include "render/device/raster_request.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

// Of each frame that counts, seconds.
struct MovingTimes {
    std::vector<double> frame;      // from one frame's begin to the next's: by the GPU or the processor
    std::vector<double> processor;  // of that: planned, loaded and recorded, and no wait
    std::vector<double> planned;    // processor: all of the plan,
    std::vector<double> pages;      // and of that: pages and their tables,
    std::vector<double> clusters;   // clusters and theirs,
    std::vector<double> casters;    // what casts shadows,
    std::vector<double> growth;     // tiles of trees
    std::vector<double> loaded;     // processor: what frames have shown, what comes to the GPU
    std::vector<double> recorded;   // processor: tables to the GPU, commands
    std::vector<double> waited;     // for the GPU
    std::vector<double> gpu;        // GPU timestamps
    std::vector<double> latency;    // from a frame's camera to its picture
    std::size_t frames{}, not_whole{};
    double triangles{};
};

// A window's loop.
class MovingEye {
  public:
    MovingEye(Scene& scene, FrameRenderer& renderer, const BenchOptions& options, MovingTimes& times)
        : scene_(scene), renderer_(renderer), options_(options), times_(times) {}

    Result<void> fly(const RandomFlight& flight) {
        const Camera& first = flight.cameras.front();
        ORO_CHECK(settled_as_window(scene_, first, whole_picture(first), options_));
        const auto begun = last_ = Clock::now();
        for (std::size_t i = 0; i < flight.cameras.size(); ++i) {
            if (options_.frame_rate_hz > 0.0) ORO_CHECK(wait_for_turn(begun, i));
            ORO_CHECK(draw(flight.cameras[i], i > frames_in_flight));
        }
        counts_ = false;
        return take_reports(0);
    }

    static Tile whole_picture(const Camera& camera) {
        return {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
    }

  private:
    // As a window that has nothing to draw until then: nothing is left under way.
    Result<void> wait_for_turn(Clock::time_point begun, std::size_t frame) {
        ORO_CHECK(take_reports(0));
        const std::chrono::duration<double> turn(static_cast<double>(frame) / options_.frame_rate_hz);
        std::this_thread::sleep_until(begun + std::chrono::duration_cast<Clock::duration>(turn));
        return {};
    }
    void add(std::vector<double>& values, double value_s) {
        if (counts_) values.push_back(value_s);
    }

    // counts: the frames before it were submitted as this one is.
    Result<void> draw(const Camera& camera, bool counts) {
        counts_ = counts;
        loaded_s_ = 0.0;
        const auto begun = Clock::now();
        ORO_CHECK(take_reports(frames_in_flight - 1));
        add(times_.waited, seconds_since(begun) - loaded_s_);
        auto start = Clock::now();
        if (is_missing_) ORO_CHECK(scene_.advance(NextPlan::anyway));
        double processor_s = loaded_s_ + seconds_since(start);
        add(times_.loaded, processor_s);
        begun_.push_back(start = Clock::now());
        scene_.set_fallback_to_blocks(true);
        ORO_TRY(FramePlan plan, scene_.plan({camera, whole_picture(camera), options_.tau_px}));
        const double planned_s = seconds_since(start);
        add(times_.planned, planned_s);
        const PlanTimes parts = scene_.times_of_plan();
        add(times_.pages, parts.pages_s);
        add(times_.clusters, parts.clusters_s);
        add(times_.casters, parts.casters_s);
        add(times_.growth, parts.growth_s);
        is_missing_ = !plan.is_settled();
        start = Clock::now();
        ORO_CHECK(renderer_.submit(std::move(plan), options_.style, scene_.drapes()));
        const double recorded_s = seconds_since(start);
        add(times_.recorded, recorded_s);
        processor_s += planned_s + recorded_s;
        add(times_.processor, processor_s);
        add(times_.frame, std::chrono::duration<double>(Clock::now() - last_).count());
        last_ = Clock::now();
        if (!counts) return {};
        ++times_.frames;
        times_.not_whole += is_missing_ ? 1 : 0;
        return {};
    }

    Result<void> take_reports(std::size_t left) {
        while (renderer_.under_way() > left) {
            ORO_TRY(const FrameReport report, renderer_.finish());
            add(times_.latency, seconds_since(begun_.front()));
            begun_.pop_front();
            add(times_.gpu, report.gpu_s());
            if (counts_) times_.triangles += report.counts.triangles_drawn;
            const auto start = Clock::now();
            scene_.apply_feedback(report.feedback);
            loaded_s_ += seconds_since(start);
        }
        return {};
    }

    Scene& scene_;
    FrameRenderer& renderer_;
    const BenchOptions& options_;
    MovingTimes& times_;
    std::deque<Clock::time_point> begun_;  // when the frames under way took their cameras
    Clock::time_point last_;
    double loaded_s_{};
    bool is_missing_{}, counts_{};
};

// All that a plan tells the GPU, but for where in its memory that lies.
void add_plan(GridPlan plan, RunningChecksum& sum) {
    const auto add = [&](const auto& values) { sum.add(std::as_bytes(std::span(values))); };
    for (gpu::FramePage& page : plan.pages) page.block = page.means = page.places = gpu::uvec2(0U);
    for (gpu::DrawnCluster& cluster : plan.clusters.drawn) cluster.block = gpu::uvec2(0U);
    for (gpu::CasterPage& page : plan.casters.pages) page.block = gpu::uvec2(0U);
    plan.constants.undulation.N_m = gpu::uvec2(0U);
    add(std::span(&plan.constants, 1));
    add(plan.pages);
    add(plan.row_terms);
    add(plan.column_terms);
    add(plan.clusters.drawn);
    add(plan.clusters.boxes);
    add(plan.clusters.asked);
    add(plan.casters.pages);
    add(plan.casters.table);
    add(std::span(&plan.casters.frame, 1));
    add(plan.growth.tiles);
}

// The plan of an eye once all is here that frames of it may want, coarser clusters, too.
Result<FramePlan> plan_of_all(Scene& scene, const Camera& camera, const BenchOptions& options) {
    constexpr int times_the_same = 4;
    const Tile tile = MovingEye::whole_picture(camera);
    ORO_TRY(FramePlan plan, settled_as_window(scene, camera, tile, options));
    for (int same = 0; same < times_the_same; ++same) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ORO_CHECK(scene.advance());
        const std::size_t before = plan.grids.front().clusters.drawn.size();
        ORO_TRY(plan, settled_as_window(scene, camera, tile, options));
        if (plan.grids.front().clusters.drawn.size() != before) same = -1;
    }
    return plan;
}

struct Percentiles {
    double median{}, at_95{}, at_99{}, worst{};  // milliseconds
};
Percentiles percentiles_of(std::vector<double> values_s) {
    if (values_s.empty()) return {};
    std::ranges::sort(values_s);
    const auto at = [&](std::size_t percent) {
        return 1e3 * values_s[std::max<std::size_t>(1, (percent * values_s.size() + 99) / 100) - 1];
    };
    return {at(50), at(95), at(99), at(100)};
}

// Each column of the table, in its order.
struct MovingColumn {
    const char* key;
    std::vector<double> MovingTimes::*values;
};
constexpr MovingColumn columns[] = {
    {"frame_ms", &MovingTimes::frame},       {"processor_ms", &MovingTimes::processor},
    {"planned_ms", &MovingTimes::planned},   {"pages_ms", &MovingTimes::pages},
    {"clusters_ms", &MovingTimes::clusters}, {"casters_ms", &MovingTimes::casters},
    {"growth_ms", &MovingTimes::growth},     {"loaded_ms", &MovingTimes::loaded},
    {"recorded_ms", &MovingTimes::recorded}, {"waited_ms", &MovingTimes::waited},
    {"gpu_ms", &MovingTimes::gpu},           {"latency_ms", &MovingTimes::latency}};

// Of all frames that count, one after the other.
double frames_a_second(const MovingTimes& times) {
    const double all_s = std::accumulate(times.frame.begin(), times.frame.end(), 0.0);
    return all_s > 0.0 ? static_cast<double>(times.frame.size()) / all_s : 0.0;
}

struct MovingRow {
    std::string mesh, pipeline, style;
    MovingTimes times;
};

ordered_json json_of(const MovingRow& row) {
    ordered_json json = ordered_json::object();
    json["mesh"] = row.mesh;
    json["pipeline"] = row.pipeline;
    json["style"] = row.style;
    json["frames"] = row.times.frames;
    json["frames_not_whole"] = row.times.not_whole;
    json["frames_a_second"] = frames_a_second(row.times);
    json["triangles"] = row.times.triangles / static_cast<double>(std::max<std::size_t>(1, row.times.frames));
    for (const MovingColumn& column : columns) {
        const Percentiles all = percentiles_of(row.times.*column.values);
        ordered_json one = ordered_json::object();
        one["median"] = all.median;
        one["at_95_percent"] = all.at_95;
        one["at_99_percent"] = all.at_99;
        one["worst"] = all.worst;
        json[column.key] = std::move(one);
    }
    return json;
}

void print_header() {
    std::printf(
        "Milliseconds; of four numbers: median, 95 %%, 99 %% and worst; of three without the worst; else the "
        "median.\n"
        "A frame is planned while the GPU draws the one before. Whole frame: from one frame's begin to the "
        "next's;\nprocessor = planned + loaded + recorded, planned = pages + clusters + casters + growth; "
        "latency: from a\nframe's camera to its picture.\n\n"
        "| drawn by | style | whole frame | frames a second | processor | planned | pages | clusters | "
        "casters | growth | loaded | "
        "recorded | "
        "waited "
        "| GPU | latency | frames not whole |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void print_row(const MovingRow& row) {
    std::printf("| %s, %s | %s |", row.mesh == "grid" ? "blocks" : "clusters", row.pipeline.c_str(),
                row.style.c_str());
    for (const MovingColumn& column : columns) {
        const Percentiles all = percentiles_of(row.times.*column.values);
        const std::string key = column.key;
        if (key == "frame_ms")
            std::printf(" %.2f / %.2f / %.2f / %.2f | %.0f |", all.median, all.at_95, all.at_99, all.worst,
                        frames_a_second(row.times));
        else if (key == "processor_ms" || key == "planned_ms" || key == "gpu_ms" || key == "latency_ms")
            std::printf(" %.2f / %.2f / %.2f |", all.median, all.at_95, all.at_99);
        else
            std::printf(" %.3f |", all.median);
    }
    std::printf(" %.1f %% |\n", 100.0 * static_cast<double>(row.times.not_whole) /
                                    static_cast<double>(std::max<std::size_t>(1, row.times.frames)));
    std::fflush(stdout);
}

struct NamedStyle {
    std::string name;
    gpu::FrameStyle style;
};

// All flights by one way of drawing, in a scene of its own.
Result<MovingRow> fly_all(const Gpu& gpu, RasterPath path, const std::vector<RandomFlight>& flights,
                          const NamedStyle& style, BenchOptions options) {
    options.style = style.style;
    ORO_TRY(BenchRegion region, open_bench_region(options));
    ORO_TRY(Scene scene, scene_of(gpu, options, region));
    scene.require_fields(options.style);
    ORO_TRY(FrameRenderer renderer, renderer_for(gpu, path, options));
    MovingRow row{options.mesh, name_of(path), style.name, {}};
    MovingEye eye(scene, renderer, options, row.times);
    for (const RandomFlight& flight : flights) ORO_CHECK(eye.fly(flight));
    return row;
}

// Seconds of the processor that this thread has taken.
double thread_s() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// All plans of all flights.
struct Fingerprint {
    std::string sum;              // a checksum
    std::vector<double> plans_s;  // processor time of plans of the same eyes, once all is here
};
constexpr int timed_turns = 5;

// Nothing is drawn.
Result<Fingerprint> fingerprint_of(const Gpu& gpu, const std::vector<RandomFlight>& flights,
                                   const NamedStyle& style, BenchOptions options) {
    options.style = style.style;
    ORO_TRY(BenchRegion region, open_bench_region(options));
    ORO_TRY(Scene scene, scene_of(gpu, options, region));
    scene.require_fields(options.style);
    RunningChecksum sum;
    Fingerprint all;
    for (const RandomFlight& flight : flights) {
        for (const Camera& camera : flight.cameras) {
            ORO_TRY(FramePlan plan, plan_of_all(scene, camera, options));
            add_plan(std::move(plan.grids.front()), sum);
        }
        for (int turn = 0; turn < timed_turns; ++turn)
            for (const Camera& camera : flight.cameras) {
                const double start_s = thread_s();
                ORO_CHECK(scene.plan({camera, MovingEye::whole_picture(camera), options.tau_px}));
                all.plans_s.push_back(thread_s() - start_s);
            }
    }
    char text[32];
    std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(sum.sum()));
    all.sum = text;
    return all;
}

std::vector<NamedStyle> styles_of(const BenchOptions& options) {
    std::vector<NamedStyle> styles{{"plain", bench_style()}};
    if (!options.style_file.empty()) {
        std::string name = options.style_file.substr(options.style_file.find_last_of('/') + 1);
        styles.push_back({name.substr(0, name.find('.')), options.style});
    }
    return styles;
}

Result<std::vector<RandomFlight>> flights_of(const BenchOptions& options) {
    ORO_TRY(const BenchRegion region, open_bench_region(options));
    return random_flights(*region.pages, options.moving, options.frames, options.seed, options.width_px,
                          options.height_px);
}

std::vector<std::string> meshes_of(const BenchOptions& options) {
    if (options.mesh == "both") return {"grid", "clusters"};
    return {options.mesh};
}

Result<void> print_fingerprints(const Gpu& gpu, const std::vector<RandomFlight>& flights,
                                BenchOptions options) {
    for (const std::string& mesh : meshes_of(options))
        for (const NamedStyle& style : styles_of(options)) {
            options.mesh = mesh;
            ORO_TRY(Fingerprint all, fingerprint_of(gpu, flights, style, options));
            const Percentiles times = percentiles_of(std::move(all.plans_s));
            std::printf("%s %s %s: %d flights of %d plans, seed %llu; %.3f / %.3f / %.3f ms a plan\n",
                        all.sum.c_str(), mesh.c_str(), style.name.c_str(), options.moving, options.frames,
                        static_cast<unsigned long long>(options.seed), times.median, times.at_95,
                        times.at_99);
        }
    return {};
}

}  // namespace

Result<void> run_moving(const Gpu& gpu, BenchOptions options) {
    if (options.region.empty())
        return Error{ErrorKind::usage, "--moving", "needs a region file (orograph bake makes one)"};
    ORO_TRY(const std::vector<RasterPath> paths, raster_paths_of(options, gpu.report()));
    ORO_TRY(const std::vector<RandomFlight> flights, flights_of(options));
    for (const RasterPath path : paths)
        if (options.compare_plans) ORO_CHECK(compare_plans(gpu, path, flights, options));
    if (options.compare_plans) return {};
    if (options.fingerprint) return print_fingerprints(gpu, flights, options);
    ordered_json json = ordered_json::object();
    json["device"] = gpu.report().name;
    json["driver"] = gpu.report().driver;
    json["region"] = options.region;
    json["size_px"] = json_list(options.width_px, options.height_px);
    json["tau_px"] = options.tau_px;
    json["flights"] = options.moving;
    json["plan"] = options.choose_on_device ? "pages" : options.plan_on_device ? "gpu" : "cpu";
    json["frames_a_flight"] = options.frames;
    json["seed"] = options.seed;
    json["rows"] = ordered_json::array();
    if (!options.json) {
        std::printf("%s (%s), %s, %d x %d px, tau %g px; %d flights of %d frames, seed %llu\n",
                    gpu.report().name.c_str(), gpu.report().driver.c_str(), options.region.c_str(),
                    options.width_px, options.height_px, options.tau_px, options.moving, options.frames,
                    static_cast<unsigned long long>(options.seed));
        print_header();
    }
    for (const std::string& mesh : meshes_of(options))
        for (const RasterPath path : paths)
            for (const NamedStyle& style : styles_of(options)) {
                options.mesh = mesh;
                ORO_TRY(const MovingRow row, fly_all(gpu, path, flights, style, options));
                json["rows"].push_back(json_of(row));
                if (!options.json) print_row(row);
            }
    if (options.json) std::printf("%s\n", json.dump().c_str());
    return {};
}

}  // namespace oro

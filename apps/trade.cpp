// orograph trade: what accuracy costs, measured: views drawn with all settings, timed, and held against the
// oracle.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <thread>

#include "apps/accuracy.h"
#include "apps/commands.h"
#include "apps/json_text.h"
#include "apps/pipeline_choice.h"
#include "apps/progress_bar.h"
#include "apps/region_scene.h"
#include "apps/style.h"
#include "apps/trade_report.h"
#include "apps/trade_settings.h"
#include "apps/verification.h"
#include "core/parallel.h"
#include "core/view_set.h"
#include "geo/png_bytes.h"
#include "geo/whole_file.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t view_seed = 1;

std::string machine_name() {
    std::ifstream info("/proc/cpuinfo");
    std::string line, name = "unknown processor";
    while (std::getline(info, line)) {
        if (line.rfind("model name", 0) != 0) continue;
        name = line.substr(std::min(line.size(), line.find(':') + 2));
        break;
    }
    return name + ", " + std::to_string(std::thread::hardware_concurrency()) + " processors";
}

// "2.3 km over 46.21,8.33, heading 120, pitch -30, 45 degrees wide"
std::string view_name(const Camera& camera, double ground_h_m) {
    const double above_m = camera.eye.h_m - ground_h_m;
    char text[160];
    std::snprintf(text, sizeof text, "%.*f %s over %.3f,%.3f towards %.0f, pitch %.0f, %.0f degrees high",
                  above_m < 10.0 || (above_m >= 1000.0 && above_m < 10000.0) ? 1 : 0,
                  above_m < 1000.0 ? above_m : above_m / 1000.0, above_m < 1000.0 ? "m" : "km",
                  camera.eye.lat_deg, camera.eye.lon_deg, camera.attitude.heading_deg,
                  camera.attitude.pitch_deg, camera.vertical_fov_deg);
    return text;
}

double median_ms(std::vector<double> seconds) {
    const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
    std::nth_element(seconds.begin(), middle, seconds.end());
    return 1000.0 * *middle;
}

std::string remark_on(double predicted_px, double measured_px) {
    if (measured_px > predicted_px) return "THE BOUND DOES NOT HOLD";
    if (predicted_px > 10.0 * measured_px) return "bound more than 10 times what was measured";
    return "";
}

// All that stays the same while views and settings change.
class Trade {
  public:
    Trade(const TradeOptions& options, const View& view, const Region& region, const Gpu& gpu,
          RasterPath path, const gpu::FrameStyle& style)
        : options_(options), view_(view), region_(region), gpu_(gpu), style_(style), painter_(gpu, path) {}

    Result<void> prepare();
    [[nodiscard]] const TrueSurface& surface() const { return truth_->surface(); }
    // camera: the true eye. `pictures`: put pictures of it into the report.
    Result<void> measure(const Camera& camera, const std::string& name, bool pictures, TradeReport& report);

  private:
    [[nodiscard]] Camera camera_of(const Camera& camera, const TradeCase& one) const;
    Result<Scene*> scene_of(const TradeCase& one);
    Result<TradeShot> shoot(const TradeCase& one, const Camera& camera, const Sight& sight,
                            Verification& drawn);
    Result<TradeEffect> predicted(const TradeCase& one, const EffectPrediction& prediction) const;

    const TradeOptions& options_;
    const View& view_;
    const Region& region_;
    const Gpu& gpu_;
    const gpu::FrameStyle& style_;
    DepthPainter painter_;
    std::vector<TradeCase> cases_{trade_cases()};
    std::optional<Region> without_geoid_;
    std::unique_ptr<TrueScene> truth_;
    std::unique_ptr<RegionPages> pages_;  // for predictions
    TrueWorld world_;
    std::map<std::pair<bool, HeightStorage>, Scene> scenes_;
};

Result<void> Trade::prepare() {
    ORO_TRY(truth_, TrueScene::of(view_, region_));
    ORO_TRY(pages_, region_pages(region_, view_.exaggeration));
    ORO_TRY(world_, true_world(view_, region_, *pages_));
    return {};
}

Camera Trade::camera_of(const Camera& camera, const TradeCase& one) const {
    Camera from = camera;
    if (!one.has_geoid) from.eye.h_m -= region_.field.undulation.at_m(from.eye.lat_deg, from.eye.lon_deg);
    return from;
}

Result<Scene*> Trade::scene_of(const TradeCase& one) {
    const std::pair key(one.has_geoid, one.heights);
    if (const auto found = scenes_.find(key); found != scenes_.end()) return &found->second;
    if (!one.has_geoid && !without_geoid_) {
        without_geoid_ = region_;
        leave_geoid_out(*without_geoid_);
    }
    const Region& region = one.has_geoid ? region_ : *without_geoid_;
    ORO_TRY(std::unique_ptr<RegionPages> pages, region_pages(region, view_.exaggeration));
    ORO_TRY(Scene scene, create_scene(gpu_, std::move(pages), options_.memory, one.heights));
    return &scenes_.emplace(key, std::move(scene)).first->second;
}

Result<TradeShot> Trade::shoot(const TradeCase& one, const Camera& camera, const Sight& sight,
                               Verification& drawn) {
    ORO_TRY(Scene* const scene, scene_of(one));
    const Camera from = camera_of(camera, one);
    DepthPictureOptions drawing;
    drawing.tau_px = one.tau_px;
    drawing.model = one.world;
    ORO_TRY(drawn.picture, painter_.draw(*scene, from, style_, drawing));
    if (!gpu_.validation_messages().empty())
        return Error{ErrorKind::failed, "Vulkan validation", gpu_.validation_messages().front()};
    if (!drawn.picture.settled)
        return Error{ErrorKind::failed, "--gpu-memory",
                     "the GPU cannot hold the terrain of a view at full detail"};
    std::vector<double> times_s{drawn.picture.report.gpu_s()};
    drawing.skyline = false;
    for (int i = 1; i < options_.repeats; ++i) {
        ORO_TRY(const DepthPicture again, painter_.draw(*scene, from, style_, drawing));
        times_s.push_back(again.report.gpu_s());
    }
    drawn.interior = interior_error(surface(), sight, camera, drawn.picture.centres(), thread_count());
    drawn.skyline = skyline_error(drawn.true_skyline, camera, drawn.picture.skylines());
    TradeShot shot;
    shot.setting = one.name;
    shot.gpu_ms = median_ms(std::move(times_s));
    shot.triangles = drawn.picture.report.counts.triangles_drawn;
    shot.bytes = drawn.picture.page_bytes;
    shot.interior_m = drawn.interior.summary_m;
    shot.interior_px = drawn.interior.summary_px;
    shot.skyline_px = drawn.skyline.summary_px;
    shot.skyline_in_one_only = drawn.skyline.in_one_only;
    return shot;
}

Result<TradeEffect> Trade::predicted(const TradeCase& one, const EffectPrediction& prediction) const {
    DrawingModel drawing{one.world, one.has_geoid, {}, one.tau_px};
    if (one.heights == HeightStorage::i16) drawing.coding = world_.sixteen;
    ORO_TRY(const EffectSize size, prediction.total(drawing));
    TradeEffect effect;
    effect.effect = one.effect;
    effect.predicted_m = size.worst_m;
    effect.predicted_px = size.worst_px;
    return effect;
}

// Effects that no drawing shows.
Result<void> add_data_effects(const EffectPrediction& prediction, const std::string& view,
                              TradeReport& report) {
    // What every second post would hide: predicted from every second post, and as it is.
    const EffectSize guess = prediction.interpolation(2), known = prediction.interpolation(1);
    report.effects.push_back({view, name_of(EffectKind::interpolation), guess.worst_m, guess.worst_px,
                              known.worst_m, known.worst_px, "tried on every second post"});
    ORO_TRY(const std::optional<EffectSize> source, prediction.size(EffectKind::source, 0.0));
    if (source)
        report.effects.push_back({view, name_of(EffectKind::source), source->worst_m, source->worst_px,
                                  std::nullopt, std::nullopt, "stated by the source, not measured here"});
    return {};
}

Result<void> add_pictures(const Verification& drawn, const TradeCase& one, const std::string& view,
                          TradeReport& report) {
    const DepthPicture& picture = drawn.picture;
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
        rgb.insert(rgb.end(), {picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]});
    ORO_TRY(std::vector<std::uint8_t> png, png_bytes(rgb, picture.width_px, picture.height_px));
    report.pictures.push_back({view + ": " + one.name, one.options, std::move(png)});
    ORO_TRY(std::vector<std::uint8_t> errors, error_picture_png(drawn, one.tau_px));
    report.pictures.push_back(
        {view + ": errors of " + one.name, "against the oracle, at each pixel", std::move(errors)});
    return {};
}

Result<void> Trade::measure(const Camera& camera, const std::string& name, bool pictures,
                            TradeReport& report) {
    const Sight sight = sight_from(camera.eye, world_.refraction_k);
    const EffectPrediction prediction(surface(), *pages_, camera, world_, thread_count());
    Verification drawn;
    drawn.true_skyline = true_skyline(surface(), sight, camera, thread_count());
    for (const TradeCase& one : cases_) {
        ORO_TRY(TradeShot shot, shoot(one, camera, sight, drawn));
        shot.view = name;
        report.shots.push_back(shot);
        if (pictures && (one.name == "balanced" || one.name == "draft"))
            ORO_CHECK(add_pictures(drawn, one, name, report));
        if (one.effect.empty()) continue;
        ORO_TRY(TradeEffect effect, predicted(one, prediction));
        effect.view = name;
        effect.measured_m = shot.interior_m.largest;
        effect.measured_px = shot.interior_px.largest;
        effect.remark = remark_on(effect.predicted_px, shot.interior_px.largest);
        report.effects.push_back(effect);
    }
    return add_data_effects(prediction, name, report);
}

// One that sees all of the region and those of the set; or the one that was asked for.
std::vector<Camera> cameras_of(const TradeOptions& options, const View& view, const Region& region,
                               const TrueSurface& surface) {
    std::vector<Camera> cameras{true_camera(view, region)};
    if (options.view.at || !options.view_file.empty()) return cameras;
    const std::vector<Camera> made = made_cameras(view_seed, surface.field(), options.views - 1,
                                                  view.camera.width_px, view.camera.height_px);
    cameras.insert(cameras.end(), made.begin(), made.end());
    return cameras;
}

Result<void> write_text(const std::string& path, const std::string& text, bool overwrite) {
    ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
    ORO_CHECK(file.write(text.data(), text.size()));
    return file.commit();
}

void describe(const TradeOptions& options, const View& view, const Gpu& gpu, RasterPath path,
              TradeReport& report) {
    for (const std::string& source : view.region.paths)
        report.region += (report.region.empty() ? "" : ", ") + fs::path(source).filename().string();
    report.command = options.command;
    report.machine = machine_name();
    report.gpu = gpu.report().name;
    report.driver = gpu.report().driver;
    report.pipeline = name_of(path);
    report.version = "orograph " OROGRAPH_VERSION;
    report.time = time_text(view.time_utc_s);
    report.width_px = view.camera.width_px;
    report.height_px = view.camera.height_px;
    for (const TradeCase& one : trade_cases()) {
        TradeSetting setting;
        setting.name = one.name;
        setting.options = one.options;
        setting.promised_px = one.promised_px;
        report.settings.push_back(setting);
    }
}

Result<void> check_options(const TradeOptions& options, const std::string& csv, const std::string& html) {
    const ViewOptions& view = options.view;
    if (view.tau_px || view.earth || view.refraction_k || view.precision || view.geoid || view.heights ||
        view.accuracy || view.tolerance)
        return Error{
            ErrorKind::usage, "trade",
            "tries all settings itself: leave --tau, --earth, --refraction, --precision, --geoid, --heights, "
            "--accuracy and --tolerance out"};
    std::error_code ignored;
    if (!fs::is_directory(options.out, ignored)) return Error{ErrorKind::failed, options.out, "is no folder"};
    for (const std::string& file : {csv, html}) {
        if (const auto trial = WholeFile::create(file, options.overwrite); !trial.ok()) return trial.error();
    }
    return {};
}

Result<void> write_report(const TradeReport& report, const std::string& csv, const std::string& html,
                          bool overwrite) {
    ORO_CHECK(write_text(csv, trade_csv(report), overwrite));
    return write_text(html, trade_html(report), overwrite);
}

}  // namespace

Result<void> run_trade(const TradeOptions& options) {
    const std::string csv = (fs::path(options.out) / "trade.csv").string();
    const std::string html = (fs::path(options.out) / "trade.html").string();
    ORO_CHECK(check_options(options, csv, html));
    ViewOptions view_options = options.view;
    if (!view_options.size && options.view_file.empty()) view_options.size = "640x360";
    ProgressBar bar(options.quiet);
    View view;
    Region region;
    ORO_CHECK(open_view(
        options.view_file, view_options, options.region,
        [&](double share, const std::string& what) { bar.show(share, "reading " + what); }, view, region));
    if (!view.has_geoid)
        return Error{ErrorKind::usage, "--view", "is drawn without a geoid: a trade begins with it"};
    ORO_TRY(const Style style, load_style(view.style, view.sun));
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    ORO_TRY(const RasterPath path, choose_path(view.pipeline, *gpu));
    Trade trade(options, view, region, *gpu, path, style.frame);
    ORO_CHECK(trade.prepare());
    const std::vector<Camera> cameras = cameras_of(options, view, region, trade.surface());
    TradeReport report;
    describe(options, view, *gpu, path, report);
    constexpr std::size_t with_pictures = 3;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        bar.show(static_cast<double>(i) / static_cast<double>(cameras.size()), "measuring views");
        const Geodetic& eye = cameras[i].eye;
        const double ground_m = trade.surface().h_m(eye.lat_deg, eye.lon_deg).value_or(0.0);
        ORO_CHECK(trade.measure(cameras[i], view_name(cameras[i], ground_m), i < with_pictures, report));
    }
    sum_up(report);
    ORO_CHECK(write_report(report, csv, html, options.overwrite));
    bar.clear();
    std::fputs(trade_text(report).c_str(), stdout);
    std::fflush(stdout);
    say(options.quiet, "wrote " + csv + " and " + html);
    return {};
}

}  // namespace oro

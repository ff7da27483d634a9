// orograph trade: what accuracy costs, measured: views drawn with all settings, timed, and held against the
// oracle.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/drawing/kept_drawing.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/drawing/region_scene.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/trade/trade_measurement.h"
#include "apps/trade/trade_report.h"
#include "apps/trade/trade_settings.h"
#include "apps/view/accuracy.h"
#include "apps/view/style.h"
#include "apps/view/view_changes.h"
#include "apps/view/view_option_table.h"
#include "core/truth/view_set.h"
#include "geo/files/whole_file.h"

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

// "2.3 km over 46.21,8.33, heading 120, pitch -30, 45 degrees high"
std::string view_name(const Camera& camera, double ground_h_m) {
    const double above_m = camera.eye.h_m - ground_h_m;
    char text[160];
    std::snprintf(text, sizeof text, "%.*f %s over %.3f,%.3f, heading %.0f, pitch %.0f, %.0f degrees high",
                  above_m < 10.0 || (above_m >= 1000.0 && above_m < 10000.0) ? 1 : 0,
                  above_m < 1000.0 ? above_m : above_m / 1000.0, above_m < 1000.0 ? "m" : "km",
                  camera.eye.lat_deg, camera.eye.lon_deg, camera.attitude.heading_deg,
                  camera.attitude.pitch_deg, camera.vertical_fov_deg);
    return text;
}

// One that sees all of the region and those of the set; or the one that was asked for.
std::vector<Camera> cameras_of(const TradeOptions& options, const View& view, const Region& region,
                               const TrueGround& ground) {
    std::vector<Camera> cameras{true_camera(view, region)};
    if (options.view.at || !options.view_file.empty()) return cameras;
    const std::vector<Camera> made =
        made_cameras(view_seed, ground, options.views - 1, view.camera.width_px, view.camera.height_px);
    cameras.insert(cameras.end(), made.begin(), made.end());
    return cameras;
}

void describe(const TradeOptions& options, const View& view, const Region& region, const Gpu& gpu,
              RasterPath path, TradeReport& report) {
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
    for (const TradeCase& one : trade_cases(view, region)) {
        TradeSetting setting;
        setting.key = one.key;
        setting.options = one.options;
        report.settings.push_back(setting);
    }
}

// A trade draws with all of them.
Result<void> leave_settings_out(const ViewOptions& view) {
    if (const char* const option =
            first_given_of(view_option_table(), view,
                           {"--tau", "--earth", "--refraction", "--air", "--precision", "--geoid",
                            "--heights", "--accuracy", "--tolerance", "--mesh", "--mesh-level", "--detail"}))
        return refused(option, "", "trade chooses this itself: leave it out");
    return {};
}

Result<void> check_options(const TradeOptions& options, const std::string& csv, const std::string& html) {
    ORO_CHECK(leave_settings_out(options.view));
    std::error_code ignored;
    if (!fs::exists(options.out, ignored)) {
        std::error_code failed;
        fs::create_directory(options.out, failed);
        if (failed)
            return Error{ErrorKind::failed, options.out,
                         "is no folder, nor can be made: " + failed.message()};
    }
    if (!fs::is_directory(options.out, ignored)) return Error{ErrorKind::failed, options.out, "is no folder"};
    ORO_CHECK(check_may_write(csv, options.overwrite));
    return check_may_write(html, options.overwrite);
}

// They belong together: both, or neither.
Result<void> write_report(const TradeReport& report, const std::string& csv, const std::string& html,
                          bool overwrite) {
    ORO_TRY(WholeFile table, WholeFile::create(csv, overwrite));
    ORO_TRY(WholeFile page, WholeFile::create(html, overwrite));
    const std::string lines = trade_csv(report), text = trade_html(report);
    ORO_CHECK(table.write(lines.data(), lines.size()));
    ORO_CHECK(page.write(text.data(), text.size()));
    return commit_together({&table, &page});
}

// Takes a folder that was made away again where nothing has come into it.
class MadeFolder {
  public:
    explicit MadeFolder(fs::path folder) : folder_(std::move(folder)) {
        std::error_code ignored;
        was_there_ = fs::exists(folder_, ignored);
    }
    MadeFolder(const MadeFolder&) = delete;
    MadeFolder& operator=(const MadeFolder&) = delete;
    ~MadeFolder() {
        std::error_code not_empty;
        if (!was_there_ && fs::is_directory(folder_, not_empty)) fs::remove(folder_, not_empty);
    }

  private:
    fs::path folder_;
    bool was_there_{};
};

Result<void> spare_inputs_of(const TradeOptions& options, const std::vector<std::string>& written,
                             const View& view, const Region& region) {
    std::vector<FilesToSpare> inputs{files_of_picture(view, region)};
    if (!options.view_file.empty()) inputs.push_back(files_of_view(options.view_file));
    return spare_inputs(written, inputs);
}

}  // namespace

Result<void> run_trade(const TradeOptions& options) {
    const MadeFolder made(options.out);
    const std::string csv = (fs::path(options.out) / "trade.csv").string();
    const std::string html = (fs::path(options.out) / "trade.html").string();
    ORO_CHECK(check_options(options, csv, html));
    ViewOptions view_options = options.view;
    if (!view_options.size && options.view_file.empty()) view_options.size = "640x360";
    ProgressBar bar(options.quiet);
    View view;
    Region region;
    ORO_CHECK(open_view(options.view_file, view_options, options.region, bar.progress(), view, region));
    say_changes(view, options.quiet);
    say_notes(region, options.quiet);
    say_summit(view.stood.summit, options.quiet);
    ORO_CHECK(spare_inputs_of(options, {csv, html}, view, region));
    if (!view.has_geoid)
        return refused("--view", options.view_file,
                       "was drawn with --geoid none; trade needs one that was not");
    ORO_TRY(const Style style, load_style(view, region.grids.front().field));
    ORO_TRY(const std::shared_ptr<const Gpu> gpu, gpu_to_draw_with());
    ORO_TRY(const RasterPath path, choose_path(view.pipeline, *gpu));
    Trade trade(view, region, *gpu, path, style.frame, options.repeats, options.memory);
    ORO_CHECK(trade.prepare());
    if (const std::string note = note_of_missing_footprints(style.frame, trade.pages()); !note.empty())
        say(options.quiet, note);
    const std::vector<Camera> cameras = cameras_of(options, view, region, trade.ground());
    TradeReport report;
    describe(options, view, region, *gpu, path, report);
    constexpr std::size_t with_pictures = 3;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        bar.show(static_cast<double>(i) / static_cast<double>(cameras.size()), "measuring views");
        const Geodetic& eye = cameras[i].eye;
        const double ground_m = trade.ground().h_m(eye.lat_deg, eye.lon_deg).value_or(0.0);
        ORO_CHECK(trade.measure(cameras[i], view_name(cameras[i], ground_m), i < with_pictures, report));
    }
    sum_up(report);
    ORO_CHECK(write_report(report, csv, html, options.overwrite));
    bar.clear();
    std::fputs(trade_text(report).c_str(), stdout);
    if (view.own_posts)
        std::fputs(
            "left out: --earth and --precision, which posts in a CRS of their own are not drawn with "
            "(--resample)\n",
            stdout);
    std::fflush(stdout);
    say(options.quiet, "wrote " + csv + " and " + html);
    return {};
}

}  // namespace oro

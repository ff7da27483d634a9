#include "apps/commands/sight/viewshed_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/eye/standpoint.h"
#include "apps/report/figures.h"
#include "apps/view/model_names.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"

namespace oro {
namespace {

// Of a window: at 40 bytes each they take 8 GB.
constexpr double most_posts = 2.0e8;

// A window moved by whole turns so that its columns are nearest to those of another.
GridPart turned_near(GridPart window, const GridPart& other, const PostGrid& grid) {
    if (!grid.wraps_longitude() || window.columns == 0) return window;
    const int turn = grid.columns() - 1;
    while (window.first_column - other.first_column > turn / 2) window.first_column -= turn;
    while (other.first_column - window.first_column > turn / 2) window.first_column += turn;
    return window;
}

GridPart around_both(const GridPart& one, const GridPart& other) {
    if (one.rows == 0 || one.columns == 0) return other;
    if (other.rows == 0 || other.columns == 0) return one;
    GridPart both;
    both.first_row = std::min(one.first_row, other.first_row);
    both.first_column = std::min(one.first_column, other.first_column);
    both.rows = std::max(one.first_row + one.rows, other.first_row + other.rows) - both.first_row;
    both.columns =
        std::max(one.first_column + one.columns, other.first_column + other.columns) - both.first_column;
    return both;
}

Result<void> make_window(const RegionGround& ground, ViewshedReport& report) {
    const ViewshedQuestion& question = report.question;
    const auto most = grid_of_most(ground.ground(), question.eyes, question.radius_km * 1000.0);
    report.grid = most.value_or(0);
    const PostGrid& grid = ground.grid(report.grid).field.grid;
    for (const Geodetic& eye : question.eyes)
        report.window = around_both(
            report.window,
            turned_near(window_around(grid, eye, question.radius_km * 1000.0), report.window, grid));
    const double posts = static_cast<double>(report.window.rows) * report.window.columns;
    if (posts > most_posts)
        return refused("--radius", all_digits(question.radius_km),
                       "takes " + grouped(static_cast<std::uint64_t>(posts)) +
                           " posts, more than 200,000,000: give a smaller one");
    if (posts == 0)
        return Error{ErrorKind::no_data, "--at " + question.at,
                     "no elevation data within the radius" +
                         where_data_are(grid, question.eyes.front().lat_deg, question.eyes.front().lon_deg)};
    return {};
}

void take_in(const Viewshed& shed, const PostGrid& grid, const ViewshedValues& values,
             ViewshedReport& report) {
    ViewshedReport::SeenByEye& eye = report.each.emplace_back();
    const GridPart window = turned_near(shed.window, report.window, grid);
    for (int row = window.first_row; row < window.first_row + window.rows; ++row) {
        for (int column = window.first_column; column < window.first_column + window.columns; ++column) {
            const float missed_m = shed.clearance_deficit_m[window.number(row, column)];
            if (missed_m == Viewshed::unknown) continue;
            const std::size_t cell = report.window.number(row, column);
            float& least_m = values.clearance_deficit_m[cell];
            if (values.count[cell] == Viewshed::unknown) {
                values.count[cell] = 0.0F;
                least_m = missed_m;
            }
            values.count[cell] += missed_m == 0.0F ? 1.0F : 0.0F;
            ++eye.cells;
            eye.seen += missed_m == 0.0F;
            least_m = std::min(least_m, missed_m);
        }
    }
    report.asked += shed.asked;
}

}  // namespace

Result<ViewshedReport> viewshed_window(const ViewshedQuestion& question, const RegionGround& ground) {
    ViewshedReport report;
    report.question = question;
    ORO_CHECK(make_window(ground, report));
    return report;
}

Result<void> look_around(const RegionGround& ground, const ViewshedValues& values, ViewshedReport& report,
                         const ViewshedProgress& progress, const std::stop_token& stop) {
    const ViewshedQuestion& question = report.question;
    std::ranges::fill(values.clearance_deficit_m, Viewshed::unknown);
    std::ranges::fill(values.count, Viewshed::unknown);
    report.each.clear();
    const PostGrid& grid = ground.grid(report.grid).field.grid;
    const auto looking = Clock::now();
    for (std::size_t i = 0; i < question.eyes.size(); ++i) {
        ViewshedRequest request{
            question.eyes[i], question.air, question.target_m, question.radius_km * 1000.0,
            thread_count(),   stop,         question.footing};
        if (question.roofs != nullptr)
            request.top_h_m = [&](double lat_deg, double lon_deg) -> std::optional<double> {
                const auto top = question.roofs->at(lat_deg, lon_deg);
                return top ? std::optional(top->h_m) : std::nullopt;
            };
        const auto of_all = static_cast<double>(question.eyes.size());
        take_in(viewshed(ground.ground(), report.grid, request,
                         [&](double share) {
                             if (progress) progress((static_cast<double>(i) + share) / of_all);
                         }),
                grid, values, report);
        if (stop.stop_requested()) break;
    }
    report.looking_s = seconds_since(looking);
    ORO_CHECK(ground.ground().health());
    if (stop.stop_requested()) return Error{ErrorKind::failed, "", "stopped"};
    for (const float count : values.count) {
        report.cells += count != Viewshed::unknown;
        report.seen += count > 0.0F;
    }
    return {};
}

Result<ViewshedReport> viewshed_report(const ViewshedQuestion& question, const RegionGround& ground,
                                       const ViewshedProgress& progress, const std::stop_token& stop) {
    ORO_TRY(ViewshedReport report, viewshed_window(question, ground));
    report.clearance_deficit_m.resize(report.window.count());
    report.count.resize(report.window.count());
    ORO_CHECK(look_around(ground, {report.clearance_deficit_m, report.count}, report, progress, stop));
    return report;
}

std::string seen_words(const ViewshedReport& report) {
    const double share =
        static_cast<double>(report.seen) / static_cast<double>(std::max<std::size_t>(1, report.cells));
    char percent[40];
    std::snprintf(percent, sizeof percent, "%.2f %%", 100.0 * share);
    return "Seen: " + grouped(report.seen) + " of " + counted(report.cells, "post", "posts") + " within " +
           figure(report.question.radius_km) + " km, " + percent;
}

std::string eye_text(const Geodetic& eye, const TrueGround& ground) {
    char text[120];
    std::snprintf(text, sizeof text, "%.9f,%.9f H %.3f m h %.3f m", eye.lat_deg, eye.lon_deg,
                  eye.h_m - ground.N_m(eye.lat_deg, eye.lon_deg), eye.h_m);
    return text;
}

std::string source_of_posts(const ViewshedReport& report, const RegionGround& ground) {
    const RegionGrid& grid = ground.grid(report.grid);
    return grid.sources.empty() ? std::string("the first grid") : grid.sources.front().path;
}

PostRaster raster_of(ViewshedReport& report, const RegionGround& ground) {
    const ViewshedQuestion& question = report.question;
    PostRaster raster;
    const RegionGrid& grid = ground.grid(report.grid);
    raster.grid = grid.field.grid;
    raster.crs = grid.posts_crs;
    raster.part = report.window;
    raster.no_value = Viewshed::unknown;
    std::vector<float> seen(report.count.size(), Viewshed::unknown);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (report.count[i] == Viewshed::unknown) continue;
        seen[i] = report.count[i] > 0.0F ? 1.0F : 0.0F;
        // A target that no height brings into sight is missed by no number.
        if (std::isinf(report.clearance_deficit_m[i])) report.clearance_deficit_m[i] = Viewshed::unknown;
    }
    raster.bands.push_back({"seen (1) or hidden (0)", std::move(seen)});
    raster.bands.push_back({"missed by, metres of height (0: seen)", std::move(report.clearance_deficit_m)});
    if (question.eyes.size() > 1) raster.bands.push_back({"observers that see it", std::move(report.count)});
    if (!question.are_recorded_one_by_one)
        raster.tags.emplace_back("OBSERVERS", std::to_string(question.eyes.size()));
    for (std::size_t i = 0; question.are_recorded_one_by_one && i < question.eyes.size(); ++i)
        raster.tags.emplace_back("OBSERVER_" + std::to_string(i + 1),
                                 eye_text(question.eyes[i], ground.ground()));
    raster.tags.emplace_back("TARGET_ABOVE_GROUND_M", all_digits(question.target_m));
    raster.tags.emplace_back("RADIUS_KM", all_digits(question.radius_km));
    raster.tags.emplace_back("LIGHT", light_words(question.air, question.eyes.front().h_m));
    raster.tags.emplace_back("SOFTWARE", "orograph " OROGRAPH_VERSION);
    return raster;
}

PostColours colours_of(const ViewshedReport& report, const RegionGround& ground) {
    const std::uint32_t seen = texel_of(255, 176, 32, 0.55), hidden = texel_of(16, 22, 44, 0.4);
    PostColours colours;
    colours.grid = ground.grid(report.grid).field.grid;
    colours.grid_number = report.grid;
    colours.part = report.window;
    colours.rgba.reserve(report.count.size());
    for (const float count : report.count)
        colours.rgba.push_back(count == Viewshed::unknown ? 0 : count > 0.0F ? seen : hidden);
    return colours;
}

}  // namespace oro

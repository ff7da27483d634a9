// orograph sun: first and last light at a place, over its own skyline and over a plain horizon.
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/sun_text.h"
#include "apps/eye/standpoint.h"
#include "apps/light/sun.h"
#include "apps/options/region_option_table.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/view/truth.h"
#include "apps/view/view.h"
#include "apps/view/view_option_table.h"
#include "core/base/parallel.h"
#include "core/light/sun_over_terrain.h"
#include "core/light/utc_time.h"
#include "core/terrain/ground.h"
#include "geo/places/place.h"

namespace oro {
namespace {

constexpr std::int64_t day_s = 86400;

// "+02:00" into seconds east of UTC.
Result<std::int64_t> parse_zone(const std::string& text) {
    const std::string midnight = "2000-01-01T00:00";
    const Result<std::int64_t> there = utc_time_from(midnight + text), utc = utc_time_from(midnight + "Z");
    if (!there.ok() || !utc.ok())
        return refused("--zone", text, "must be a distance from UTC like +02:00, -07:00 or Z");
    return *utc - *there;
}

// How far clocks there are ahead of UTC: by the zone, or by the mean sun.
std::int64_t ahead_of_utc_s(const SunOptions& options, double lon_deg, std::int64_t east_s) {
    return options.zone ? east_s : std::llround(lon_deg * day_s / 360.0);
}

// The first second of the day there.
Result<std::int64_t> day_begin(const SunOptions& options, std::int64_t ahead_s) {
    if (!options.date) {
        const std::int64_t there_s = time_now_s() + ahead_s;
        return there_s - (there_s % day_s + day_s) % day_s - ahead_s;
    }
    const Result<std::int64_t> midnight = utc_time_from(*options.date + "T00:00Z");
    if (!midnight.ok() || options.date->size() != 10)
        return refused("--date", *options.date, "must be a day of the calendar like 2026-06-21");
    return *midnight - ahead_s;
}

SunReport::Light light_of(const SunDayEvents& events, double from_utc_s, const Geodetic& place) {
    SunReport::Light light{events.day, up_s(events, from_utc_s), {}};
    for (const SunCrossing& crossing : events.crossings)
        light.crossings.push_back({std::llround(crossing.time_utc_s), crossing.rising,
                                   sun_position(crossing.time_utc_s, place).azimuth_deg});
    return light;
}

// The first night after a noon, over a plain horizon.
std::optional<SunReport::Night> night_after(double noon_utc_s, const Geodetic& place) {
    const SunDayEvents events = sun_day(noon_utc_s, place);
    for (std::size_t i = 0; i + 1 < events.crossings.size(); ++i) {
        const SunCrossing &from = events.crossings[i], &to = events.crossings[i + 1];
        if (!from.rising && to.rising)
            return SunReport::Night{std::llround(from.time_utc_s), std::llround(to.time_utc_s)};
    }
    return std::nullopt;
}

// How far the grid reaches from a place in a direction, in whole kilometres; along a sphere, which is within
// 1 % of it.
double data_reach_m(const PostGrid& grid, const Geodetic& place, double azimuth_deg) {
    constexpr double step_m = 1000.0, farthest_m = 1.0e6;
    const SineCosine lat = sine_cosine_deg(place.lat_deg), azimuth = sine_cosine_deg(azimuth_deg);
    double reach_m = 0.0;
    while (reach_m < farthest_m) {
        const double angle = (reach_m + step_m) / mean_radius_m;
        const double sine = lat.sine * std::cos(angle) + lat.cosine * std::sin(angle) * azimuth.cosine;
        const double east = azimuth.sine * std::sin(angle) * lat.cosine;
        const double lon_deg =
            place.lon_deg + deg_from_radians(Radians{std::atan2(east, std::cos(angle) - lat.sine * sine)});
        const auto [row, column] =
            grid.post_at(deg_from_radians(Radians{std::asin(sine)}), std::remainder(lon_deg, 360.0));
        if (!(row >= 0.0 && row <= grid.rows() - 1 && column >= 0.0 && column <= grid.columns() - 1)) break;
        reach_m += step_m;
    }
    return reach_m;
}

// Over the terrain; the eye is where the options put it.
Result<void> look_over_terrain(const SunOptions& options, SunReport& report) {
    ViewOptions view_options = options.view;
    view_options.stands_at_place = true;
    if (!view_options.refraction_k && !view_options.air) view_options.air = "standard";
    ProgressBar bar(options.quiet);
    View view;
    Region region;
    ORO_CHECK(open_view("", view_options, options.region, bar.progress(), view, region));
    ORO_TRY(const std::unique_ptr<TrueScene> truth, TrueScene::of(view, region));
    bar.show(1.0, "looking for the sun");
    const Geodetic& eye = view.camera.eye;
    const RegionGrid& around = widest_at(region, eye.lat_deg, eye.lon_deg);
    const double N_m = around.field.undulation.at_m(eye.lat_deg, eye.lon_deg);
    const SunOverTerrain sun(truth->ground(), eye, view.model.air, N_m);
    const auto from_utc_s = static_cast<double>(report.light_from_utc_s);
    report.terrain = light_of(sun_day(from_utc_s, sun, thread_count()), from_utc_s, eye);
    for (SunReport::Crossing& crossing : report.terrain->crossings)
        crossing.data_reach_m = data_reach_m(around.field.grid, eye, crossing.azimuth_deg);
    ORO_CHECK(region.health());
    bar.clear();
    say_notes(region, options.quiet);
    report.notes = all_notes(region);
    report.place = eye;
    report.moved = view.stood.summit;
    say_wall(view.stood.wall, options.quiet);
    report.H_m = eye.h_m - N_m;
    if (const auto ground = truth->ground().h_m(eye.lat_deg, eye.lon_deg))
        report.above_ground_m = eye.h_m - *ground;
    report.air = view.model.air;
    return {};
}

// What has no effect where there is no terrain.
Result<void> leave_terrain_out(const SunOptions& options) {
    const char* option = first_given_of(view_option_table(), options.view,
                                        {"--above", "--altitude", "--on-summit", "--refraction", "--air"});
    if (option == nullptr) option = first_given_of_region(options.region);
    if (option != nullptr) return refused(option, "", "says nothing without elevation data: name them, too");
    return {};
}

}  // namespace

Result<void> run_sun(const SunOptions& options) {
    if (!options.view.at) return refused("--at", "", "is missing: name the place, e.g. --at 46.67,8.06");
    const Result<Place> place = parse_place(*options.view.at);
    if (!place.ok()) return refused("--at", *options.view.at, place.error().what);
    SunReport report;
    report.place = {place->lat_deg, place->lon_deg, 0.0};
    if (options.zone) {
        ORO_TRY(report.east_s, parse_zone(*options.zone));
        report.zone = *options.zone;
    }
    const std::int64_t ahead_s = ahead_of_utc_s(options, place->lon_deg, report.east_s);
    ORO_TRY(report.from_utc_s, day_begin(options, ahead_s));
    constexpr std::size_t date_length = 10;
    report.date = time_text(report.from_utc_s + ahead_s).substr(0, date_length);
    if (const std::string note = note_of_year(report.from_utc_s); !note.empty()) say(options.quiet, note);
    // Over a plain horizon as almanacs have it: whatever the place's height.
    const Geodetic plain{place->lat_deg, place->lon_deg, 0.0};
    const double noon_utc_s = solar_noon_utc_s(static_cast<double>(report.from_utc_s), plain);
    report.noon_utc_s = std::llround(noon_utc_s);
    report.noon = sun_position(noon_utc_s, plain);
    report.light_from_utc_s = report.noon_utc_s - day_s / 2;
    if (options.region.paths.empty()) {
        ORO_CHECK(leave_terrain_out(options));
    } else {
        ORO_CHECK(look_over_terrain(options, report));
    }
    const auto from_utc_s = static_cast<double>(report.light_from_utc_s);
    report.plain = light_of(sun_day(from_utc_s, plain), from_utc_s, plain);
    report.night = night_after(static_cast<double>(report.noon_utc_s), plain);
    std::fputs(options.json ? (json_text(sun_json(report), true) + "\n").c_str() : sun_text(report).c_str(),
               stdout);
    return {};
}

}  // namespace oro

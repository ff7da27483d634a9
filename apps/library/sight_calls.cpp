// The calls of the library about what is seen from where: sight, profile, viewshed.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands/sight/profile_along.h"
#include "apps/commands/sight/sight_between.h"
#include "apps/commands/sight/viewshed_question.h"
#include "apps/library/guarded_call.h"
#include "apps/library/library_structures.h"
#include "apps/library/open_regions.h"
#include "apps/library/orograph.h"

namespace {

using oro::OpenRegion;
using oro::Result;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr oro_position nowhere{none, none, none, none};

oro_position position_of(const oro::SightGround& ground, const oro::Geodetic& point) {
    return {point.lat_deg, point.lon_deg, ground.H_m(point), point.h_m};
}

void fill_answer(const oro::SightReport& report, const oro::SightGround& ground, oro_sight_answer& answer) {
    answer.visible = report.obstacle ? 0 : 1;
    answer.from = position_of(ground, report.from);
    answer.to = position_of(ground, report.to);
    answer.obstacle = report.obstacle ? position_of(ground, report.obstacle->point) : nowhere;
    answer.obstacle_distance_m = report.obstacle ? report.obstacle_distance_m : none;
    answer.target_deficit_m = report.obstacle ? report.target_clearance_deficit_m.value_or(none) : 0.0;
    answer.eye_deficit_m = report.obstacle ? report.eye_clearance_deficit_m.value_or(none) : 0.0;
    const bool is_over_data = report.line.without_data_m < report.slant_m;
    answer.least_clearance_m = is_over_data ? report.line.clearance_m : none;
    answer.least_clearance = is_over_data ? position_of(ground, report.line.ground) : nowhere;
    answer.distance_m = report.path.distance_m;
    answer.azimuth_deg = report.path.bearing_deg;
    answer.elevation_deg = report.elevation_deg;
    answer.slant_m = report.slant_m;
    answer.without_data_m = report.line.without_data_m;
}

Result<void> answer_sight(oro_region region, const oro_point* from, const oro_point* to,
                          const oro_sight_options* given, oro_sight_answer* answer) {
    ORO_CHECK(oro::check_given("from", from));
    ORO_CHECK(oro::check_given("to", to));
    ORO_CHECK(oro::check_given("answer", answer));
    ORO_CHECK(oro::check_size("answer", answer->size, sizeof(oro_sight_answer)));
    ORO_TRY(const oro_sight_options options, oro::options_of<oro_sight_options>(given, ORO_SIGHT_OPTIONS));
    ORO_TRY(const auto open, oro::region_of(region));
    const oro::SightGround& ground = *open->ground;
    ORO_TRY(const oro::Air air, oro::air_of(options.air, options.refraction_k));
    ORO_TRY(const oro::Standing eye, oro::standing_at("from", *from, options.on_summit != 0));
    ORO_TRY(const oro::Standing target, oro::standing_at("to", *to, false));
    ORO_TRY(const oro::Standpoint stood, oro::stand_over_ground(eye, ground));
    ORO_TRY(const oro::Geodetic point, oro::point_over_ground(target, ground));
    const oro::SightReport report = oro::sight_between(stood.eye, point, air, ground);
    ORO_CHECK(ground.region.health());
    if (report.slant_m <= oro::least_above_m)
        return oro::bad_argument("to", "is where from is: there is no line between them");
    fill_answer(report, ground, *answer);
    return {};
}

struct AskedProfile {
    oro::ProfileOptions options;
    oro::Profile profile;  // its line alone
};

Result<AskedProfile> asked_profile(std::size_t places, const double* lat_deg, const double* lon_deg,
                                   const oro_profile_options* given) {
    ORO_TRY(const oro_profile_options options,
            oro::options_of<oro_profile_options>(given, ORO_PROFILE_OPTIONS));
    ORO_CHECK(oro::check_given("lat_deg", lat_deg));
    ORO_CHECK(oro::check_given("lon_deg", lon_deg));
    constexpr std::size_t most_places = 10'000'000;
    if (places < 2 || places > most_places)
        return oro::bad_argument("places",
                                 std::to_string(places) + " of them are not between 2 and 10,000,000");
    std::vector<oro::LatLon> line;
    for (std::size_t i = 0; i < places; ++i) {
        ORO_CHECK(oro::check_place("place", lat_deg[i], lon_deg[i], static_cast<std::ptrdiff_t>(i)));
        line.push_back({lat_deg[i], lon_deg[i]});
    }
    AskedProfile asked;
    if (options.step_m != 0.0) asked.options.step_m = options.step_m;
    asked.options.climb_threshold_m = options.climb_threshold_m;
    asked.options.along = "the places";
    ORO_CHECK(oro::check_steps(asked.options));
    ORO_TRY(asked.profile.line, oro::line_through("places", std::move(line)));
    ORO_CHECK(oro::check_length(asked.options, asked.profile.line));
    return asked;
}

void fill_sums(const oro::Profile& profile, oro_profile_sums& sums) {
    sums.length_m = profile.length_m();
    sums.ascent_m = profile.sums.ascent_m;
    sums.descent_m = profile.sums.descent_m;
    sums.ascent_over_m = profile.sums.climbed_m;
    sums.descent_over_m = profile.sums.went_down_m;
    sums.without_data_m = profile.sums.without_data_m;
    sums.highest = profile.sums.highest.value_or(0);
    sums.lowest = profile.sums.lowest.value_or(0);
}

Result<void> answer_profile(oro_region region, AskedProfile& asked, oro_profile_point* points,
                            std::size_t capacity, std::size_t* count, oro_profile_sums* sums,
                            const oro::Progress& progress) {
    ORO_TRY(const auto open, oro::region_of(region));
    oro::Profile& profile = asked.profile;
    const oro::ProfileProgress report = [&](double along_m) {
        if (progress) progress(along_m / profile.line.distances_m.back(), "following the line");
    };
    ORO_CHECK(oro::follow_line(asked.options, *open->ground, profile, report));
    ORO_CHECK(oro::check_has_ground(asked.options, *open->ground, profile));
    *count = profile.points.size();
    if (points != nullptr || capacity != 0) {
        ORO_CHECK(oro::check_given("points", points));
        if (capacity < profile.points.size())
            throw oro::TooSmall{"points: the profile has " + std::to_string(profile.points.size()) +
                                " of them, and there is room for " + std::to_string(capacity)};
        for (std::size_t i = 0; i < profile.points.size(); ++i) {
            const oro::ProfilePoint& point = profile.points[i];
            points[i] = {point.along_m, point.lat_deg, point.lon_deg, point.has_ground ? point.H_m : none,
                         point.has_ground ? point.h_m : none};
        }
    }
    if (sums != nullptr) fill_sums(profile, *sums);
    return {};
}

// What a viewshed is asked, and the region that it is asked over, which stays while it is.
struct AskedViewshed {
    std::shared_ptr<const OpenRegion> open;
    const oro::RegionGround* hiding{};
    oro::ViewshedReport report;  // its window; no values yet
};

Result<AskedViewshed> asked_viewshed(oro_region region, std::size_t count, const oro_point* eyes,
                                     const oro_viewshed_options* given) {
    ORO_TRY(const oro_viewshed_options options,
            oro::options_of<oro_viewshed_options>(given, ORO_VIEWSHED_OPTIONS));
    ORO_CHECK(oro::check_given("eyes", eyes));
    constexpr std::size_t most_eyes = 1'000'000;
    if (count < 1 || count > most_eyes)
        return oro::bad_argument("count", std::to_string(count) + " eyes are not between 1 and 1,000,000");
    AskedViewshed asked;
    ORO_TRY(asked.open, oro::region_of(region));
    const oro::SightGround& ground = *asked.open->ground;
    oro::ViewshedOptions checked;
    checked.radius_km = options.radius_km;
    checked.target_m = options.target_m;
    if (!std::isfinite(options.target_m)) return oro::bad_argument("target_m", "is no number");
    ORO_CHECK(oro::check_viewshed(checked));
    if (options.targets_on_canopy != 0 && !ground.canopy)
        return oro::bad_argument("targets_on_canopy", "is for regions that are opened with a canopy");
    oro::ViewshedQuestion question;
    question.target_m = options.target_m;
    question.radius_km = options.radius_km;
    ORO_TRY(question.air, oro::air_of(options.air, options.refraction_k));
    std::vector<oro::Standing> standings;
    for (std::size_t i = 0; i < count; ++i) {
        ORO_TRY(oro::Standing standing, oro::standing_at("eye", eyes[i], options.on_summit != 0));
        standings.push_back(std::move(standing));
    }
    question.at = standings.front().place;
    oro::Standpoints standpoints;
    ORO_CHECK(oro::place_eyes(standings, options.targets_on_canopy != 0, ground, question, standpoints));
    asked.hiding = ground.canopy ? ground.canopy->grids.get() : ground.grids.get();
    ORO_TRY(asked.report, oro::viewshed_window(question, *asked.hiding));
    return asked;
}

void fill_window(const AskedViewshed& asked, oro_window& window) {
    const std::size_t grid = asked.report.grid;
    oro::fill_window(grid, asked.hiding->grid(grid), asked.report.window, window);
    window.known = asked.report.cells;
    window.seen = asked.report.seen;
}

// Looks around; the caller's progress function stops it.
Result<void> look_into(AskedViewshed& asked, const oro::ViewshedValues& values, oro_progress progress,
                       void* user) {
    std::stop_source stop;
    const oro::ViewshedProgress report_share = [&](double share) {
        if (progress != nullptr && progress(share, "looking around", user) != 0) stop.request_stop();
    };
    const Result<void> looked =
        oro::look_around(*asked.hiding, values, asked.report, report_share, stop.get_token());
    if (stop.stop_requested()) throw oro::Cancelled{};
    return looked;
}

}  // namespace

oro_status oro_sight(oro_region region, const oro_point* from, const oro_point* to,
                     const oro_sight_options* options, oro_sight_answer* answer) {
    return oro::guarded_call([&] { return answer_sight(region, from, to, options, answer); });
}

oro_status oro_profile(oro_region region, size_t places, const double* lat_deg, const double* lon_deg,
                       const oro_profile_options* options, oro_profile_point* points, size_t capacity,
                       size_t* count, oro_profile_sums* sums) {
    return oro_profile_with_progress(region, places, lat_deg, lon_deg, options, points, capacity, count, sums,
                                     nullptr, nullptr);
}

oro_status oro_profile_with_progress(oro_region region, size_t places, const double* lat_deg,
                                     const double* lon_deg, const oro_profile_options* options,
                                     oro_profile_point* points, size_t capacity, size_t* count,
                                     oro_profile_sums* sums, oro_progress progress, void* user) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_given("count", count));
        if (sums != nullptr) ORO_CHECK(oro::check_size("sums", sums->size, sizeof(oro_profile_sums)));
        ORO_TRY(AskedProfile asked, asked_profile(places, lat_deg, lon_deg, options));
        return answer_profile(region, asked, points, capacity, count, sums, oro::progress_to(progress, user));
    });
}

oro_status oro_viewshed_window(oro_region region, size_t count, const oro_point* eyes,
                               const oro_viewshed_options* options, oro_window* window) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_window(window));
        ORO_TRY(const AskedViewshed asked, asked_viewshed(region, count, eyes, options));
        fill_window(asked, *window);
        return {};
    });
}

oro_status oro_viewshed(oro_region region, size_t count, const oro_point* eyes,
                        const oro_viewshed_options* options, float* clearance_deficit_m, float* observers,
                        size_t capacity, oro_window* window, oro_progress progress, void* user) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_window(window));
        ORO_TRY(AskedViewshed asked, asked_viewshed(region, count, eyes, options));
        fill_window(asked, *window);
        const std::size_t posts = asked.report.window.count();
        if (capacity < posts)
            throw oro::TooSmall{"buffers: the window has " + std::to_string(posts) +
                                " posts, and there is room for " + std::to_string(capacity)};
        ORO_CHECK(oro::check_given("clearance_deficit_m", clearance_deficit_m));
        ORO_CHECK(oro::check_given("observers", observers));
        ORO_CHECK(look_into(asked, {{clearance_deficit_m, posts}, {observers, posts}}, progress, user));
        fill_window(asked, *window);
        return {};
    });
}

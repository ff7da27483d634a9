#include "apps/commands/sight/profile_along.h"

#include <cstdio>
#include <string>

#include "apps/command_line/refusals.h"
#include "apps/commands/sight/look_along.h"
#include "apps/commands/sight/profile_roofs.h"

namespace oro {
namespace {

// More are a table that nobody can open.
constexpr double most_steps = 1.0e7;
constexpr double most_threshold_m = 1.0e4;
// 25 times round the Earth.
constexpr double longest_m = 1.0e9;

}  // namespace

Result<void> check_steps(const ProfileOptions& options) {
    if (options.step_m && !(*options.step_m > 0.0)) {
        char text[40];
        std::snprintf(text, sizeof text, "%.15g", *options.step_m);
        return refused("--step", text, "must be more than 0");
    }
    if (!(options.climb_threshold_m >= 0.0 && options.climb_threshold_m <= most_threshold_m)) {
        char text[40];
        std::snprintf(text, sizeof text, "%.15g", options.climb_threshold_m);
        return refused("--climb-threshold", text, between_words(0.0, most_threshold_m));
    }
    return {};
}

Result<void> check_length(const ProfileOptions& options, const LineAlong& line) {
    const double length_m = line.distances_m.back();
    if (length_m > longest_m)
        return refused("--along", options.along, "is longer than 1,000,000 km, 25 times round the Earth");
    if (options.step_m && length_m / *options.step_m > most_steps)
        return refused("--step", std::to_string(*options.step_m),
                       "makes more than 10,000,000 places of this line: give a longer one");
    return {};
}

Result<void> follow_line(const ProfileOptions& options, const SightGround& ground, Profile& profile,
                         const ProfileProgress& progress) {
    profile.points = profile_points(profile.line, options.step_m, ground.ground(), progress);
    add_roofs(ground, options.step_m.has_value(), profile);
    profile.sums = sums_of(profile.points, options.climb_threshold_m);
    return ground.region.health();
}

Result<void> check_has_ground(const ProfileOptions& options, const SightGround& ground,
                              const Profile& profile) {
    if (profile.sums.highest || highest_top(profile)) return {};
    const LatLon& begin = profile.line.places.front();
    return Error{ErrorKind::no_data, "--along " + options.along,
                 "no elevation data along the line" +
                     where_data_are(grid_at(ground.region, begin.lat_deg, begin.lon_deg).field.grid,
                                    begin.lat_deg, begin.lon_deg)};
}

}  // namespace oro

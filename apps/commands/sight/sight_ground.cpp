#include "apps/commands/sight/sight_ground.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/options/view_limits.h"
#include "apps/report/json_object.h"
#include "apps/view/view.h"
#include "core/sight/observer.h"
#include "geo/opening/open_region.h"
#include "geo/together/covered_grids.h"

namespace oro {

double SightGround::H_m(const Geodetic& point) const {
    return point.h_m - ground().N_m(point.lat_deg, point.lon_deg);
}

std::optional<double> SightGround::above_m(const Geodetic& point) const {
    const std::optional<double> ground_m = ground().h_m(point.lat_deg, point.lon_deg);
    if (!ground_m) return std::nullopt;
    return point.h_m - *ground_m;
}

Result<std::unique_ptr<const SightGround>> open_sight_ground(const RegionOptions& options,
                                                             const Progress& progress) {
    ORO_TRY(const RegionRequest request, region_request(options));
    auto ground = std::make_unique<SightGround>();
    ORO_TRY(ground->region, open_region(request, progress));
    leave_covered_grids_out(ground->region);
    ORO_TRY(ground->grids, RegionGround::of(ground->region, 1.0));
    return std::unique_ptr<const SightGround>(std::move(ground));
}

Result<void> check_above(const char* option, const std::optional<double>& above_m) {
    if (!above_m || *above_m >= 0.0) return {};
    char text[40];
    std::snprintf(text, sizeof text, "%.15g", *above_m);
    return refused(option, text, "must be 0 or more: nothing is seen from, or in, the ground");
}

Result<Geodetic> point_over_ground(const Standing& standing, const SightGround& ground) {
    ORO_TRY(const Standpoint stood, stand_over_ground(standing, ground));
    return stood.eye;
}

Result<Standpoint> stand_over_ground(const Standing& standing, const SightGround& ground) {
    return stand_over_ground(standing, ground.region, ground.ground());
}

Result<Standpoint> stand_over_ground(const Standing& standing, const Region& region,
                                     const TrueGround& ground) {
    ORO_CHECK(check_above(standing.above_option, standing.above_m));
    ORO_TRY(const Place place, place_at(standing.place_option, standing.place));
    const RegionGrid& there = grid_at(region, place.lat_deg, place.lon_deg);
    ORO_TRY(Standpoint stood, stand(standing, there.field));
    Geodetic& point = stood.eye;
    if (!view_limits::sight_h_m.hold(point.h_m)) {
        char text[120];
        std::snprintf(text, sizeof text, "would be at h %g m, not between %g and %g", point.h_m,
                      view_limits::sight_h_m.low, view_limits::sight_h_m.high);
        return refused(standing.place_option, standing.place, text);
    }
    std::optional<double> above_m = ground.h_m(point.lat_deg, point.lon_deg);
    if (above_m) above_m = point.h_m - *above_m;
    // What was put onto the ground may be rounded below it.
    constexpr double rounded_m = 1.0e-6;
    if (above_m && *above_m < -rounded_m) {
        char text[80];
        std::snprintf(text, sizeof text, "lies %.1f m under the ground: give it another height", -*above_m);
        return refused(standing.place_option, standing.place, text);
    }
    if (above_m) point.h_m += std::max(0.0, least_above_m - *above_m);
    return stood;
}

nlohmann::ordered_json point_json(const SightGround& ground, const Geodetic& point) {
    return json_object("lat_deg", point.lat_deg, "lon_deg", point.lon_deg, "h_m", point.h_m, "H_m",
                       ground.H_m(point));
}

}  // namespace oro

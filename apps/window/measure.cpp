#include "apps/window/measure.h"

#include <cstdio>

namespace oro {

std::string along_text(const std::vector<LatLon>& places) {
    std::string text;
    for (const LatLon& place : places) {
        char one[60];
        std::snprintf(one, sizeof one, "%.9f,%.9f", place.lat_deg, place.lon_deg);
        text += (text.empty() ? "" : "; ") + std::string(one);
    }
    return text;
}

Result<Measurement> measured(const std::vector<LatLon>& places, const Air& air, const TrueGround& ground) {
    constexpr double climb_threshold_m = 10.0, eye_m = 2.0;  // as the commands have them
    Measurement measurement;
    measurement.places = places;
    if (places.size() < 2) return measurement;
    Profile profile;
    ORO_TRY(profile.line, line_along(along_text(places), std::nullopt));
    profile.points = profile_points(profile.line, std::nullopt, ground);
    profile.sums = sums_of(profile.points, climb_threshold_m);
    measurement.profile = std::move(profile);
    const LatLon &first = places.front(), &last = places.back();
    const auto first_m = ground.h_m(first.lat_deg, first.lon_deg);
    const auto last_m = ground.h_m(last.lat_deg, last.lon_deg);
    if (first_m && last_m)
        measurement.sight = look_along({first.lat_deg, first.lon_deg, *first_m + eye_m},
                                       {last.lat_deg, last.lon_deg, *last_m + least_above_m}, air, ground);
    if (places.size() > 2) measurement.area = geodesic_area(places);
    ORO_CHECK(ground.health());
    return measurement;
}

}  // namespace oro

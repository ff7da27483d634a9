#include "apps/window/measure.h"

#include <cstdio>
#include <utility>

namespace oro {
namespace {

Result<Measurement> measured_along(LineAlong line, const Air& air, const TrueGround& ground) {
    constexpr double climb_threshold_m = 10.0, eye_m = 2.0;  // as the commands have them
    Measurement measurement;
    measurement.places = line.places;
    Profile profile;
    profile.line = std::move(line);
    profile.points = profile_points(profile.line, std::nullopt, ground);
    profile.crossings = crossings_of(profile.line, profile.points, ground);
    profile.sums = sums_of(profile.points, climb_threshold_m);
    measurement.profile = std::move(profile);
    const LatLon &first = measurement.places.front(), &last = measurement.places.back();
    const auto first_m = ground.h_m(first.lat_deg, first.lon_deg);
    const auto last_m = ground.h_m(last.lat_deg, last.lon_deg);
    const bool is_ring = first.lat_deg == last.lat_deg && first.lon_deg == last.lon_deg;
    if (first_m && last_m && !is_ring)
        measurement.sight = look_along({first.lat_deg, first.lon_deg, *first_m + eye_m},
                                       {last.lat_deg, last.lon_deg, *last_m + least_above_m}, air, ground);
    // A way that was walked encloses something where it ends as it began.
    const bool encloses = measurement.profile->line.file.empty() || is_ring;
    if (measurement.places.size() > 2 && encloses) measurement.area = geodesic_area(measurement.places);
    ORO_CHECK(ground.health());
    return measurement;
}

}  // namespace

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
    if (places.size() < 2) return Measurement{places, {}, {}, {}};
    ORO_TRY(LineAlong line, line_along(along_text(places), std::nullopt));
    ORO_TRY(Measurement measurement, measured_along(std::move(line), air, ground));
    measurement.places = places;
    return measurement;
}

Result<Measurement> measured_line(const std::string& file, int number, const Air& air,
                                  const TrueGround& ground) {
    ORO_TRY(LineAlong line, line_of_file("--along", file, number));
    return measured_along(std::move(line), air, ground);
}

}  // namespace oro

#include "core/sight/observer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/sight/edge_crossings.h"

namespace oro {
namespace {

// The least rise in metres that is_enough() grants, from above.
template <class IsEnough>
std::optional<double> least_rise_m(const IsEnough& is_enough) {
    constexpr double most_m = 2.0e6;
    if (is_enough(0.0)) return 0.0;
    double low_m = 0.0, high_m = 1.0;
    while (!is_enough(high_m)) {
        low_m = high_m;
        high_m *= 2.0;
        if (high_m > most_m) return std::nullopt;
    }
    while (high_m - low_m > 1.0e-4) {
        const double middle_m = 0.5 * (low_m + high_m);
        (is_enough(middle_m) ? high_m : low_m) = middle_m;
    }
    return high_m;
}

Geodetic raised(Geodetic point, double by_m) {
    point.h_m += by_m;
    return point;
}

// Height of a line over the ground at one of its places.
struct Sample {
    double along_m;
    Geodetic place;
    std::optional<double> above_m;
};

// Where a parabola through three evenly spaced values is least, as a share of its way; nothing at an end.
std::optional<double> lowest_share(double at_0, double at_half, double at_1) {
    const double square = 2.0 * (at_0 - 2.0 * at_half + at_1);
    const double slope = -3.0 * at_0 + 4.0 * at_half - at_1;
    if (!(square > 0.0)) return std::nullopt;
    const double share = -0.5 * slope / square;
    if (!(share > 0.0 && share < 1.0)) return std::nullopt;
    return share;
}

// The lowest dip between the ends, or the lower end.
const Sample* lowest(const std::vector<Sample>& samples) {
    const Sample* found = nullptr;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
        const auto &before = samples[i - 1].above_m, &here = samples[i].above_m,
                   &after = samples[i + 1].above_m;
        if (!before || !here || !after || *here > *before || *here > *after) continue;
        if (!found || *here < *found->above_m) found = &samples[i];
    }
    if (found) return found;
    for (const Sample& sample : samples) {
        if (sample.above_m && (!found || *sample.above_m < *found->above_m)) found = &sample;
    }
    return found;
}

}  // namespace

Observer::Observer(const TrueGround& ground, const Geodetic& eye, const Air& air)
    : ground_(ground), eye_(eye), sight_(sight_from(eye, air)), oracle_(ground, sight_) {}

std::optional<SightHit> Observer::obstacle(const Geodetic& target) const {
    const glm::dvec3 seen_m = sight_.refraction.apparent_m(ecef_from_geodetic(target).m - sight_.eye.m);
    const double distance_m = glm::length(seen_m);
    if (distance_m < least_above_m) return std::nullopt;
    return oracle_.first_hit(seen_m / distance_m, distance_m);
}

std::optional<double> Observer::clearance_deficit_m(const Geodetic& target) const {
    return least_rise_m([&](double by_m) { return sees(raised(target, by_m)); });
}

std::optional<double> eye_clearance_deficit_m(const TrueGround& ground, const Geodetic& eye, const Air& air,
                                              const Geodetic& target) {
    return least_rise_m([&](double by_m) { return Observer(ground, raised(eye, by_m), air).sees(target); });
}

LineOverGround Observer::line_to(const Geodetic& target) const {
    const glm::dvec3 seen_m = sight_.refraction.apparent_m(ecef_from_geodetic(target).m - sight_.eye.m);
    const double distance_m = glm::length(seen_m);
    const auto place_at = [&](double along_m) {
        return geodetic_from_ecef({sight_.eye.m + sight_.refraction.true_m(seen_m * (along_m / distance_m))});
    };
    const auto sample_at = [&](double along_m) {
        const Geodetic place = place_at(along_m);
        const std::optional<double> ground_m = ground_.h_m(place.lat_deg, place.lon_deg);
        return Sample{along_m, place,
                      ground_m ? std::optional(place.h_m - *ground_m) : std::optional<double>()};
    };
    LineOverGround line;
    if (distance_m < least_above_m) return line;
    std::vector<double> stops = edge_crossings(ground_, place_at, 0.0, distance_m);
    stops.push_back(distance_m);
    std::vector<Sample> samples{sample_at(0.0)};
    for (const double stop_m : stops) {
        const Sample from = samples.back();
        if (stop_m <= from.along_m) continue;
        const double length_m = stop_m - from.along_m;
        const Sample middle = sample_at(from.along_m + 0.5 * length_m), to = sample_at(stop_m);
        if (!middle.above_m) line.without_data_m += length_m;
        samples.push_back(middle);
        if (from.above_m && middle.above_m && to.above_m) {
            const auto share = lowest_share(*from.above_m, *middle.above_m, *to.above_m);
            if (share) samples.back() = sample_at(from.along_m + *share * length_m);
        }
        samples.push_back(to);
    }
    if (const Sample* const least = lowest(samples)) {
        line.clearance_m = *least->above_m;
        line.ground = raised(least->place, -line.clearance_m);
    }
    return line;
}

}  // namespace oro

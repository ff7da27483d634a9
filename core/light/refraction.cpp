#include "core/light/refraction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/earth/ellipsoid.h"
#include "core/earth/world_model.h"

namespace oro {
namespace {

constexpr double lowest_ground_h_m = -500.0;  // the Dead Sea's shore is at -430 m

double cosine_of_deg(double angle_deg) {
    return std::cos(radians_from_deg(angle_deg).rad);
}

// For an eye at that height that looks level or upwards, in almanacs' weather.
double thinned_deg(double airless_deg, double share) {
    return share * refraction_deg(airless_deg, {});
}

// Where a rising function of an angle, as steep as an angle is, passes 0 between two; the nearer end where it
// does not. It is asked some eight times, where halving asks 45 times, and one angle asks for others. Source:
// M. Dowell, P. Jarratt, A modified regula falsi method for computing the root of an equation, BIT 11, 1971.
template <class Function>
double root_deg(double low_deg, double high_deg, const Function& at) {
    constexpr double exact_deg = 1.0e-13;
    double at_low = at(low_deg), at_high = at(high_deg);
    if (at_low >= 0.0) return low_deg;
    if (at_high <= 0.0) return high_deg;
    int side = 0;
    for (int i = 0; i < 60 && high_deg - low_deg > exact_deg; ++i) {
        const double middle_deg = (low_deg * at_high - high_deg * at_low) / (at_high - at_low);
        const double at_middle = at(middle_deg);
        if (std::abs(at_middle) < exact_deg) return middle_deg;
        if (at_middle < 0.0) {
            low_deg = middle_deg;
            at_low = at_middle;
            if (side == -1) at_high *= 0.5;
            side = -1;
        } else {
            high_deg = middle_deg;
            at_high = at_middle;
            if (side == 1) at_low *= 0.5;
            side = 1;
        }
    }
    return 0.5 * (low_deg + high_deg);
}

// The refraction of what is seen at `seen_deg`, 0 or more.
double upwards_deg(double seen_deg, double share) {
    return seen_deg - root_deg(seen_deg - 1.0 - share, seen_deg, [&](double airless_deg) {
               return airless_deg + thinned_deg(airless_deg, share) - seen_deg;
           });
}

double index_of_air(double h_m) {
    return 1.0 + 2.8e-4 * air_share(h_m);
}

// Height of the lowest point of a ray that is seen below level.
double lowest_h_m(double seen_deg, double h_m) {
    const double constant_m = index_of_air(h_m) * (mean_radius_m + h_m) * cosine_of_deg(seen_deg);
    double lowest_m = h_m;
    for (int i = 0; i < 14; ++i) lowest_m = constant_m / index_of_air(lowest_m) - mean_radius_m;
    return lowest_m;
}

// Of what is seen below level.
double downwards_deg(double seen_deg, double h_m) {
    return 2.0 * upwards_deg(0.0, air_share(lowest_h_m(seen_deg, h_m))) -
           upwards_deg(-seen_deg, air_share(h_m));
}

// The lowest elevation at which any eye there sees past all ground.
double lowest_seen_deg(double h_m) {
    const double cosine = index_of_air(lowest_ground_h_m) * (mean_radius_m + lowest_ground_h_m) /
                          (index_of_air(h_m) * (mean_radius_m + h_m));
    return h_m <= lowest_ground_h_m || cosine >= 1.0 ? 0.0 : -deg_from_radians(Radians{std::acos(cosine)});
}

constexpr double fades_within_deg = 3.0;

}  // namespace

double refraction_deg(double airless_elevation_deg, const Weather& weather) {
    constexpr double published_from_deg = -1.0, none_from_deg = -3.0;
    if (airless_elevation_deg <= none_from_deg) return 0.0;
    if (airless_elevation_deg < published_from_deg)
        return refraction_deg(published_from_deg, weather) * (airless_elevation_deg - none_from_deg) /
               (published_from_deg - none_from_deg);
    const double bent_deg = airless_elevation_deg + 10.3 / (airless_elevation_deg + 5.11);
    // At the zenith the formula is off by 0.1 second of arc below zero, which would lift nothing.
    const double minutes = std::max(0.0, 1.02 / std::tan(radians_from_deg(bent_deg).rad));
    return minutes / 60.0 * (weather.pressure_hpa / 1010.0) * (283.0 / (273.0 + weather.temperature_c));
}

double air_share(double h_m) {
    constexpr double lowest_m = -1000.0, tropopause_m = 11000.0;
    // The exponents are g M / (R L) - 1 and g M / (R T) of that atmosphere.
    const auto below = [](double at_m) { return std::pow(1.0 - 0.0065 * at_m / 288.15, 4.25588); };
    if (h_m <= tropopause_m) return below(std::max(h_m, lowest_m));
    return below(tropopause_m) * std::exp((tropopause_m - h_m) / 6341.62);
}

double airless_elevation_deg(double seen_deg, double h_m) {
    if (seen_deg >= 0.0) return seen_deg - upwards_deg(seen_deg, air_share(h_m));
    const double lowest_deg = lowest_seen_deg(h_m);
    if (seen_deg >= lowest_deg) return seen_deg - downwards_deg(seen_deg, h_m);
    const double lift_deg =
        lowest_deg < 0.0 ? downwards_deg(lowest_deg, h_m) : upwards_deg(0.0, air_share(h_m));
    // From (lowest, lowest - lift) the lift falls to 0 along a straight line.
    const double fallen = (lowest_deg - seen_deg) / (fades_within_deg + lift_deg);
    return seen_deg - (fallen >= 1.0 ? 0.0 : lift_deg * (1.0 - fallen));
}

double seen_elevation_deg(double airless_deg, double h_m) {
    const double upwards = airless_deg + thinned_deg(airless_deg, air_share(h_m));
    if (upwards >= 0.0) return upwards;
    return root_deg(airless_deg, std::min(0.0, airless_deg + 3.0),
                    [&](double seen_deg) { return airless_elevation_deg(seen_deg, h_m) - airless_deg; });
}

double share_of_disc(double elevation_deg) {
    constexpr double radius_deg = 959.63 / 3600.0;
    const double up = std::clamp(elevation_deg / radius_deg, -1.0, 1.0);
    return 0.5 + (std::asin(up) + up * std::sqrt(1.0 - up * up)) / std::numbers::pi;
}

}  // namespace oro

// Where sight lines begin, and how far they are followed.
#include <algorithm>
#include <cmath>

#include "core/truth/oracle.h"

namespace oro {

Sight sight_from(const Geodetic& eye, const Air& air) {
    return {ecef_from_geodetic(eye), air.k == 0.0 ? Refraction() : Refraction(eye, air)};
}

Sight sight_of(const WorldModel& model, const Geodetic& eye) {
    Sight sight = sight_from(eye, model.air);
    sight.eye = model_eye_ecef(model.earth, eye);
    sight.earth = model.earth;
    sight.place = eye;
    return sight;
}

double sight_reach_m(double eye_h_m) {
    // From the highest mountain one sees 340 km; twice that to another of its kind, and as much again for odd
    // air.
    constexpr double over_the_earth_m = 1.5e6;
    const double eye_m = std::max(0.0, eye_h_m);
    return over_the_earth_m + std::sqrt(eye_m * (2.0 * wgs84_a_m + eye_m));
}

}  // namespace oro

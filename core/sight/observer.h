// From one point to another: whether it is seen, what stands in the way, and by how much.
#pragma once

#include <optional>

#include "core/truth/oracle.h"

namespace oro {

// What stands on the ground is this high above it at least: a line along the ground itself is not seen
// through it, and does not end in it.
inline constexpr double least_above_m = 0.001;

// How a line of sight runs over the ground, whether the ground lets it pass or not.
struct LineOverGround {
    // Height of the line over the ground where it is least, between the ends: the lowest of all dips; of a
    // line that has none, at its lower end. Below 0 under the ground.
    double clearance_m{};
    Geodetic ground;          // there, on the surface
    double without_data_m{};  // length of the line over no ground: beyond the data and over void posts
};

// An eye. Curvature is that of the ellipsoid; light bends by the air, as in pictures. Safe to ask from
// several threads.
//     const Observer observer(ground, eye, standard_air);
//     if (!observer.sees(target)) std::printf("%f\n", *observer.clearance_deficit_m(target));
class Observer {
  public:
    // What `ground` is made of outlives it.
    Observer(const TrueGround& ground, const Geodetic& eye, const Air& air);

    // The first ground on the line from the eye to where `target` is seen; nothing: it is seen. As exact as
    // Oracle::first_hit.
    [[nodiscard]] std::optional<SightHit> obstacle(const Geodetic& target) const;
    [[nodiscard]] bool sees(const Geodetic& target) const { return !obstacle(target); }

    // How much higher above the ellipsoid the target would have to be to be seen: 0 when it is. By bisection
    // between a height that sees() denies and one that it grants, which is given; error 1e-4 m.
    // Nothing where 2,000 km are not enough (an eye under the ground).
    [[nodiscard]] std::optional<double> clearance_deficit_m(const Geodetic& target) const;

    // Error of the clearance: 1e-6 m, and 1e-4 of a cell times its slope.
    [[nodiscard]] LineOverGround line_to(const Geodetic& target) const;

    [[nodiscard]] const Geodetic& eye() const { return eye_; }
    [[nodiscard]] const Sight& sight() const { return sight_; }

  private:
    TrueGround ground_;
    Geodetic eye_;
    Sight sight_;
    Oracle oracle_;
};

// How much higher the eye would have to be to see the target; as Observer::clearance_deficit_m.
std::optional<double> eye_clearance_deficit_m(const TrueGround& ground, const Geodetic& eye, const Air& air,
                                              const Geodetic& target);

}  // namespace oro

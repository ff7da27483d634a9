// When the sun shows over the terrain: its upper limb over the skyline that an eye really has.
#pragma once

#include "core/light/sun_position.h"
#include "core/truth/oracle.h"

namespace oro {

// An eye that looks for the sun. The sun is seen through all of the atmosphere (core/light/refraction.h), the
// terrain through the air between it and the eye, as pictures have it (Air).
//     const SunOverTerrain sun(ground, eye, standard_air, N_m);
//     if (sun.shows_at(1782012600.0)) std::puts("the sun is up");
class SunOverTerrain {
  public:
    // `surface` outlives it. sea_h_m: the sea's height above the ellipsoid at the eye (N). Where the data end
    // the sea bounds the view: the plain horizon, which lies below level for an eye above the sea.
    SunOverTerrain(const TrueGround& ground, const Geodetic& eye, const Air& air, double sea_h_m);

    [[nodiscard]] const Geodetic& eye() const { return eye_; }
    // Whether anything of the disc is seen: asks for 65 places along its upper limb, half a minute of arc
    // apart across it; what shows between two of them alone is missed.
    [[nodiscard]] bool shows_at(double time_utc_s) const;
    // Whether a sight line goes past all ground and the sea; elevation as it is seen.
    [[nodiscard]] bool is_free(double azimuth_deg, double seen_deg) const;

  private:
    Geodetic eye_;
    glm::dmat3 ecef_from_enu_;
    Oracle oracle_;
    double reach_m_;
    double sea_horizon_deg_;
};

// What the sun does over the terrain in the 24 hours from a time on, as sun_day() has it for a plain horizon:
// crossings are when the first of the disc shows and the last of it goes, however often ridges come between,
// each within 0.1 s of where shows_at() changes. Shows and gaps of less than 10 s may be missed. `threads`
// share the work; the answer does not depend on them.
SunDayEvents sun_day(double from_utc_s, const SunOverTerrain& sun, int threads);

}  // namespace oro

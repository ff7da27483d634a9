// The line on the ellipsoid below all sight lines of one azimuth.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/earth/ellipsoid.h"

namespace oro {

// The plane through the eye's vertical and a heading cuts WGS84 in an ellipse. Its points are told by an
// angle: 0 below the eye, growing ahead; half of pi is a quarter of the way round the Earth. Squashed so that
// WGS84 is a unit sphere, the ellipse is a circle, and parallels and meridians cut it where A cos + B sin =
// C.
class GroundTrack {
  public:
    // `ahead`: a unit ECEF direction, across the eye's vertical.
    GroundTrack(const Geodetic& eye, const glm::dvec3& ahead);

    // The vertical at a point of the line, in the plane: metres ahead of and above the eye. What the vertical
    // of a point far ahead leans out of the plane is left out: below 1 m in 9 km of height within 1,000 km.
    struct Vertical {
        double ahead_m;  // of its foot, h = 0
        double up_m;
        double normal_ahead;  // its direction
        double normal_up;
    };
    [[nodiscard]] Vertical vertical_at(double angle_rad) const;
    // h = 0.
    [[nodiscard]] Geodetic place_at(double angle_rad) const;

    // Adds the angles within (0, most_rad) at which the line crosses a parallel, or a meridian.
    void add_crossings_of_parallel(double lat_deg, double most_rad, std::vector<double>& angles_rad) const;
    void add_crossings_of_meridian(double lon_deg, double most_rad, std::vector<double>& angles_rad) const;

  private:
    [[nodiscard]] glm::dvec3 ecef_m(double angle_rad) const;

    glm::dvec3 eye_m_;
    glm::dvec3 ahead_;
    glm::dvec3 up_;
    // The circle on the unit sphere: centre + below cos + onwards sin.
    glm::dvec3 centre_;
    glm::dvec3 below_;
    glm::dvec3 onwards_;
};

}  // namespace oro

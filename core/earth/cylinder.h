// A picture all around: a cylinder that stands upright around the eye, unrolled. Columns are as far apart as
// their azimuths, rows as the tangents of their elevations, both on one scale where the view is level.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace oro {

// Azimuths are true, clockwise from north; elevations are angles above the eye's level, along its vertical
// (the ellipsoid's normal). Places are pixels from the top left corner, where (0.5, 0.5) is the middle of the
// first. Both mappings are exact but for rounding.
//     const Cylinder around = cylinder_around(0.0, 360.0, -12.0, 4.0, 7200);
//     const glm::dvec2 place_px = around.place_px({1.0, 0.0, 0.0});  // level in the east: (1800, above_px)
struct Cylinder {
    double from_deg{};        // azimuth of the left border, [0, 360)
    double sweep_deg{360.0};  // from there to the right border, (0, 360]
    int width_px{1};
    int above_px{};   // rows above the level line
    int below_px{1};  // rows below it

    [[nodiscard]] int height_px() const { return above_px + below_px; }
    // Pixels of a radian, along the level line and across it.
    [[nodiscard]] double px_per_rad() const;
    // Where a direction (east, north, up; of any length) is seen. The azimuth counts from the left border, so
    // what is left of it is far to the right. Straight up and down have no place: infinite.
    [[nodiscard]] glm::dvec2 place_px(const glm::dvec3& enu) const;
    [[nodiscard]] bool holds(const glm::dvec2& place_px) const;
    // [0, 360)
    [[nodiscard]] double azimuth_deg_at(double x_px) const;
    [[nodiscard]] double elevation_deg_at(double y_px) const;
    // Of no unit length: 1 across the vertical.
    [[nodiscard]] glm::dvec3 enu_at(const glm::dvec2& place_px) const;
};

// The one that holds these elevations (low < high, within -89 .. 89), in whole rows. `from_deg` may be any
// azimuth.
Cylinder cylinder_around(double from_deg, double sweep_deg, double low_deg, double high_deg, int width_px);

// From 0 up to 360, without 360.
double turned_deg(double azimuth_deg);

}  // namespace oro

// The air of shaders/air in doubles and by brute force: many small steps, fine tables. Shares no code with
// it.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "shaders/shared.h"

namespace oro::test {

// Radiance of the sky for a sun of illuminance 1, of a sphere.
class AirReference {
  public:
    // `scattered`: the sky is asked for, too; without it sunlight() alone, which takes far less to prepare.
    AirReference(const gpu::AirModel& model, double radius_m, bool scattered = true);

    // Seen from a height, towards an elevation and a turn from the sun.
    [[nodiscard]] glm::dvec3 radiance(double h_m, double elevation_rad, double turn_rad,
                                      double sun_elevation_rad) const;
    // ... as far as a point, and what of that point's own light comes through.
    struct Seen {
        glm::dvec3 gathered;
        glm::dvec3 through;
    };
    [[nodiscard]] Seen seen(double h_m, double elevation_rad, double turn_rad, double sun_elevation_rad,
                            double to_m) const;
    // On level ground: straight from the sun.
    [[nodiscard]] glm::dvec3 sunlight(double h_m, double sun_rise) const;

  private:
    [[nodiscard]] glm::dvec3 dense(double h_m) const;
    [[nodiscard]] glm::dvec3 extinction(const glm::dvec3& dense) const;
    [[nodiscard]] glm::dvec3 columns(double h_m, double angle_rad, double horizon_rad) const;
    [[nodiscard]] glm::dvec3 sunlight(double h_m, double sun_rise, double horizon_rad) const;
    [[nodiscard]] glm::dvec3 often(double h_m, double sun_rise) const;
    // A line of sight in steps, whatever the sun: what is let through half of each, and the share of light
    // that it scatters towards the eye.
    struct Step {
        double t_m, h_m, horizon_rad;
        glm::dvec3 to_eye;
    };
    struct Line {
        double h_m, rise;
        double ground_m;  // where it meets the ground; below 0 if it does not
        std::array<Step, 48> steps;
        glm::dvec3 through, share;  // of the whole line
    };
    [[nodiscard]] Line line_of(double h_m, double rise) const;
    [[nodiscard]] glm::dvec3 twice_along(const Line& line, double turn, double sun) const;
    struct Ring {
        Line line;
        double part;  // of all directions
    };
    [[nodiscard]] std::vector<Ring> rings_at(double h_m) const;
    [[nodiscard]] glm::dvec3 often_at(const std::vector<Ring>& rings, double sun_deg) const;
    void make_columns();
    void make_often();

    glm::dvec3 molecules_, ozone_;
    double molecules_scale_m_, dust_scattering_, dust_extinction_, dust_scale_m_, forward_, albedo_;
    double radius_m_;
    std::vector<glm::dvec3> columns_, often_;
};

}  // namespace oro::test

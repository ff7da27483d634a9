// A line of sight against boxes that stand in a frame of their own, where light may bend.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/earth/world_model.h"
#include "core/truth/line_meets.h"

namespace oro {

class LineInAir {
  public:
    // By what rounding, and turning into the frame, may move a line from 1e9 m away.
    static constexpr double rounded_m = 1.0e-6;

    // eye_m: in the frame. start_m: where the line begins, from the eye, and `direction`, of length 1: along
    // ECEF's axes.
    LineInAir(const glm::dmat3& frame_from_ecef, const glm::dvec3& eye_m, const Refraction& refraction,
              const glm::dvec3& start_m, const glm::dvec3& direction)
        : eye_m_(eye_m),
          start_(eye_m + frame_from_ecef * start_m),
          inverse_(finite_inverse(frame_from_ecef * direction)),
          up_(frame_from_ecef * refraction.up()),
          curvature_per_m_(refraction.curvature_per_m()) {}

    // How far along the line a box begins, or infinity: it is not met nearer than reach_m. Where light bends
    // a box is seen higher up. Points of it are lifted by c a^2 / 2, and where their distances across the
    // vertical, a, differ by at most r, that differs by at most c r (a + r / 2).
    [[nodiscard]] double box_begin_m(glm::dvec3 low, glm::dvec3 high, double reach_m) const {
        if (curvature_per_m_ != 0.0) {
            const glm::dvec3 from_eye = 0.5 * (low + high) - eye_m_;
            const double radius_m = 0.5 * glm::length(high - low),
                         across_m = glm::length(from_eye - glm::dot(from_eye, up_) * up_);
            const glm::dvec3 lift = 0.5 * curvature_per_m_ * across_m * across_m * up_;
            const double wider_m =
                rounded_m + std::abs(curvature_per_m_) * radius_m * (across_m + 0.5 * radius_m);
            low += lift - wider_m, high += lift + wider_m;
        }
        return oro::box_begin_m(start_, inverse_, low, high, reach_m);
    }

  private:
    glm::dvec3 eye_m_, start_, inverse_, up_;
    double curvature_per_m_;
};

}  // namespace oro

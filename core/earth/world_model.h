// What a picture models of the world and what it leaves out: the choices that cost or save accuracy.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "core/earth/ellipsoid.h"

namespace oro {

enum class Earth {
    ellipsoid,  // WGS84
    sphere,     // of mean_radius_m, latitudes and longitudes taken as they are
    flat,       // the plane that touches WGS84 at the eye; degrees there are as long as they are at the eye
};
// How posts are placed on the GPU.
enum class Precision {
    relative,       // relative to the eye, from tables in double (shaders/place/place.glsl)
    rounded_posts,  // ECEF rounded to float32, then relative to the eye without further loss
    naive,          // ECEF in float32 times a float32 view matrix: what is to be measured against
};

// How k of the air depends on the height of the eye.
enum class AirLaw {
    constant,  // not at all: what surveyors take k for
    standard,  // as the air's density: by e each 8,434 m, so that an eye in space has none
};

// The air, as it bends light: near level sight lines have k times the curvature 1 / R of the Earth, and
// ground at a distance d lies (1 - k) d^2 / (2 R) below the eye's horizontal plane. k is the coefficient of
// refraction. Everything that asks how light goes asks this (docs/SHADOWS.md, Refraction).
struct Air {
    double k{0.0};  // -1 .. 0.9; 0: light goes straight. AirLaw::standard: at sea level
    AirLaw law{AirLaw::constant};

    // For an eye at a height above the ellipsoid: k, or k exp(-h / 8434 m); below the ellipsoid as on it.
    [[nodiscard]] double k_at(double eye_h_m) const;
    bool operator==(const Air&) const = default;
};
// k by day near the ground. Source: Torge & Müller, Geodesy, 4th ed. 2012, section 5.1.1.2.
inline constexpr double usual_refraction_k = 0.13;
inline constexpr Air standard_air{usual_refraction_k, AirLaw::standard};

struct WorldModel {
    Earth earth{Earth::ellipsoid};
    Air air;  // default: light goes straight
    Precision precision{Precision::relative};
};

// The mean Earth radius R1. Source: H. Moritz, Geodetic Reference System 1980, J. Geodesy 74, 2000.
inline constexpr double mean_radius_m = 6371008.7714;

// How much sight lines from an eye bend. Light from a point at a distance s comes in higher than straight by
// k s^2 / (2 R): what is seen is the scene with each point lifted by that along the eye's vertical. Every
// part of the program that asks what can be seen where asks here.
class Refraction {
  public:
    // Light goes straight.
    Refraction() = default;
    // R is the Gaussian radius of curvature at the eye, k the air's at the eye's height: the air around the
    // eye bends most of what is seen.
    Refraction(const Geodetic& eye, const Air& air);

    [[nodiscard]] bool straight() const { return curvature_per_m_ == 0.0; }
    // 1 / radius of the sight lines, 1/m: k / R.
    [[nodiscard]] double curvature_per_m() const { return curvature_per_m_; }
    // The eye's vertical, a unit ECEF direction.
    [[nodiscard]] const glm::dvec3& up() const { return up_; }
    // From where a point is to where it is seen; offsets from the eye, metres, ECEF axes.
    [[nodiscard]] glm::dvec3 apparent_m(const glm::dvec3& offset_m) const {
        return offset_m + lift_m(offset_m) * up_;
    }
    // The inverse of apparent_m(), exact but for rounding: the lift does not change the distance across the
    // vertical.
    [[nodiscard]] glm::dvec3 true_m(const glm::dvec3& apparent_m) const {
        return apparent_m - lift_m(apparent_m) * up_;
    }

    // How far `offset_m` is lifted.
    [[nodiscard]] double lift_m(const glm::dvec3& offset_m) const;

  private:
    double curvature_per_m_{0.0};
    glm::dvec3 up_{0.0, 0.0, 1.0};
};

// Where the eye is on that model of the Earth, ECEF; the flat one touches WGS84 at the eye.
Ecef model_eye_ecef(Earth earth, const Geodetic& eye);

// From the eye to where that model of the Earth puts a point, light going straight: ECEF axes of the true
// eye, metres. The eye is on the same model by its own latitude, longitude and height. Error: rounding of
// doubles, 3e-9 m near the Earth. Flat: east and west part at the meridian opposite to the eye.
glm::dvec3 model_offset_m(Earth earth, const Geodetic& eye, const Geodetic& point);
// The inverse of model_offset_m(): what that model of the Earth has at an offset from the eye. Error: as
// above, and 1e-9 degree. Nothing where the model has no place: on the flat one beyond the poles and the
// opposite meridian.
std::optional<Geodetic> model_point(Earth earth, const Geodetic& eye, const glm::dvec3& offset_m);
// The offset as it is seen through the model's air. Precision is left out.
glm::dvec3 model_offset_m(const WorldModel& model, const Geodetic& eye, const Geodetic& point);

}  // namespace oro

#include "tests/support/air_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace oro::test {
namespace {

constexpr double top_m = 100000.0;
constexpr double pi = std::numbers::pi;
// Columns by height (square root) and by the angle above the horizon (square root).
constexpr int column_heights = 160, column_angles = 320;
// Light scattered often: heights by their square root; suns in degrees, half of one where they set.
constexpr int often_heights = 40, often_suns = 66;
double often_sun_deg(int j) {
    return j <= 44 ? -16.0 + 0.5 * j : 6.0 + 4.0 * (j - 44);
}
double often_sun_place(double deg) {
    return deg <= 6.0 ? 2.0 * (deg + 16.0) : 44.0 + (deg - 6.0) / 4.0;
}

// A place along a line in a plane through the Earth's centre: height, and how it rises from the level there.
struct Along {
    double h_m;
    double rise;
};
Along along(double radius_m, double h_m, double rise, double t_m) {
    const double across_m = std::sqrt(std::max(0.0, 1.0 - rise * rise)) * t_m,
                 up_m = radius_m + h_m + rise * t_m;
    const double r_m = std::hypot(across_m, up_m);
    return {r_m - radius_m, (rise * (radius_m + h_m) + t_m) / r_m};
}

// The way to a shell of a height from below it, or to the ground from above (the nearer crossing).
double way_m(double radius_m, double h_m, double rise, double shell_m, bool down) {
    const double r = radius_m + h_m, s = radius_m + shell_m;
    const double square = s * s - r * r * (1.0 - rise * rise);
    if (square < 0.0) return -1.0;
    return -r * rise + (down ? -1.0 : 1.0) * std::sqrt(square);
}

double horizon_at_rad(double radius_m, double h_m) {
    return -std::acos(radius_m / (radius_m + h_m));
}

// Between the entries of a table.
glm::dvec3 between(const std::vector<glm::dvec3>& table, int columns, double row, double column) {
    const int rows = static_cast<int>(table.size()) / columns;
    const int i = std::clamp(static_cast<int>(row), 0, rows - 2),
              j = std::clamp(static_cast<int>(column), 0, columns - 2);
    const double a = std::clamp(row - i, 0.0, 1.0), b = std::clamp(column - j, 0.0, 1.0);
    const auto at = [&](int r, int c) { return table[static_cast<std::size_t>(r * columns + c)]; };
    return (1.0 - a) * ((1.0 - b) * at(i, j) + b * at(i, j + 1)) +
           a * ((1.0 - b) * at(i + 1, j) + b * at(i + 1, j + 1));
}

}  // namespace

AirReference::AirReference(const gpu::AirModel& model, double radius_m, bool scattered)
    : molecules_(model.molecules_per_m),
      ozone_(model.ozone_per_m),
      molecules_scale_m_(model.molecules_scale_m),
      dust_scattering_(model.dust_scattering_per_m),
      dust_extinction_(model.dust_extinction_per_m),
      dust_scale_m_(model.dust_scale_m),
      forward_(model.dust_forward),
      albedo_(model.ground_albedo),
      radius_m_(radius_m) {
    make_columns();
    if (scattered) make_often();
}

glm::dvec3 AirReference::dense(double h_m) const {
    const double h = std::max(h_m, 0.0);
    return {std::exp(-h / molecules_scale_m_), std::exp(-h / dust_scale_m_),
            std::max(0.0, 1.0 - std::abs(h - 25000.0) / 15000.0)};
}
glm::dvec3 AirReference::extinction(const glm::dvec3& d) const {
    return molecules_ * d.x + glm::dvec3(dust_extinction_ * d.y) + ozone_ * d.z;
}

void AirReference::make_columns() {
    for (int i = 0; i < column_heights; ++i) {
        const double root = static_cast<double>(i) / (column_heights - 1), h_m = top_m * root * root;
        const double low = horizon_at_rad(radius_m_, h_m);
        for (int j = 0; j < column_angles; ++j) {
            const double part = static_cast<double>(j) / (column_angles - 1);
            const double rise = std::sin(low + part * part * (0.5 * pi - low));
            const double way = std::max(0.0, way_m(radius_m_, h_m, rise, top_m, false));
            glm::dvec3 sum(0.0);
            constexpr int steps = 400;
            for (int k = 0; k < steps; ++k) {
                const double from = way * std::pow(static_cast<double>(k) / steps, 2.0);
                const double to = way * std::pow((k + 1.0) / steps, 2.0);
                sum += dense(along(radius_m_, h_m, rise, 0.5 * (from + to)).h_m) * (to - from);
            }
            columns_.push_back(sum);
        }
    }
}

glm::dvec3 AirReference::columns(double h_m, double angle_rad, double horizon_rad) const {
    const double part = std::clamp((angle_rad - horizon_rad) / (0.5 * pi - horizon_rad), 0.0, 1.0);
    return between(columns_, column_angles,
                   std::sqrt(std::clamp(h_m / top_m, 0.0, 1.0)) * (column_heights - 1),
                   std::sqrt(part) * (column_angles - 1));
}

glm::dvec3 AirReference::sunlight(double h_m, double sun_rise) const {
    return sunlight(h_m, sun_rise, horizon_at_rad(radius_m_, std::max(h_m, 0.0)));
}
glm::dvec3 AirReference::sunlight(double h_m, double sun_rise, double horizon_rad) const {
    if (h_m >= top_m) return glm::dvec3(1.0);
    constexpr double disc_rad = 0.00465;
    const double angle_rad = std::asin(std::clamp(sun_rise, -1.0, 1.0)), above = angle_rad - horizon_rad;
    const double part = std::clamp((above + disc_rad) / (2.0 * disc_rad), 0.0, 1.0);
    if (part <= 0.0) return glm::dvec3(0.0);
    return part * part * (3.0 - 2.0 * part) * glm::exp(-extinction(columns(h_m, angle_rad, horizon_rad)));
}

void AirReference::make_often() {
    for (int i = 0; i < often_heights; ++i) {
        const double root = static_cast<double>(i) / (often_heights - 1);
        const double h_m = std::max(1.0, std::min(top_m - 1.0, top_m * root * root));
        const std::vector<Ring> rings = rings_at(h_m);
        for (int j = 0; j < often_suns; ++j) often_.push_back(glm::log(often_at(rings, often_sun_deg(j))));
    }
}

AirReference::Line AirReference::line_of(double h_m, double rise) const {
    Line line{};
    line.h_m = h_m;
    line.rise = rise;
    line.ground_m = rise < 0.0 ? way_m(radius_m_, h_m, rise, 0.0, true) : -1.0;
    const double way = line.ground_m >= 0.0 ? line.ground_m : way_m(radius_m_, h_m, rise, top_m, false);
    line.through = glm::dvec3(1.0);
    for (std::size_t s = 0; s < line.steps.size(); ++s) {
        const double all = static_cast<double>(line.steps.size());
        const double from = way * std::pow(static_cast<double>(s) / all, 2.0),
                     to = way * std::pow(static_cast<double>(s + 1) / all, 2.0), t = 0.5 * (from + to);
        const double at_h_m = along(radius_m_, h_m, rise, t).h_m;
        const glm::dvec3 d = dense(at_h_m), half = glm::exp(-extinction(d) * (0.5 * (to - from)));
        line.through *= half;
        const glm::dvec3 to_eye = line.through * (molecules_ * d.x + dust_scattering_ * d.y) * (to - from);
        line.steps[s] = {t, at_h_m, horizon_at_rad(radius_m_, std::max(at_h_m, 0.0)), to_eye};
        line.share += to_eye;
        line.through *= half;
    }
    return line;
}

// What a line of sight adds to light scattered twice.
glm::dvec3 AirReference::twice_along(const Line& line, double turn, double sun) const {
    const double to_sun =
        line.rise * sun + std::sqrt((1.0 - line.rise * line.rise) * (1.0 - sun * sun)) * std::cos(turn);
    const auto sun_at = [&](double t, double at_h) {
        return ((radius_m_ + line.h_m) * sun + t * to_sun) / (radius_m_ + at_h);
    };
    glm::dvec3 light(0.0);
    for (const Step& at : line.steps)
        light += at.to_eye * sunlight(at.h_m, sun_at(at.t_m, at.h_m), at.horizon_rad) / (4.0 * pi);
    if (line.ground_m >= 0.0) {
        const double at = sun_at(line.ground_m, 0.0);
        light += line.through * albedo_ / pi * std::max(at, 0.0) * sunlight(0.0, at);
    }
    return light;
}

// All directions: thin rings around the vertical, thinnest at the horizon.
std::vector<AirReference::Ring> AirReference::rings_at(double h_m) const {
    constexpr int count = 16;
    const double horizon = horizon_at_rad(radius_m_, h_m);
    std::vector<Ring> rings;
    for (const double side : {-1.0, 1.0}) {
        const double span = 0.5 * pi - side * horizon;
        for (int k = 0; k < count; ++k) {
            const double low = std::sin(horizon + side * span * std::pow(k / 16.0, 2.0));
            const double high = std::sin(horizon + side * span * std::pow((k + 1) / 16.0, 2.0));
            const double rise = std::sin(horizon + side * span * std::pow((k + 0.5) / 16.0, 2.0));
            rings.push_back({line_of(h_m, rise), 0.5 * std::abs(high - low)});
        }
    }
    return rings;
}

glm::dvec3 AirReference::often_at(const std::vector<Ring>& rings, double sun_deg) const {
    constexpr int turns = 10;
    const double sun = std::sin(sun_deg * pi / 180.0);
    glm::dvec3 light(0.0), share(0.0);
    for (const Ring& ring : rings) {
        for (int j = 0; j < turns; ++j)
            light += twice_along(ring.line, pi * (j + 0.5) / turns, sun) * (ring.part / turns);
        share += ring.line.share * ring.part;
    }
    return glm::max(light / (1.0 - share), glm::dvec3(1e-20));
}

glm::dvec3 AirReference::often(double h_m, double sun_rise) const {
    const double deg = std::asin(std::clamp(sun_rise, -1.0, 1.0)) * 180.0 / pi;
    return glm::exp(between(often_, often_suns,
                            std::sqrt(std::clamp(h_m / top_m, 0.0, 1.0)) * (often_heights - 1),
                            often_sun_place(std::max(deg, -16.0))));
}

AirReference::Seen AirReference::seen(double h_m, double elevation_rad, double turn_rad,
                                      double sun_elevation_rad, double to_m) const {
    const double rise = std::sin(elevation_rad), sun = std::sin(sun_elevation_rad);
    const double to_sun =
        rise * sun + std::cos(elevation_rad) * std::cos(sun_elevation_rad) * std::cos(turn_rad);
    const double begin_m = h_m > top_m ? std::max(0.0, way_m(radius_m_, h_m, rise, top_m, true)) : 0.0;
    const double g = forward_;
    const double by_molecules = 3.0 / (16.0 * pi) * (1.0 + to_sun * to_sun);
    const double by_dust = 3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + to_sun * to_sun) /
                           ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * to_sun, 1.5));
    Seen seen{glm::dvec3(0.0), glm::dvec3(1.0)};
    constexpr int steps = 4000;
    for (int i = 0; i < steps; ++i) {
        const double length = (to_m - begin_m) / steps, t = begin_m + (i + 0.5) * length;
        const Along at = along(radius_m_, h_m, rise, t);
        const double sun_at = ((radius_m_ + h_m) * sun + t * to_sun) / (radius_m_ + at.h_m);
        const glm::dvec3 d = dense(at.h_m), half = glm::exp(-extinction(d) * (0.5 * length));
        const glm::dvec3 light = sunlight(at.h_m, sun_at), more = often(at.h_m, sun_at);
        seen.through *= half;
        seen.gathered += seen.through * length *
                         (molecules_ * d.x * (by_molecules * light + more) +
                          dust_scattering_ * d.y * (by_dust * light + more));
        seen.through *= half;
    }
    return seen;
}

glm::dvec3 AirReference::radiance(double h_m, double elevation_rad, double turn_rad,
                                  double sun_elevation_rad) const {
    const double way = way_m(radius_m_, h_m, std::sin(elevation_rad), top_m, false);
    return seen(h_m, elevation_rad, turn_rad, sun_elevation_rad, way).gathered;
}

}  // namespace oro::test

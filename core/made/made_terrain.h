// Made terrain: heights that follow from a rule of places on the Earth, not from a survey. Its truth is known
// at and between all posts, and it needs no file.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace oro {

enum class MadeKind { fbm, ridged, plane, cone, sine, step, sphere, checker };

// What decides a made terrain. Posts lie on whole multiples of 1 / posts_per_deg degrees, counted from the
// equator and from Greenwich, so that boxes of the same spacing share their posts. Lengths are metres,
// heights are H in whole steps of 2^-11 m.
struct MadeTerrain {
    MadeKind kind{MadeKind::fbm};
    std::uint32_t seed{1};     // fbm, ridged
    std::uint32_t octaves{9};  // fbm, ridged: 1 to 24; each has half the cells of the one before
    std::uint32_t gain{536};   // fbm, ridged: an octave's share of the one before, thousandths, 300 to 900
    std::uint32_t cell_shift{22};    // fbm, ridged: cells of the first octave are 2^shift / 192 m wide
    std::uint32_t azimuth_deg{0};    // plane, sine, step: where it rises to at the box's centre, 0 to 359
    std::uint32_t length_m{0};       // plane: from the lowest to the highest place; sine: wavelength
    std::uint32_t radius_m{0};       // cone: of its foot; sphere: of the sphere; 1 to 1,000,000
    std::int32_t low{0};             // 2^-11 m; no height is lower
    std::int32_t high{1000 * 2048};  // 2^-11 m; no height is higher
    std::int64_t posts_per_deg{3600};
    // Numbers of the outermost posts; west in [-180, 180) times posts_per_deg, east at most a turn more.
    std::int64_t west{}, south{}, east{}, north{};

    // Posts of a full circle are counted once.
    [[nodiscard]] bool is_full_circle() const { return east - west >= 360 * posts_per_deg; }
    [[nodiscard]] int rows() const { return static_cast<int>(north - south + 1); }
    [[nodiscard]] int columns() const {
        return static_cast<int>(is_full_circle() ? 360 * posts_per_deg : east - west + 1);
    }
};

// The steps that heights are made in.
inline constexpr double made_step_m = 1.0 / 2048.0;
// How much noise reaches from the middle of the range to `low` and `high`: some 3.6 times the r.m.s. of all
// octaves. What would be beyond, 1 post of some 10,000, is cut off there.
inline constexpr int made_noise_percent = 50;

}  // namespace oro

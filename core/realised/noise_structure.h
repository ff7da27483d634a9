// Sums of lattice noise with a known covariance: what simulated errors, and simulated ground between data and
// truth, are made of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/made/made_rule.h"

namespace oro {

// Correlation of one octave of lattice noise at two places so far apart, in widths of its cells, over all
// directions: 1 at 0, nothing from 2 on. Error: 3e-5, and smooth: neighbouring distances are right to 1e-8 to
// each other, so that differences of long waves keep their digits. Source: the noise's definition
// (shaders/made/made_heights.glsl): the mean over a cell and over directions of what two places share.
double lattice_correlation(double cells);
// The standard deviation of one octave whose amplitude is 1. Source: the same mean, at one place.
inline constexpr double lattice_deviation = 0.27006;

// One sum's octave: the width of its cells and how much it varies.
struct NoiseBand {
    double cell_m{};
    double variance{};  // square metres
};

// Covariance of a sum at two places so far apart, square metres.
double covariance_of(std::span<const NoiseBand> bands, double distance_m);
// Half the mean square difference of two places, square metres: covariance at 0 less that at the distance.
double semivariance_of(std::span<const NoiseBand> bands, double distance_m);
// Mean square of the second difference of three places in line, each so far from the next.
double second_difference_of(std::span<const NoiseBand> bands, double distance_m);

// Places in space, in steps of 2^-6 m from the Earth's centre, times a scale; a coordinate each.
struct NoisePlaces {
    std::vector<std::int32_t> x, y, z;
};

// Adds a sum of octaves at places: `bands` as for covariance_of, whose cells are 2^n / 192 m / scale wide
// where the places are scaled. Worlds of different seeds are independent. The same bits everywhere but for
// the rounding of doubles in a fixed order. `values` has as many numbers as there are places. Any thread.
void add_noise(std::span<const NoiseBand> bands, double scale, std::uint32_t seed, const NoisePlaces& places,
               std::span<float> values);

// The width of cells, 2^n / 192 m, that is nearest to a length by ratio.
double lattice_cell_near(double length_m);

}  // namespace oro

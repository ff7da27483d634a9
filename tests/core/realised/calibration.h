// How well predicted probabilities of being seen hold, over made worlds whose truth and whose errors are
// known.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/sight/viewshed.h"
#include "core/terrain/post_grid.h"

namespace oro::test {

// One world: 161 x 161 posts of 3 seconds of made ground, and the same with errors, which are not of the
// program's own noise: white noise smoothed by two bells.
struct ErrorWorld {
    HeightField truth, data;
    double lat_deg{}, lon_deg{};  // of the observer
    double above_m{};
    int finer{1};  // posts of the truth in place of one of the data, each way
};
ErrorWorld error_world(std::uint32_t seed, double deviation_m, double correlation_m, int finer = 1);

// Predicted probabilities beside what is seen, of the posts whose prediction is in the same tenth.
struct Tenth {
    double posts{}, predicted{}, seen{};  // sums
};

struct Reliability {
    std::array<Tenth, 10> tenths{};
    double posts{}, squares{}, predicted{}, seen{};  // sums; squares of differences
    void add(double predicted_probability, bool is_seen);
    void add(const Reliability& more);
    [[nodiscard]] double brier() const { return squares / posts; }
    // The largest difference of a tenth that has at least this share of all posts, points.
    [[nodiscard]] double worst_points(double least_share) const;
    // The mean difference, weighted by posts, points.
    [[nodiscard]] double mean_points() const;
};

// Of three ways to tell: realisations of the posterior, the data with errors added, and the data alone.
struct Calibration {
    Reliability posterior, data_and_noise, yes_no;
    void add(const Calibration& more);
    // Lines that scripts/measure-probability reads.
    void print() const;
};

// Adds a world's posts, of `realisations` of each kind, those of the posterior as fine as is said; of data
// plus noise only where that is 1. The program is given the errors' deviation and correlation length, and
// estimates the ground's roughness from the data.
void add_world(const ErrorWorld& world, std::uint32_t seed, double deviation_m, double correlation_m,
               int realisations, Calibration& calibration, int finer = 1);

}  // namespace oro::test

// What errors of drawn pictures are given as, and the depths that some are found from.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace oro {

// Of absolute values. 0 everywhere when there are none.
struct ErrorSummary {
    double largest{};
    double p9999{};  // 99.99 % are not larger (nearest rank)
    double p99{};
    double mean{};
    std::uint64_t count{};
    // Values that are only known to be no smaller than they say: how many, and the smallest of them. So the
    // largest and the mean, and shares from the smallest on, are at least what they say.
    std::uint64_t at_least{};
    double least_of_these{};

    // Whether one of the four figures is at least what it says, and not that.
    [[nodiscard]] bool is_at_least(double figure) const {
        return at_least > 0 && (figure == largest || figure == mean || figure >= least_of_these);
    }
};
ErrorSummary summary_of(std::vector<double> values);
// The summary of floats, those that are not_measured left out. at_least: not 0 for values that are only known
// to be no smaller; empty: none.
ErrorSummary summary_of(std::span<const float> values, std::span<const std::uint8_t> at_least = {});

// A drawn picture's depths: reversed (near_plane_m / distance along the view axis), 0 for the background, row
// by row, each at the sample's place in its pixel.
struct DrawnDepths {
    std::span<const float> depths;
    glm::dvec2 sample_px{0.5, 0.5};
};

// The value of a pixel that has no such error.
inline constexpr float not_measured = -1.0e30F;

}  // namespace oro

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
};
ErrorSummary summary_of(std::vector<double> values);
// The same of floats, those that are not_measured left out.
ErrorSummary summary_of(std::span<const float> values);

// A drawn picture's depths: reversed (near_plane_m / distance along the view axis), 0 for the background, row
// by row, each at the sample's place in its pixel.
struct DrawnDepths {
    std::span<const float> depths;
    glm::dvec2 sample_px{0.5, 0.5};
};

// Of a pixel that has no such error.
inline constexpr float not_measured = -1.0e30F;

}  // namespace oro

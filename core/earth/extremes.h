// The range of a set of differences.
#pragma once

#include <algorithm>

namespace oro {

// Lowest and highest of 0 and what was added; the larger in size counts.
struct Extremes {
    double lowest{0.0};
    double highest{0.0};
    void add(double difference) {
        lowest = std::min(lowest, difference);
        highest = std::max(highest, difference);
    }
    [[nodiscard]] double magnitude() const { return std::max(-lowest, highest); }
};

}  // namespace oro

// The median of a set of values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace oro {

// Of an even number of values the middle of the two in the middle; 0 of none. Reorders the values.
inline double median_of(std::vector<double>&& values) {
    if (values.empty()) return 0.0;
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    if (values.size() % 2 == 1) return *half;
    return 0.5 * (*std::max_element(values.begin(), half) + *half);
}

}  // namespace oro

#include "core/truth/picture_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace oro {
namespace {

// Number, from 1, of the value that a share of all are not larger than.
std::size_t nearest_rank(std::size_t count, std::size_t of_ten_thousand) {
    return (count * of_ten_thousand + 9999) / 10000;
}

// Of absolute values; reorders them.
template <class Value>
ErrorSummary summary_of_sizes(std::vector<Value>& sizes) {
    ErrorSummary summary;
    summary.count = sizes.size();
    if (sizes.empty()) return summary;
    const auto ranked = [&](std::size_t rank) {
        const auto nth = sizes.begin() + static_cast<std::ptrdiff_t>(rank - 1);
        std::nth_element(sizes.begin(), nth, sizes.end());
        return static_cast<double>(*nth);
    };
    summary.mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size());
    summary.p99 = ranked(nearest_rank(sizes.size(), 9900));
    summary.p9999 = ranked(nearest_rank(sizes.size(), 9999));
    summary.largest = static_cast<double>(*std::max_element(sizes.begin(), sizes.end()));
    return summary;
}

}  // namespace

ErrorSummary summary_of(std::vector<double> values) {
    for (double& value : values) value = std::abs(value);
    return summary_of_sizes(values);
}

ErrorSummary summary_of(std::span<const float> values, std::span<const std::uint8_t> at_least) {
    std::vector<float> sizes;
    sizes.reserve(values.size());
    for (const float value : values) {
        if (value != not_measured) sizes.push_back(std::abs(value));
    }
    ErrorSummary summary = summary_of_sizes(sizes);
    for (std::size_t i = 0; i < at_least.size(); ++i) {
        if (at_least[i] == 0 || values[i] == not_measured) continue;
        const double size = std::abs(static_cast<double>(values[i]));
        summary.least_of_these = summary.at_least == 0 ? size : std::min(summary.least_of_these, size);
        ++summary.at_least;
    }
    return summary;
}

}  // namespace oro

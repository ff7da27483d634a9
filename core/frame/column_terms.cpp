#include "core/frame/column_terms.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/base/wide.h"
#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

// Columns at a time: of a page, and one more.
constexpr std::size_t at_a_time = 132;
// The series of the sine to the 17th power: what is left out is below 2^-62 of it up to 45 degrees, and its
// rounding and that of std::sin are each below 2^-51. So these bounds hold with room to spare.
constexpr double sine_slack = 0x1p-47, versine_slack = 0x1p-45;
constexpr double series_up_to_deg = 45.0, series_from_deg = 1.0e-9;
// Near the eye that to the 9th power leaves out less than 2^-60.
constexpr double short_series_up_to_deg = 4.0;

inline double sine_by_series(double x) {
    const double z = x * x;
    double sum = 1.0 / 355687428096000.0;
    sum = sum * z - 1.0 / 1307674368000.0;
    sum = sum * z + 1.0 / 6227020800.0;
    sum = sum * z - 1.0 / 39916800.0;
    sum = sum * z + 1.0 / 362880.0;
    sum = sum * z - 1.0 / 5040.0;
    sum = sum * z + 1.0 / 120.0;
    sum = sum * z - 1.0 / 6.0;
    return x + x * z * sum;
}

inline double sine_by_short_series(double x) {
    const double z = x * x;
    double sum = 1.0 / 362880.0;
    sum = sum * z - 1.0 / 5040.0;
    sum = sum * z + 1.0 / 120.0;
    sum = sum * z - 1.0 / 6.0;
    return x + x * z * sum;
}

// Both terms of up to at_a_time columns; how many of them are not certain, and which.
// Part of what calls it, which is compiled for wider registers, too.
template <double (*sine_of)(double)>
[[gnu::always_inline]] inline int terms_by(const double* east_deg, std::size_t count, gpu::ColumnTerms* terms,
                                           int* unsure) {
    std::array<float, at_a_time> V, W;
    int all = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = east_deg[i] * (std::numbers::pi / 180.0);
        const double sine = sine_of(x), half_sine = sine_of(0.5 * x);
        const double versine = 2.0 * half_sine * half_sine;
        V[i] = static_cast<float>(versine * (1.0 - versine_slack));
        W[i] = static_cast<float>(sine * (1.0 - sine_slack));
        const double from_eye_deg = std::abs(east_deg[i]);
        const int same = (static_cast<float>(versine * (1.0 + versine_slack)) == V[i]) &
                         (static_cast<float>(sine * (1.0 + sine_slack)) == W[i]);
        const int within = (from_eye_deg <= series_up_to_deg) & (from_eye_deg >= series_from_deg);
        unsure[i] = 1 - (same & within);
        all += unsure[i];
    }
    for (std::size_t i = 0; i < count; ++i) terms[i] = {V[i], W[i]};
    return all;
}

ORO_WIDE int terms_by_series(const double* east_deg, std::size_t count, gpu::ColumnTerms* terms,
                             int* unsure) {
    return terms_by<sine_by_series>(east_deg, count, terms, unsure);
}

ORO_WIDE int terms_by_short_series(const double* east_deg, std::size_t count, gpu::ColumnTerms* terms,
                                   int* unsure) {
    return terms_by<sine_by_short_series>(east_deg, count, terms, unsure);
}

}  // namespace

gpu::ColumnTerms column_terms(double east_deg) {
    const double half_sine = sine_cosine_deg(0.5 * east_deg).sine;
    return {static_cast<float>(2.0 * half_sine * half_sine),
            static_cast<float>(sine_cosine_deg(east_deg).sine)};
}

void column_terms(std::span<const double> east_deg, std::span<gpu::ColumnTerms> terms) {
    assert(terms.size() >= east_deg.size());
    std::array<int, at_a_time> unsure;
    for (std::size_t first = 0; first < east_deg.size(); first += at_a_time) {
        const std::size_t count = std::min(at_a_time, east_deg.size() - first);
        const std::span some = east_deg.subspan(first, count);
        const bool all_near = std::ranges::all_of(
            some, [](double from_eye_deg) { return std::abs(from_eye_deg) <= short_series_up_to_deg; });
        const auto terms_of = all_near ? terms_by_short_series : terms_by_series;
        if (terms_of(some.data(), count, &terms[first], unsure.data()) == 0) continue;
        for (std::size_t i = 0; i < count; ++i)
            if (unsure[i] != 0) terms[first + i] = column_terms(east_deg[first + i]);
    }
}

}  // namespace oro

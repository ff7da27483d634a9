// Chebyshev polynomials, which nets are sums of.
#pragma once

#include <cstddef>

namespace oro {

// Chebyshev polynomials at x in -1 .. 1, and their derivatives.
template <class Terms>
void chebyshev(double x, Terms& value) {
    value[0] = 1.0;
    value[1] = x;
    for (std::size_t i = 2; i < value.size(); ++i) value[i] = 2.0 * x * value[i - 1] - value[i - 2];
}
template <class Terms>
void chebyshev(double x, Terms& value, Terms& slope) {
    chebyshev(x, value);
    slope[0] = 0.0;
    slope[1] = 1.0;
    for (std::size_t i = 2; i < value.size(); ++i)
        slope[i] = 2.0 * value[i - 1] + 2.0 * x * slope[i - 1] - slope[i - 2];
}

}  // namespace oro

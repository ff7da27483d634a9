// A curve through given values that rises and falls only where these do.
#pragma once

#include <vector>

namespace oro {

// A cubic between each two neighbouring values, with one tangent where two meet. Between two neighbours it is
// never outside of them, and it rests where they are equal.
// Source: F. N. Fritsch, J. Butland, A method for constructing local monotone piecewise cubic interpolants,
// SIAM J. Sci. Stat. Comput. 5 (1984), 300-304; at the ends the three-point rule of PCHIP (D. Kahaner,
// C. Moler, S. Nash, Numerical Methods and Software, 1989, section 4.8).
class MonotoneCubic {
  public:
    MonotoneCubic() = default;
    // x ascends strictly; as many y as x, one or more.
    MonotoneCubic(std::vector<double> x, std::vector<double> y);
    // The value at x, which is held to the first and the last one. At a given x it is the given y, to the
    // bit.
    [[nodiscard]] double at(double x) const;

  private:
    std::vector<double> x_, y_, slope_;
};

}  // namespace oro

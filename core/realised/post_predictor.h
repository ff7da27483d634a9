// The best linear guess of a post's true height from the posts around it, which have errors.
#pragma once

#include <span>
#include <vector>

#include "core/realised/noise_structure.h"

namespace oro {

// Posts that a guess is made from: 13 x 13 around it.
inline constexpr int predictor_reach = 6;
inline constexpr int predictor_side = 2 * predictor_reach + 1;

// Weights of the posts around one, row by row from the north-west, that sum to 1 and leave the least mean
// square error: ordinary kriging of a signal under correlated noise. `terrain` is the ground's structure, of
// which differences alone count, `errors` that of the data's errors; posts lie so far apart along a column
// and along a row. Of `finer` x `finer` places, row by row: that of the post itself, and those that cut the
// way to the next posts (south and east) in so many pieces. Empty where the equations have no solution.
// Source: N. Cressie, Statistics for Spatial Data, 1993, section 3.2 (filtering of noise by kriging).
std::vector<std::vector<float>> predictor_weights(std::span<const NoiseBand> terrain,
                                                  std::span<const NoiseBand> errors, double row_spacing_m,
                                                  double column_spacing_m, int finer);

}  // namespace oro

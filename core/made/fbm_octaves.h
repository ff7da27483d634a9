// Sums of octaves of made terrain at many places at once, as fast as the processor can.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/made/made_rule.h"

namespace oro {

// Adds what an octave of fbm adds at so many places in 2^-6 m of ECEF to their sums, 2^-13 m. count: a
// multiple of 16.
using AddOctave = void (*)(const gpu::MadeOctave& octave, const std::int32_t* x, const std::int32_t* y,
                           const std::int32_t* z, std::int32_t* sums, std::size_t count);

// By instructions for eight or sixteen numbers at once, with the same bits as made_fbm_octave() of
// shaders/made/made_heights.glsl; null where this processor, or the compiler, has none.
AddOctave octaves_by_eight();
AddOctave octaves_by_sixteen();

// The same of ridged. weights: of each place, 2^-28, 1 before the first octave.
using AddRidgedOctave = void (*)(const gpu::MadeOctave& octave, const std::int32_t* x, const std::int32_t* y,
                                 const std::int32_t* z, std::int32_t* sums, std::int32_t* weights,
                                 std::size_t count);
AddRidgedOctave ridged_octaves_by_eight();
AddRidgedOctave ridged_octaves_by_sixteen();

}  // namespace oro

// Functions that go through many numbers alike: compiled once more for processors that take four at a time.
#pragma once

#include <cstdint>

// Put before such a function; the program takes what the processor has when it begins. The same bits come of
// both, for nothing is contracted or summed in another order. Not under sanitizers, which begin later.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ORO_WIDE __attribute__((target_clones("avx2", "default")))
// ... and once more for those that take sixteen whole numbers at a time: for long work on whole numbers
// alone.
#define ORO_WIDE_16 __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ORO_WIDE
#define ORO_WIDE_16
#endif

namespace oro {

using FourDoubles = double __attribute__((vector_size(32)));
using FourSteps = std::int32_t __attribute__((vector_size(16)));

}  // namespace oro

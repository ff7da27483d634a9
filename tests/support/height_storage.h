// How the GPU keeps heights where a test does not say itself: f32, or what OROGRAPH_TEST_HEIGHTS names (f32,
// packed).
#pragma once

#include <cstdlib>
#include <string_view>

#include "core/frame/height_quantization.h"

namespace oro::test {

inline HeightStorage asked_heights() {
    const char* const wanted = std::getenv("OROGRAPH_TEST_HEIGHTS");
    return wanted != nullptr && std::string_view(wanted) == "packed" ? HeightStorage::packed
                                                                     : HeightStorage::f32;
}

}  // namespace oro::test

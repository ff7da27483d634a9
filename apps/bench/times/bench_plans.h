// Plans that the device makes a part of, beside those that the processor makes alone.
#pragma once

#include <span>

#include "apps/bench/times/bench_flights.h"
#include "apps/bench/times/bench_options.h"
#include "core/base/result.h"
#include "render/device/gpu.h"

namespace oro {

// Draws all eyes of flights by both, by one way of drawing, once all that they want is there, and prints how
// many pixels show another triangle and another colour. Errors: the device, the file; a device without doubles.
Result<void> compare_plans(const Gpu& gpu, RasterPath path, std::span<const RandomFlight> flights,
                           const BenchOptions& options);

}  // namespace oro

// Whole frames of an eye in motion, as a window draws them: what a person waits for.
#pragma once

#include "apps/bench/times/bench_options.h"
#include "core/base/result.h"
#include "render/device/gpu.h"

namespace oro {

// Flies random flights over a region file by each way of drawing that is asked for, and prints a table or
// JSON. Each frame takes the report of the one before the last, lets what is missing come, plans what is
// there, and submits it: a window's loop without a window. Errors: the device, the file, options that do not
// fit.
Result<void> run_moving(const Gpu& gpu, BenchOptions options);

}  // namespace oro

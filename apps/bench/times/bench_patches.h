// Made terrain by patches of fixed size and by levels, timed apart: --fixed-patches.
#pragma once

#include "apps/bench/times/bench_options.h"

namespace oro {

struct PatchBenchOptions {
    BenchOptions bench;  // frames, warm-up, size, tau, JSON
    int most{640};       // patches along a side of the largest square
};

// Prints for squares of 64, 128, 256, 512 and 640 patches along a side, up to the most, or for the most alone
// where it is below 64: milliseconds of noise, choice and drawing, medians, of patches with 2, 3, 5 and 9
// posts a side and of those chosen by distance, by each way that the device can; then of the levels over the
// same posts. Errors: the device; posts that are not those of the processor.
Result<void> print_patches(const Gpu& gpu, const PatchBenchOptions& options);

}  // namespace oro

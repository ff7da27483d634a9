// Posts of made terrain on the GPU: the same bits as on the CPU, and how long a page takes: --made.
#pragma once

#include "core/base/result.h"
#include "render/device/gpu.h"

namespace oro {

struct MadeBenchOptions {
    int side{3163};  // posts along each side of each kind: together some 10^7
    int frames{30};
    bool json{false};
};

// Prints for each kind of made terrain how many posts differ between GPU and CPU, and microseconds a page of
// 131 x 131 posts takes on the GPU: alone, one of 64 in one submission, and on one core of the CPU. Errors:
// the device; posts that differ.
Result<void> print_made(const Gpu& gpu, const MadeBenchOptions& options);

}  // namespace oro

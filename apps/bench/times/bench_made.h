// Posts of made terrain on the GPU: the same bits as on the CPU, and how long a page takes: --made.
#pragma once

#include "core/base/result.h"
#include "core/made/made_terrain.h"
#include "render/device/gpu.h"

namespace oro {

struct MadeBenchOptions {
    int side{3163};  // posts along each side of each kind: together some 10^7
    int frames{30};
    bool json{false};
};

// Terrain of a kind with so many posts along each side, a second of arc apart from 46 N 8 E, -200 to 4000 m
// high.
MadeTerrain bench_terrain(MadeKind kind, int side);

// Prints for each kind of made terrain how many posts differ between GPU and CPU, and microseconds a page of
// 131 x 131 posts takes on the GPU: alone, one of 64 in one submission, and on one core of the CPU. Errors:
// the device; posts that differ.
Result<void> print_made(const Gpu& gpu, const MadeBenchOptions& options);

}  // namespace oro

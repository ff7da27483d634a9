// Pages of made terrain in frames: made by the GPU where it keeps them, against made by the CPU and sent:
// --made-pages.
#pragma once

#include "core/base/result.h"
#include "render/device/gpu.h"

namespace oro {

struct MadePagesBenchOptions {
    int side{3601};  // posts along each side of the terrain in memory
    int frames{30};  // loads of all its pages; pictures of a world: a sixth of these, at least 3
    int width_px{640};
    int height_px{360};  // of these pictures
    double tau_px{1.0};
    RasterPath path{};
    bool json{false};
};

// Prints medians, by both ways: microseconds of the GPU for the heights of a page, alone and one of 64; of
// the clock for each page of a terrain in memory, loaded into a scene's store with all threads, and bytes
// sent for it; seconds from nothing to the first picture of a world of 5.6 x 10^11 posts. Errors: the device;
// pages that differ between both ways.
Result<void> print_made_pages(const Gpu& gpu, double device_s, const MadePagesBenchOptions& options);

}  // namespace oro

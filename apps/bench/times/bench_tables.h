// The tables of the slides on micro-mesh rasterisation, over terrain: what level of detail and occlusion
// leave of the triangles, what heights in fewer bits take, and mesh shaders against compute by the size of
// triangles.
#pragma once

#include "apps/bench/times/bench_options.h"
#include "core/base/result.h"
#include "render/device/gpu.h"

namespace oro {

// Prints them as Markdown, for each eye of the path and both ways of drawing.
Result<void> print_tables(const Gpu& gpu, BenchOptions options);

}  // namespace oro

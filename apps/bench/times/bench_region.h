// What a benchmark draws: a region file or terrain by a formula, and from where.
#pragma once

#include <memory>
#include <vector>

#include "apps/bench/bench_path.h"
#include "apps/bench/times/bench_options.h"
#include "core/baked/baked_file.h"
#include "core/earth/camera.h"
#include "core/frame/region_pages.h"
#include "core/terrain/post_grid.h"
#include "render/scene/scene.h"

namespace oro {

// A region file, or one that is made.
struct BenchRegion {
    HeightField made;
    BakedGrid file;
    std::unique_ptr<RegionPages> pages;
};
Result<BenchRegion> open_bench_region(const BenchOptions& options);
// Takes the region's pages. Half of the GPU's memory is for clusters, where there are some.
Result<Scene> scene_of(const Gpu& gpu, const BenchOptions& options, BenchRegion& region);
Result<std::vector<BenchEye>> eyes_of(const BenchOptions& options, const BenchRegion& region);

// Hills on all scales down to the post spacing, 0 to some 1,500 m: a square of so many meshlets along each
// side. The same on every machine up to the last digits of sine.
HeightField made_region(int patches);

// An eye straight above the middle, from where the whole square just fits.
Camera eye_above(const HeightField& field, int width_px, int height_px);

}  // namespace oro

// A region as a scene, as commands make it.
#pragma once

#include <utility>

#include "apps/drawing/region_scene.h"
#include "geo/together/cut_regions.h"

namespace oro::test {

inline Result<Scene> create_scene(const Gpu& gpu, const Region& region, const SceneRequest& request = {}) {
    ORO_TRY(const RegionCuts cuts, cut_regions(region));
    ORO_TRY(GridPages pages, make_grid_pages(region, cuts, request.exaggeration));
    ORO_TRY(RegionScene whole, scene_of_region(gpu, region, cuts, std::move(pages), request));
    return std::move(whole.scene);
}

}  // namespace oro::test

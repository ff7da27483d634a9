// How far what is drawn at a place may be from the full resolution, place by place, without planning a frame.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/frame/region_pages.h"
#include "core/lod/levels.h"

namespace oro {

// Asks the pages' nodes as a frame does (shaders/choose/levels.glsl). Keeps the pages that it has asked for.
class SampledDetail {
  public:
    // pages outlives it. light: as the frame bends it.
    SampledDetail(const RegionPages& pages, const Camera& camera, double tau_px, const Refraction& light = {});
    ~SampledDetail();

    // Bounds of the node that is drawn over a cell of the region, and of coarser ones beside it, whose edges
    // it takes on; 0 at full resolution.
    struct Bound {
        int level{};
        double error_m{};
        double error_px{};
    };
    // Errors: a page that cannot be read.
    Result<Bound> at(int row, int column);

  private:
    struct Page;
    Result<const Page*> page(const PageIndex& index);
    Result<Bound> node_at(int row, int column);

    const RegionPages& pages_;
    LevelView view_;
    glm::dmat3 view_from_ecef_;
    Ecef eye_;
    Refraction light_;
    std::map<std::tuple<int, int, int>, std::unique_ptr<Page>> kept_;
};

}  // namespace oro

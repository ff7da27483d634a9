// Which ground a picture cannot show, by where that ground is at most, and where it need not be finer.
#pragma once

#include <array>

#include "core/earth/camera.h"
#include "core/earth/culling.h"
#include "core/frame/model_view.h"
#include "core/frame/region_pages.h"
#include "core/lod/levels.h"

namespace oro {

struct FrameView;  // core/frame/frame_plan.h

// Conservative: what it drops cannot be in the picture, wherever in a pixel is sampled.
// Heights that the GPU rounds may lie up to a metre outside a bound.
class PictureCulling {
  public:
    // occluder: of the ground's region.
    PictureCulling(const FrameView& view, const HorizonOccluder& occluder);

    // Any thread.
    [[nodiscard]] bool may_show(const PageBound& bound) const;
    // Whether what is so far from the truth is no more than tau pixels from it wherever in a sphere it is
    // seen, whoever computes it. Any thread.
    [[nodiscard]] bool keeps_tau(const PageBound& bound, double error_m) const;
    // Whether what is at least so far from the truth is more than tau pixels from it wherever in a sphere it
    // is seen, whoever computes it. Any thread.
    [[nodiscard]] bool fails_tau(const PageBound& bound, double error_m) const;

  private:
    ModelView model_;
    LevelView level_;
    std::array<Plane, 5> planes_;
    SeenHorizon horizon_;
};

}  // namespace oro

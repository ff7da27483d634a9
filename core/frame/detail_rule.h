// Whether what a page has may stand, for an eye, for what is finer.
#pragma once

#include <cmath>

#include "core/frame/model_view.h"
#include "core/lod/levels.h"
#include "core/lod/pyramid.h"

namespace oro {

// The rule of one picture, asked of whole quarters of pages.
class DetailRule {
  public:
    DetailRule(const LevelView& view, double post_spacing_m, double shading_spacing_px)
        : view_(view),
          post_spacing_m_(post_spacing_m),
          shading_spacing_px_(shading_spacing_px),
          corner_stretch_(std::sqrt(1.0 + static_cast<double>(view.corner_tangent) *
                                              static_cast<double>(view.corner_tangent))) {}

    // Whether a quarter's nodes are near enough to the full resolution all over the sphere in which they are
    // seen: the answer of gpu::projected_error_px() and tau. distance_m: of the sphere's middle from the eye.
    // stretch: what lengths in it are at most multiplied by.
    [[nodiscard]] bool good_enough(const PageQuarter& quarter, const ViewSphere& seen, double distance_m,
                                   double stretch) const;
    // Are the posts of a level close enough on the screen, all over a sphere, to shade slopes from?
    [[nodiscard]] bool fine_enough_to_shade(int level, const ViewSphere& seen, double distance_m) const {
        return std::ldexp(post_spacing_m_, level) * static_cast<double>(view_.pixels_per_tangent) <=
               shading_spacing_px_ * (distance_m - seen.radius_m);
    }

  private:
    LevelView view_;
    double post_spacing_m_;  // of level 0, along the meridian
    double shading_spacing_px_;
    double corner_stretch_;
};

}  // namespace oro

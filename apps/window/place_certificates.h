// How exactly a window's picture shows single places.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "apps/view/view.h"
#include "core/frame/sampled_detail.h"
#include "render/scene/scene.h"

namespace oro {

// Asks the certificates of the levels that a view is drawn with (docs/CERTIFICATE.md), place by place, and
// keeps what it has read of them for the next place of the same view. One thread.
class PlaceCertificates {
  public:
    // The bound at a place (degrees) of one of the scene's grids, drawn as the view asks: in metres in space,
    // and in pixels of the view's picture; 0 at full resolution. Nothing where the grid is drawn by clusters,
    // whose bound is tau. The scene stays until forget(). Errors: a page that cannot be read.
    Result<std::optional<SampledDetail::Bound>> at(const Scene& scene, std::size_t grid, double lat_deg,
                                                   double lon_deg, const View& view);
    // To be called before a scene goes.
    void forget() { details_.clear(); }

  private:
    Camera camera_;  // of all of them
    double tau_px_{};
    Air air_;
    std::vector<std::unique_ptr<SampledDetail>> details_;  // one of each grid, made when it is asked
};

}  // namespace oro

// What a view's picture is measured against.
#pragma once

#include <memory>
#include <string>

#include "apps/view/view.h"
#include "core/truth/oracle.h"
#include "core/truth/true_ground.h"
#include "geo/together/region_ground.h"

namespace oro {

// A view's camera with the eye where it really is: a view without a geoid has its eye as high above the geoid
// as it says, and so N higher above the ellipsoid.
Camera true_camera(const View& view, const Region& region);
// From there, through the view's own air.
Sight true_sight(const View& view, const Region& region);

// How light goes in it: "Light: k 0.13 at all heights.\n"
std::string light_line(const View& view, const Region& region);

// The full-resolution ground that a view really looks at: on WGS84, lifted by the geoid, exaggerated as the
// view is. Holds on to the region.
class TrueScene {
  public:
    // cuts: cut_regions(region). Every post of a baked region is read into memory. Errors: damage in it.
    static Result<std::unique_ptr<TrueScene>> of(const View& view, const Region& region,
                                                 const RegionCuts& cuts);
    // The true scene of grids that it cuts itself. Errors: those of cut_regions(), too.
    static Result<std::unique_ptr<TrueScene>> of(const View& view, const Region& region);
    TrueScene(const TrueScene&) = delete;
    TrueScene& operator=(const TrueScene&) = delete;

    [[nodiscard]] const TrueGround& ground() const { return ground_->ground(); }
    [[nodiscard]] const Sight& sight() const { return sight_; }

  private:
    TrueScene() = default;
    std::unique_ptr<const RegionGround> ground_;
    Sight sight_;
};

}  // namespace oro

// How the eye of a window goes to places, and back.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/earth/camera.h"
#include "core/terrain/summit.h"
#include "geo/places/place.h"
#include "geo/region/region.h"

namespace oro {

// The roll that a user asked for, of the camera that a window begins with: what the option says, or what a
// view has. In a view from far above the roll may be a part of how framing turned it
// (core/earth/place_framing.h).
double users_roll_deg(const Camera& camera, const std::optional<double>& option_deg);

class Jumps {
  public:
    // roll_deg: the user's own, of all pictures that jumps make; whatever roll framing gave to a camera.
    explicit Jumps(double roll_deg = 0.0) : roll_deg_(roll_deg) {}

    // The camera that shows a place (apps/view/place_camera.h), from the side that the eye looked from when
    // it last moved by itself, where that sees it; a place with a height of its own is where the eye goes, or
    // over the ground there. typed: how errors call a cell; other places are
    // called by their latitude and longitude. Errors: no elevation data there, in words for people; the eye
    // stays then, and Enter stands on nothing.
    Result<Camera> to(const Camera& camera, const Place& place, const Region& region, double exaggeration,
                      const std::string& typed = "");
    // The camera of an eye that stands on the place that it went to last, 2 m over the ground, and looks to
    // the horizon; once more, on the highest post near. Nothing where it has moved
    // since (stay()), or stands there. Errors: likewise.
    Result<std::optional<Camera>> stand(const Camera& camera, const Region& region, double exaggeration);
    // Where stand() goes from the place that it stands on; nothing where no post near is higher.
    [[nodiscard]] const std::optional<MovedToSummit>& higher() const { return higher_; }
    // Told when the eye has moved by itself: Enter then stands on nothing, and the next jump starts from
    // where it looks.
    void moved();
    // Enter then stands on nothing.
    void stay();

  private:
    double roll_deg_;
    std::optional<Place> shown_;           // what the last jump shows
    std::optional<MovedToSummit> higher_;  // near what the eye stands on
    std::optional<double> heading_deg_;    // of the line of sight that jumps try first
};

}  // namespace oro

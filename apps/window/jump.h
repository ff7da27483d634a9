// How the eye of a window goes to places, and back.
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/earth/camera.h"
#include "geo/places/place.h"
#include "geo/region/region.h"

namespace oro {

class Jumps {
  public:
    // The camera that shows a place (apps/eye/place_camera.h), from the side that the eye looks from where
    // that sees it; a place with a height of its own is where the eye goes. Remembers the camera for back().
    // Errors: no elevation data there, in words for people; the eye stays then.
    Result<Camera> to(const Camera& camera, const Place& place, const Region& region, double exaggeration);
    // The camera of an eye that stands on the place that it went to last, 2 m over the ground, and looks to
    // the horizon. Remembers the camera, too. Nothing where it has moved since (moved()), or stands there.
    // Errors: likewise.
    Result<std::optional<Camera>> stand(const Camera& camera, const Region& region, double exaggeration);
    // The eye and the attitude from before the last jump, to the last bit, in a picture of the same size as
    // `camera` has; nothing where there was none.
    std::optional<Camera> back(const Camera& camera);
    // Told when the eye has moved by itself: Enter then stands on nothing.
    void moved() { shown_.reset(); }

  private:
    std::vector<Camera> before_;
    std::optional<Place> shown_;  // what the last jump shows
};

}  // namespace oro

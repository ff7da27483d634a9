// A scene that will take the place of the one that is shown.
#pragma once

#include "core/base/elapsed.h"
#include "core/base/result.h"
#include "core/frame/frame_plan.h"
#include "render/scene/scene.h"

namespace oro {

bool lacks_clusters(const FramePlan& plan);

// Whether it has all that a plan of it needs, or all of that which fits on the GPU; where it has not, asks
// for what is missing, and is to be asked again with the next plan. since: when it was begun. Errors: those
// of Scene::advance().
Result<bool> has_what_fits(Scene& scene, const FramePlan& plan, Clock::time_point since);

}  // namespace oro

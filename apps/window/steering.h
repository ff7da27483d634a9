// What a window's user asks of the eye.
#pragma once

#include "apps/navigation/flight_step.h"
#include "render/window.h"

namespace oro {

// The step that the keys held down, and the mouse, ask for.
FlightStep step_of(const WindowInput& input, const Camera& camera);
// Whether a step goes anywhere.
bool moves(const FlightStep& step);

}  // namespace oro

#include "apps/window/steering.h"

#include <algorithm>

namespace oro {

FlightStep step_of(const WindowInput& input, const Camera& camera) {
    const auto axis = [&](Key plus, Key minus) {
        return (input.is_held(plus) ? 1.0 : 0.0) - (input.is_held(minus) ? 1.0 : 0.0);
    };
    FlightStep step;
    step.forward = axis(Key::forward, Key::back);
    step.right = axis(Key::right, Key::left);
    step.up = axis(Key::up, Key::down);
    step.fast = input.is_held(Key::fast);
    step.elapsed_s = std::min(input.elapsed_s, 0.25);  // a slow frame must not become a leap
    const double turn_deg_s = camera.vertical_fov_deg;
    const double deg_per_px = camera.vertical_fov_deg / camera.height_px;
    // Dragging takes hold of the scene: it follows the cursor.
    step.turn_right_deg =
        axis(Key::look_right, Key::look_left) * turn_deg_s * step.elapsed_s - input.dragged_px.x * deg_per_px;
    step.turn_up_deg =
        axis(Key::look_up, Key::look_down) * turn_deg_s * step.elapsed_s + input.dragged_px.y * deg_per_px;
    return step;
}

bool moves(const FlightStep& step) {
    return step.forward != 0.0 || step.right != 0.0 || step.up != 0.0 || step.turn_right_deg != 0.0 ||
           step.turn_up_deg != 0.0;
}

}  // namespace oro

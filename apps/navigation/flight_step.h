// How keys move the eye step by step: pure computation on the eye and the ground, tested without a window.
#pragma once

#include "core/earth/camera.h"
#include "core/earth/place_framing.h"
#include "core/terrain/post_grid.h"

namespace oro {

inline constexpr double eye_clearance_m = 1.7;  // the least height over the ground: a person's eye

// What the user asks of the eye in one step: each -1, 0 or 1, or a part of it.
struct FlightStep {
    double forward{};
    double right{};
    double up{};
    bool fast{false};
    double turn_right_deg{};
    double turn_up_deg{};
    double elapsed_s{};
};

// Metres per second over a ground that is this far below: the height itself up to 2 km, and 0.4 of what is
// above that, so that what is in the middle of a view from high up stays in the picture for some seconds.
// Within 5 m/s and 5,000 km/s.
double flight_speed_m_s(double above_ground_m);

// The camera after a step: moved along its heading over the ellipsoid (level flight, whatever the pitch),
// turned, and lifted where it would be lower than eye_clearance_m over the ground. Pitch stays within +-90.
Camera flown(const Camera& camera, const FlightStep& step, const GroundHeightAt& ground_h_m);
// The same over one grid, its heights exaggerated.
Camera flown(const Camera& camera, const FlightStep& step, const HeightField& field, double exaggeration);

// The camera after a step of someone who walks: as flown(), but at 5 m/s (25 m/s where the step is fast), and
// eye_clearance_m over the ground, uphill and downhill. Its `up` does nothing. Where there is no data the eye
// keeps its height.
Camera walked(const Camera& camera, const FlightStep& step, const GroundHeightAt& ground_h_m);

// The camera that looks elsewhere from where it is. Pitch stays within +-90.
Camera turned(const Camera& camera, double right_deg, double up_deg);

// The camera lifted over the ground where it is too low; unchanged where there is no data.
Camera above_ground(const Camera& camera, const GroundHeightAt& ground_h_m);
// The same over one grid, its heights exaggerated.
Camera above_ground(const Camera& camera, const HeightField& field, double exaggeration);

}  // namespace oro

// From a track on a map to the keys of a camera that flies along it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/commands/sight/line_along.h"
#include "apps/film/camera_path.h"
#include "apps/options/options.h"
#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

// How a camera follows a track.
struct TrackFlight {
    double above_m{150.0};       // over the ground, which is evened out as the track is
    double smoothing_m{200.0};   // so much of the track a place is the mean of
    double look_ahead_m{500.0};  // it looks at the ground of the track, so far ahead
    double duration_s{60.0};     // for all of it, at an even speed
    double vertical_fov_deg{45.0};
};

// What options ask for along a track of that length. Errors (usage): text that is no distance, numbers out of
// range, both of --duration and --speed.
Result<TrackFlight> track_flight(const FilmOptions& options, double length_m);
// The first option given that is for tracks alone; null: none.
const char* first_track_option(const FilmOptions& options);

// The keys along a track, every few metres, all heights above the ellipsoid; the eye is nowhere lower over
// the ground of a key than half of above_m. Beyond the track's end the look ahead goes straight on. Where the
// ground has no height that of the track's places near it stands in. Errors: no elevation data anywhere along
// the track (no_data); data that cannot be read.
Result<std::vector<CameraKey>> keys_along_track(const LineAlong& track, const TrackFlight& flight,
                                                const Region& region, double exaggeration);

}  // namespace oro

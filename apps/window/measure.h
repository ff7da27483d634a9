// What a window measures between places that its user clicks at: by the code of the commands sight and
// profile.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/commands/sight/look_along.h"
#include "apps/commands/sight/profile_text.h"
#include "core/truth/true_ground.h"
#include "geo/places/geodesic_area.h"

namespace oro {

// A line of places, and all that is known of it.
struct Measurement {
    std::vector<LatLon> places;
    std::optional<Profile> profile;    // of two or more places
    std::optional<SightReport> sight;  // from an eye 2 m over the first to the last, on the ground
    std::optional<GeodesicArea> area;  // of three or more
};

// Measures a line of places anew. Errors: posts that could not be read.
Result<Measurement> measured(const std::vector<LatLon>& places, const Air& air, const TrueGround& ground);

// Measures a line of a file, as `orograph profile --along FILE --line NUMBER` does. Errors: those of
// line_along(); posts that could not be read.
Result<Measurement> measured_line(const std::string& file, int number, const Air& air,
                                  const TrueGround& ground);

// What `orograph profile` takes for this line: "46.570000000,7.990000000; 46.620000000,8.050000000".
std::string along_text(const std::vector<LatLon>& places);

}  // namespace oro

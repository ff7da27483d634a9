// Tours of KML: where a camera flies, view by view.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// What a camera of KML sees from: its own place (Camera), or one that it looks at from a distance (LookAt).
struct TourView {
    bool looks_at{};
    double lat_deg{};
    double lon_deg{};
    double height_m{};
    HeightAbove heights{HeightAbove::ground};  // `ground` with 0 m of clampToGround
    double heading_deg{};
    double tilt_deg{};  // 0 straight down, 90 level
    double roll_deg{};
    double range_m{};  // of a LookAt: the eye's distance
    std::optional<std::int64_t> time_utc_s{};
};

// A view, and how long it takes from the one before it to it.
struct TourStop {
    double duration_s{};
    TourView view;
};

// The first gx:Tour of a KML file: a stop for each gx:FlyTo with a view, and one more with the same view for
// each gx:Wait. All else of a tour (sounds, updates, pauses) has no part in it. Empty where the file has no
// tour. Errors: a file that cannot be read or is no XML; numbers that are none or out of range, with the
// line; more than 1,000,000 stops. Source: OGC KML 2.3 (12-007r2), AbstractTourPrimitive; Google's KML
// reference, gx:Tour.
Result<std::vector<TourStop>> read_kml_tour(const std::string& file);

}  // namespace oro

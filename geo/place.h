// Places as people write them.
#pragma once

#include <optional>
#include <string>

#include "core/result.h"

namespace oro {

struct Place {
    double lat_deg{};  // [-90, 90]
    double lon_deg{};  // (-180, 180]
    std::optional<double> height_m;  // geo:lat,lon,height only
    std::string form;  // "degrees", "DMS", "UTM/UPS", "MGRS", "geohash", "geo URI", "tile cell"
};

// One parser for every option that takes a place: a tile name N46E008 (the cell's centre), "46.5763,7.9904" (lat lon),
// DMS ("46d34'35\"N 7d59'25\"E", "46°34'35″N 7°59'25″E"), UTM/UPS ("32T 422000 5158000", "32N 422000 5158000"),
// MGRS ("32TMS2200058000": the square's centre), geohash ("u0m6"), "geo:46.57,7.99" (RFC 5870). Usage errors name the text and what is wrong;
// a latitude beyond 90 with a longitude within gets the hint that the two may be swapped.
Result<Place> parse_place(const std::string& text);

}  // namespace oro

// Places as people write them.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"

namespace oro {

// A part of the ground that one place stands for, in degrees; or the box around it. east may be beyond 180.
struct PlaceCell {
    double south_deg{};
    double west_deg{};
    double north_deg{};
    double east_deg{};
};

struct Place {
    double lat_deg{};  // [-90, 90], WGS 84
    double lon_deg{};  // (-180, 180]
    // geo:lat,lon,height only, as written: RFC 5870 leaves open what it is above.
    std::optional<double> height_m;
    std::string form;  // "degrees", "DMS", "UTM/UPS", "MGRS", "geohash", "geo URI", "tile cell"
    // What a tile's cell, an MGRS square or a geohash covers; nothing for the others, which are points.
    std::optional<PlaceCell> cell{};
};

// One parser for every option that takes a place:
//
// - N46E008: the tile's cell, whose centre is the place; either case. With a space, "N46 E008" is a point.
// - 46.5763,7.9904: latitude, longitude; a space or both instead of the comma; no decimal commas.
// - 46d34'35"N 7d59'25"E, 46°34′35″N, 46:34:35, N46d34.6', 46N 8E: letters may put the longitude first.
// - 32T 422000 5158000: UTM with a band or, N and S, a hemisphere (32N, 32north). S with a northing that fits
// the
//   band S too is refused: write 32south or 32north. UPS has N, S, A, B, Y or Z for a zone.
// - 32TMS2200058000: MGRS in capitals, also in groups; the square's centre.
// - u0m6: geohash in small letters with a digit among them, any other as geohash:gbsuv; the cell's centre.
// - geo:46.57,7.99,1034: RFC 5870 in WGS 84.
//
// Longitudes are in [-180, 180]; -180 comes back as 180. What reads as MGRS and as a geohash (32tms22) is
// refused. Usage errors name the text and what is wrong; a latitude beyond 90 with a longitude within gets
// the hint that the two may be swapped. Names ("Eiger") are not looked up: the refusal of a text that may be
// one says `of_names` in brackets; a caller that looks names up passes words of its own, or none.
//
// Accuracy: the text's own, to 1e-9 degree (UTM and UPS: GeographicLib, 5 nm within its limits).
// Source: C. F. F. Karney, "Transverse Mercator with an accuracy of a few nanometers", J. Geodesy 85, 475-485
// (2011); A. Mayrhofer, C. Spanring, RFC 5870 (2010), section 3.3.
Result<Place> parse_place(const std::string& text, const std::string& of_names = "names are not looked up");

}  // namespace oro

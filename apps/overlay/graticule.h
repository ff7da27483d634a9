// The graticule of a picture: lines of even latitude and longitude, or of even easting and northing.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/overlay/seen_lines.h"
#include "geo/coordinates/crs_places.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// Which values of a coordinate a picture shows: all of them, and where nine tenths of its ground are.
struct CoordinateRange {
    double low{}, high{};
    double most_low{}, most_high{};
};
// Of the values at places that stand for a picture's ground, in any order; there is at least one.
CoordinateRange range_of(std::vector<double> values);

struct GraticuleLine {
    VectorShape shape;
    std::string label;  // "46°30'N", "E 2642000"
};

// How far lines are apart, in seconds of arc: 1, 2, 5, 10 or 30 seconds, minutes or degrees, or a 1, 2 or 5
// of a decimal part of a second; the least that leaves at most eight lines over nine tenths of the ground,
// and 40 over all of it, both of latitude and of longitude (degrees, longitudes without a jump).
double graticule_interval_s(const CoordinateRange& lat_deg, const CoordinateRange& lon_deg);
// The same of lengths: 1, 2 or 5 times a power of ten.
double graticule_interval(const CoordinateRange& x, const CoordinateRange& y);

// The parallels and meridians at whole multiples of an interval, as long as the picture's ground needs them.
std::vector<GraticuleLine> geographic_lines(const CoordinateRange& lat_deg, const CoordinateRange& lon_deg,
                                            double interval_s);
// The lines of even easting and even northing of a CRS, likewise, in 32 pieces that are even in latitude and
// longitude. Pieces that have no place in the CRS are left out.
std::vector<GraticuleLine> projected_lines(const CrsPlaces& crs, const CoordinateRange& x,
                                           const CoordinateRange& y, double interval);

// Where the label of a line stands, of the parts of it that are seen: its end that is nearest to the
// picture's border, moved so that a text of that size (half of it each way) is within the picture. Nothing
// where less than least_px of the line are seen.
std::optional<glm::dvec2> label_place(const std::vector<const SeenLine*>& parts, glm::dvec2 picture_px,
                                      glm::dvec2 half_text_px, double least_px);

}  // namespace oro

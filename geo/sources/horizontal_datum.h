// What a source's latitudes and longitudes refer to, and how well PROJ can turn them into WGS84's here.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/sources/source.h"
#include "geo/sources/source_report.h"

namespace oro {

// The datum of a horizontal CRS (WKT) at a place: x and y there, longitude (or east) first. `unwrapped`: the
// box that the operation is for, degrees of WGS84. Without coordinate_epoch, which a CRS does not hold.
HorizontalDatum horizontal_datum(const std::string& crs_wkt, double x, double y,
                                 const BoundingBox& unwrapped);

// The operation by which posts near that place are put on WGS84, as PROJ writes it, axes in the CRS's own
// order; "" where PROJ lists none. Near other places PROJ may take another.
std::string pipeline_at(const std::string& crs_wkt, double x, double y, const BoundingBox& unwrapped);

// Puts the horizontal datum of each source into its report, and what a user must know of it into the notes.
// Errors, with strict: a source whose datum PROJ knows no way from, or for which it lacks a grid that it
// would be more accurate with.
Result<void> find_horizontal_datums(std::span<Source> sources, bool strict, std::vector<std::string>& notes);

}  // namespace oro

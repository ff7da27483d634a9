// What a request says of files that do not say it themselves.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "geo/datum/vertical_datum.h"
#include "geo/sources/region_request.h"
#include "geo/sources/source.h"

namespace oro {

struct SourceOverrides {
    std::string height_unit;   // overrides what they say; "" for nothing
    std::string crs;           // of those that state none; "" for nothing
    std::string vertical_crs;  // what heights refer to, of those that do not say; "" for nothing
    StatedDatum vertical;      // likewise

    // Puts what its heights refer to into a source that does not say it, where that was specified, or else
    // where the file's name is one of a known product.
    StatedDatum heights_of(Source& source) const;
};

// Errors (usage): a CRS that PROJ does not know; one that places nothing on the Earth; one without heights.
Result<SourceOverrides> source_overrides(const RegionRequest& request);
// What is wrong with a specified CRS and with a vertical one, for people; nothing where all is well, or none
// is specified.
std::optional<std::string> fault_of_source_crs(const std::string& crs);
std::optional<std::string> fault_of_source_vertical(const std::string& crs);

// Why a file without a CRS cannot be placed, and what helps. local: the name of one that is tied to no place;
// "" for none. `cell` is GDAL's map from posts to coordinates.
std::string without_crs(const std::string& local, const std::optional<std::array<double, 6>>& cell,
                        int columns, int rows);

}  // namespace oro

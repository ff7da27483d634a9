// The coordinate reference system that a user asks a vector file to be read in.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "geo/vectors/vector_file.h"

namespace oro {

struct VectorCrs {
    std::string crs;               // as PROJ takes it, in the place of what the file states; "": that one
    std::optional<double> unit_m;  // metres of the coordinates' unit; nothing: that of the CRS
    bool operator==(const VectorCrs&) const = default;
};

// read_vectors() with the CRS and the unit that are asked; a shapefile then needs no .prj. The unit counts
// for projected CRSs, and a note tells it where it is not that of the CRS. Heights of places are read as by
// the CRS that is asked. Errors as there, and: a CRS that is not WGS84 in its horizontal part for GPX and
// KML, which always are in that.
Result<VectorFile> read_vectors_in(const std::string& file, const VectorCrs& asked, double limit_s = 30.0);

}  // namespace oro

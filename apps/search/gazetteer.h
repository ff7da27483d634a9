// Gazetteers: files with the names of many places.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/search/search_place.h"
#include "core/base/result.h"
#include "geo/places/bounding_box.h"
#include "geo/vectors/vector_file.h"

namespace oro {

struct Gazetteer {
    std::vector<SearchPlace> places;
    std::vector<std::string>
        notes;  // what the user must know, one line each: lines that were left out, and why
};

// At most so many places of one file are kept: some 200 MB.
inline constexpr std::size_t most_gazetteer_places = 2'000'000;

// Reads a gazetteer, told by its content:
//
// - a dump of GeoNames (geonames.org/export): lines of 19 fields with tabs between them, without a heading;
// - a table (geo/vectors/csv_records.h), whose first line names the columns: name; lat and lon, or what means
//   the same (geo/vectors/coordinate_columns.h), or y and x in degrees; and, if it has them, ele, elevation
//   or height, population, and class, type or natural;
// - points of GeoJSON, GPX, KML, GeoPackage, a shapefile or FlatGeobuf, whose fields have those names.
//
// within: places outside this box (of WGS84) are passed over; a dump of the whole Earth can be read so.
// Dumps are read line by line: memory is for the places that are kept. Lines that are none are left out, and
// notes tell how many, the number of the first and what is wrong with it; beyond most_gazetteer_places
// nothing more is read, and a note says so. stop: a table is read no further once it is asked for. Errors:
// those of CsvRecords; a file that is not there, that cannot be read, or in which no line has a place; a
// table without a column for names, latitudes or longitudes (with the file, and the line).
Result<Gazetteer> read_gazetteer(const std::string& path, const std::optional<BoundingBox>& within = {},
                                 const std::stop_token& stop = {});

// The named points of a vector file, in its order. A point is a summit where its field natural, class, type
// or sym says peak, volcano or summit, or where it has a prominence.
std::vector<SearchPlace> places_of(const VectorFile& file, const std::string& name_field = "name");

}  // namespace oro

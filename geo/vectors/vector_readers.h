// What reads vector files: GeoJSON, GPX and KML, which are text, here; databases by OGR (the vectors' half of
// GDAL).
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "geo/files/guarded_files.h"
#include "geo/vectors/json_text.h"
#include "geo/vectors/left_out.h"
#include "geo/vectors/vector_file.h"
#include "geo/vectors/vector_shapes.h"
#include "geo/vectors/xml_text.h"

namespace oro {

// Appends the layer of a file's text (UTF-8) to `file`; `name` is the layer's where the text has none. What
// cannot be drawn goes to `left_out`, with all its places. Errors (a reason, without the file's name): text
// that is no JSON, with the line; a CRS that is not known; too many places; the watch's time is spent.
Result<void> read_geojson(std::string_view text, const std::string& name, FileWatch& watch, VectorFile& file,
                          LeftOut& left_out);

// What turns a file's coordinates into WGS84's: by its member "crs", as GeoJSON had one before RFC 7946 (a
// name, or the number of an EPSG code), or WGS84 where there is none. Errors (a reason, without the file's
// name): a CRS that PROJ does not know, a link to one, which is not followed.
Result<ShapeSplitter> splitter_of_geojson(const JsonValue& root);

// Appends the layers waypoints, routes and tracks of a file to `file`, each with what its elements say of
// themselves as fields. What cannot be drawn goes to `left_out`, with all its places. Errors (a reason,
// without the file's name): too many places; the watch's time is spent.
Result<void> read_gpx(const XmlText& xml, std::string_view text, FileWatch& watch, VectorFile& file,
                      LeftOut& left_out);

// Appends a file's placemarks and overlays to `file`: a layer for each Document and Folder, `name` for those
// outside. Fields are the texts of the feature and its extended data. What cannot be drawn goes to
// `left_out`, with all its places. Errors (a reason, without the file's name): too many places; the watch's
// time is spent.
Result<void> read_kml(const XmlText& xml, const std::string& name, FileWatch& watch, VectorFile& file,
                      LeftOut& left_out);

// Does what start_gdal() does, and registers the driver of GeoPackages. From then on a query of SQLite ends
// when the time of the FileWatch of its thread is spent: a GeoPackage may hold queries that never end.
// To be called before each file: libraries may forget what SQLite is to do.
void start_vectors();

// GDAL's names of the formats that are databases, ending in a null.
const char* const* database_vector_drivers();
// All formats of vectors that this program reads, for people.
std::string trusted_vector_formats();

}  // namespace oro

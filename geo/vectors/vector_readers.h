// What reads vector files: GeoJSON, TopoJSON, GPX, KML and CSV, which are text, here; GeoPackages, shapefiles
// and FlatGeobuf by OGR (the vectors' half of GDAL).
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "geo/files/guarded_files.h"
#include "geo/files/raster_library.h"
#include "geo/vectors/json_text.h"
#include "geo/vectors/left_out.h"
#include "geo/vectors/vector_crs.h"
#include "geo/vectors/vector_file.h"
#include "geo/vectors/vector_shapes.h"
#include "geo/vectors/xml_text.h"

namespace oro {

// Appends the layer of a file's text (UTF-8) to `file`, or the layers of a TopoJSON; `name` is the layer's
// where the text has none. What cannot be drawn goes to `left_out`, with all its places. Errors (a reason,
// without the file's name): text that is no JSON, with the line; a CRS that is not known; too many places;
// the watch's time is spent.
Result<void> read_geojson(std::string_view text, const std::string& name, const VectorCrs& asked,
                          FileWatch& watch, VectorFile& file, LeftOut& left_out);

// Appends a layer for each object of a topology to `file`, with its arcs put together. `root` is the whole
// file. What cannot be drawn goes to `left_out`, with all its places, which are counted as often as a line or
// polygon has them; those of an arc that nothing names, once. Errors (a reason, without the file's name): a
// CRS that is not known; too many places; the watch's time is spent. Source: the TopoJSON Format
// Specification, version 1.
Result<void> read_topojson(const JsonValue& root, const VectorCrs& asked, FileWatch& watch, VectorFile& file,
                           LeftOut& left_out);

// Whether a text's first line names columns of coordinates, so that read_csv() takes it.
bool is_csv(std::string_view text);
// Appends the points of a table to `file`, or the geometries of its column WKT: a layer for each CRS that its
// column `crs` names. `crs`: that of the whole file (as PROJ takes one, WKT of a .prj, ...), or "". Degrees
// without one, and geometries without one, are WGS84's. What cannot be drawn goes to `left_out`, with all its
// places. Errors (a reason, without the file's name): those of CsvRecords; metres
// without a CRS; a CRS that is not known; too many places; the watch's time is spent.
Result<void> read_csv(std::string_view text, const std::string& name, const std::string& crs,
                      const VectorCrs& asked, FileWatch& watch, VectorFile& file, LeftOut& left_out);

// What turns coordinates, x or longitude first, of a CRS as PROJ takes one (EPSG:2056, a name, WKT) into
// WGS84's. Errors (a reason, without the file's name): one that PROJ does not know, or that is tied to no
// place on the Earth.
Result<ShapeSplitter> splitter_of_words(const std::string& words);

// What turns coordinates into WGS84's: by what is asked, and by what the file states (stated()) where no CRS
// is asked. Where coordinates are scaled by it, a note of `file` tells it, once. Errors: those of
// splitter_of_words(), and of stated().
Result<ShapeSplitter> splitter_as_asked(const VectorCrs& asked, VectorFile& file,
                                        const std::function<Result<ShapeSplitter>()>& stated);

// What turns a file's coordinates into WGS84's: by its member "crs", as GeoJSON had one before RFC 7946 (a
// name, or the number of an EPSG code), or WGS84 where there is none. Errors (a reason, without the file's
// name): a CRS that PROJ does not know, a link to one, which is not followed.
Result<ShapeSplitter> splitter_of_geojson(const JsonValue& root);

// Appends the layers waypoints, routes and tracks of a file to `file`, each with what its elements say of
// themselves as fields. What cannot be drawn goes to `left_out`, with all its places. Errors (a reason,
// without the file's name): too many places; the watch's time is spent.
Result<void> read_gpx(const XmlText& xml, std::string_view text, FileWatch& watch, VectorFile& file,
                      LeftOut& left_out);

// Takes where a network link leads (its href); true where that is read, too.
using KmlLinks = std::function<bool(const std::string& href)>;
// Appends a file's placemarks and overlays to `file`: a layer for each Document and Folder, `name` for those
// outside. Fields are the texts of the feature and its extended data. What cannot be drawn goes to
// `left_out`, with all its places, and so does each network link that `links` does not take, or all of them
// where it is none. Errors (a reason, without the file's name): too many places; the watch's time is spent.
Result<void> read_kml(const XmlText& xml, const std::string& name, const KmlLinks& links, FileWatch& watch,
                      VectorFile& file, LeftOut& left_out);

// Does what start_gdal() does, and registers the drivers of the formats below. From then on a query of SQLite
// ends when the time of the FileWatch of its thread is spent: a GeoPackage may hold queries that never end.
// To be called before each file: libraries may forget what SQLite is to do.
void start_vectors();

// Formats of vectors that OGR reads, whatever else this GDAL could.
enum class DatasetFormat { geopackage, shapefile, flatgeobuf };
// GDAL's name of a format's driver.
const char* dataset_driver(DatasetFormat format);
// Appends the layers of the dataset `name`, as GDAL opens it, to `file`. What cannot be drawn goes to
// `left_out`. `messages` are GDAL's from before the call. Errors (a reason, without the file's name): a file
// that the format's driver does not open, or cannot read to its end; a layer without a CRS, or with one that
// PROJ does not know; too many places; the watch's time is spent.
Result<void> read_dataset(const std::string& name, DatasetFormat format, const VectorCrs& asked,
                          FileWatch& watch, const GdalMessages& messages, VectorFile& file,
                          LeftOut& left_out);

// All formats of vectors that this program reads, for people.
std::string trusted_vector_formats();

}  // namespace oro

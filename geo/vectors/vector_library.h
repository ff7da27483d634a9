// The vector formats that OGR (the vectors' half of GDAL) reads for this program, and what keeps its
// databases within their time.
#pragma once

#include <string>

namespace oro {

// As start_gdal(), and registers the drivers of the four vector formats. From then on a query of SQLite ends
// when the time of the FileWatch of its thread is spent: a GeoPackage may hold queries that never end.
// To be called before each file: libraries may forget what SQLite is to do.
void start_vectors();

// GDAL's names of the formats that are text (GPX, KML, GeoJSON) and of the one that is a database, each
// ending in a null. All stop with an error where a file is cut.
const char* const* text_vector_drivers();
const char* const* database_vector_drivers();
// The same for people.
std::string trusted_vector_formats();

}  // namespace oro

// What OGR (the vectors' half of GDAL) reads for this program: databases, and what keeps them within their
// time. Formats of text are read here without it.
#pragma once

#include <string>

namespace oro {

// Does what start_gdal() does, and registers the driver of GeoPackages. From then on a query of SQLite ends
// when the time of the FileWatch of its thread is spent: a GeoPackage may hold queries that never end.
// To be called before each file: libraries may forget what SQLite is to do.
void start_vectors();

// GDAL's names of the formats that are databases, ending in a null.
const char* const* database_vector_drivers();
// All formats of vectors that this program reads, for people.
std::string trusted_vector_formats();

}  // namespace oro

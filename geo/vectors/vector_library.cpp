#include "geo/vectors/vector_readers.h"

#include <ogrsf_frmts.h>
#include <sqlite3.h>

#include "geo/files/guarded_files.h"
#include "geo/files/raster_library.h"

namespace oro {
namespace {

constexpr int steps_between_looks = 100'000;  // of SQLite's machine: some milliseconds

int stop_when_spent(void*) {
    FileWatch* const watch = FileWatch::innermost();
    return watch != nullptr && watch->spent() ? 1 : 0;
}

// SQLite calls it for each database that is opened from now on.
int watch_database(sqlite3* database, char**, const void*) {
    sqlite3_progress_handler(database, steps_between_looks, &stop_when_spent, nullptr);
    return SQLITE_OK;
}

}  // namespace

void start_vectors() {
    static const bool is_started = [] {
        start_gdal();
        RegisterOGRGeoPackage();
        RegisterOGRShape();
        RegisterOGRFlatGeobuf();
        return true;
    }();
    (void)is_started;
    sqlite3_auto_extension(reinterpret_cast<void (*)()>(&watch_database));  // once, however often
}

const char* dataset_driver(DatasetFormat format) {
    switch (format) {
        case DatasetFormat::shapefile:
            return "ESRI Shapefile";
        case DatasetFormat::flatgeobuf:
            return "FlatGeobuf";
        case DatasetFormat::geopackage:
            break;
    }
    return "GPKG";
}

std::string trusted_vector_formats() {
    return "GPX, KML, KMZ, GeoJSON, TopoJSON, CSV, GeoPackage, shapefile, FlatGeobuf";
}

}  // namespace oro

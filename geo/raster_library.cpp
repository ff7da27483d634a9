#include "geo/raster_library.h"

#include <cpl_conv.h>
#include <cpl_error.h>

#include "geo/library_faults.h"

namespace oro {

void start_gdal() {
    // Not std::call_once: what is thrown through it (there is no memory) must find glibc's unwinder, which is
    // loaded then, and aborts where that fails.
    static const bool is_started = [] {
        // Terrain files never send this program into the network, whatever a VRT inside them says.
        CPLSetConfigOption("CPL_VSIL_CURL_ALLOWED_FILENAME", "none");
        OSRSetPROJEnableNetwork(0);
        // GDAL would write FILE.gz.properties beside a compressed file it has measured.
        CPLSetConfigOption("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");
        // Otherwise GeoTIFF 1.0 files lose the vertical datum that they state.
        CPLSetConfigOption("GTIFF_REPORT_COMPD_CS", "YES");
        // Sidecar files are asked for by name: listing a folder of thousands of tiles for each of them takes
        // minutes.
        CPLSetConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "TRUE");
        GDALAllRegister();
        for (const char* name : {"WMS", "WMTS", "WCS", "HTTP", "PLMOSAIC", "PLSCENES", "EEDA", "EEDAI",
                                 "DAAS", "NGW", "OGCAPI", "STACTA", "STACIT", "PostGISRaster"}) {
            if (const GDALDriverH driver = GDALGetDriverByName(name)) {
                GDALDeregisterDriver(driver);
                GDALDestroyDriver(driver);
            }
        }
        return true;
    }();
    (void)is_started;
}

GdalMessages::GdalMessages() {
    CPLPushErrorHandlerEx(&GdalMessages::take, this);
}

GdalMessages::~GdalMessages() {
    CPLPopErrorHandler();
    CPLErrorReset();
}

void CPL_STDCALL GdalMessages::take(CPLErr severity, CPLErrorNum number, const char* message) {
    note_gdal_message(severity == CE_Fatal, number == CPLE_OutOfMemory);
    if (severity < CE_Failure || message == nullptr) return;
    static_cast<GdalMessages*>(CPLGetErrorHandlerUserData())->text_ = message;
}

std::string GdalMessages::last(const std::string& otherwise) const {
    if (text_.empty()) return otherwise;
    std::string line = text_;
    for (char& c : line) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    return line;
}

SpatialReference wgs84_degrees() {
    SpatialReference reference(OSRNewSpatialReference(nullptr));
    OSRImportFromEPSG(reference.get(), 4326);
    OSRSetAxisMappingStrategy(reference.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

SpatialReference spatial_reference(const std::string& wkt) {
    SpatialReference reference(OSRNewSpatialReference(wkt.c_str()));
    if (reference) OSRSetAxisMappingStrategy(reference.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

}  // namespace oro

#include "geo/sources/raster_crs.h"

#include <ogr_spatialref.h>

namespace oro {

SpatialReference crs_from_text(const std::string& text) {
    start_gdal();
    const char* const options[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
    SpatialReference crs(OSRNewSpatialReference(nullptr));
    if (OGRSpatialReference::FromHandle(crs.get())->SetFromUserInput(text.c_str(), options) != OGRERR_NONE)
        return nullptr;
    OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return crs;
}

std::string text_of_crs(OGRSpatialReferenceH crs) {
    const char* const authority = OSRGetAuthorityName(crs, nullptr);
    const char* const code = OSRGetAuthorityCode(crs, nullptr);
    if (authority && code) {
        std::string text = std::string(authority) + ":" + code;
        const SpatialReference same = crs_from_text(text);
        if (same && OSRIsSame(same.get(), crs) != 0) return text;
    }
    return wkt_of(crs);
}

}  // namespace oro

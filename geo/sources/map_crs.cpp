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

std::string unknown_crs_words(const std::string& text, const std::string& example) {
    const std::string what = "is no coordinate reference system that PROJ knows";
    const bool is_number =
        !text.empty() && text.size() <= 6 && text.find_first_not_of("0123456789") == std::string::npos;
    const GdalMessages messages;
    if (is_number && crs_from_text("EPSG:" + text)) return what + ": did you mean EPSG:" + text + "?";
    return what + "; e.g. " + example;
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

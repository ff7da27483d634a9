#include "geo/sources/raster_crs.h"

#include <cpl_conv.h>

#include "geo/files/foreign_text.h"

namespace oro {
namespace {

std::string text_of(const char* text) {
    return text ? foreign_text(text) : "";
}

}  // namespace

Result<SpatialReference> crs_of(GDALDatasetH dataset) {
    const OGRSpatialReferenceH stated = GDALGetSpatialRef(dataset);
    const auto fault = [](const std::string& what) { return Error{ErrorKind::failed, "", what}; };
    if (!stated) {
        return fault(GDALGetGCPCount(dataset) > 0
                         ? "is placed by ground control points only; warp it first (gdalwarp)"
                         : "states no coordinate reference system, so where it lies is unknown; give it one "
                           "(gdal_edit.py -a_srs)");
    }
    if (text_of(OSRGetName(stated)).empty())
        return fault("its coordinate reference system is unknown to PROJ");
    if (OSRIsLocal(stated) || (!OSRIsGeographic(stated) && !OSRIsProjected(stated)))
        return fault("its coordinate reference system (" + text_of(OSRGetName(stated)) +
                     ") is tied to no place on the Earth");
    SpatialReference crs(OSRClone(stated));
    OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return crs;
}

std::string wkt_of(OGRSpatialReferenceH crs) {
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    char* text = nullptr;
    OSRExportToWktEx(crs, &text, options);
    std::string wkt = text ? text : "";
    CPLFree(text);
    return wkt;
}

std::string crs_name(OGRSpatialReferenceH crs) {
    const char* const authority = OSRGetAuthorityName(crs, nullptr);
    const char* const code = OSRGetAuthorityCode(crs, nullptr);
    const std::string name = text_of(OSRGetName(crs));
    return authority && code ? std::string(authority) + ":" + code + " " + name : name;
}

SpatialReference horizontal_part(OGRSpatialReferenceH crs) {
    SpatialReference horizontal(OSRClone(crs));
    if (OSRIsCompound(horizontal.get())) OSRStripVertical(horizontal.get());
    if (OSRGetAxesCount(horizontal.get()) == 3) OSRDemoteTo2D(horizontal.get(), nullptr);
    OSRSetAxisMappingStrategy(horizontal.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return horizontal;
}

}  // namespace oro

// Vector files that tests write.
#pragma once

#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/test_data.h"

namespace oro::test {

inline std::string written(const std::string& name, const std::string& text) {
    const std::filesystem::path path = scratch_folder() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
}

// GeoJSON: one feature, and a file of several.
inline std::string feature(const std::string& type, const std::string& coordinates,
                           const std::string& properties = "") {
    return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":{"type":")" + type +
           R"(","coordinates":)" + coordinates + "}}";
}
inline std::string collection(const std::string& features, const std::string& crs = "") {
    const std::string named = R"("crs":{"type":"name","properties":{"name":")" + crs + R"("}},)";
    return R"({"type":"FeatureCollection",)" + (crs.empty() ? "" : named) + R"("features":[)" + features +
           "]}";
}

inline std::string gpx(const std::string& content) {
    return R"(<?xml version="1.0"?><gpx version="1.1" creator="x" xmlns="http://www.topografix.com/GPX/1/1">)" +
           content + "</gpx>";
}
inline std::string kml(const std::string& content) {
    return R"(<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document>)" + content +
           "</Document></kml>";
}

// A file of one layer that OGR writes, of geometries as WKT and their names. `epsg`: 0 for no CRS.
inline std::string vector_dataset(const std::string& name, const char* driver, int epsg,
                                  const std::vector<std::pair<std::string, std::string>>& shapes) {
    GDALAllRegister();
    const std::string path = (scratch_folder() / name).string();
    const GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName(driver), path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
    const OGRSpatialReferenceH crs = epsg > 0 ? OSRNewSpatialReference(nullptr) : nullptr;
    if (crs != nullptr) {
        OSRImportFromEPSG(crs, epsg);
        OSRSetAxisMappingStrategy(crs, OAMS_TRADITIONAL_GIS_ORDER);
    }
    const OGRLayerH layer = GDALDatasetCreateLayer(dataset, "shapes", crs, wkbUnknown, nullptr);
    const OGRFieldDefnH field = OGR_Fld_Create("name", OFTString);
    OGR_L_CreateField(layer, field, 1);
    OGR_Fld_Destroy(field);
    for (const auto& [wkt, text] : shapes) {
        const OGRFeatureH made = OGR_F_Create(OGR_L_GetLayerDefn(layer));
        OGR_F_SetFieldString(made, 0, text.c_str());
        OGRGeometryH geometry = nullptr;
        std::vector<char> copy(wkt.begin(), wkt.end());
        copy.push_back('\0');
        char* at = copy.data();
        if (OGR_G_CreateFromWkt(&at, nullptr, &geometry) == OGRERR_NONE)
            OGR_F_SetGeometryDirectly(made, geometry);
        if (OGR_L_CreateFeature(layer, made) != OGRERR_NONE) std::abort();
        OGR_F_Destroy(made);
    }
    GDALClose(dataset);
    if (crs != nullptr) OSRDestroySpatialReference(crs);
    return path;
}
// A GeoPackage whose layer is called `shapes`.
inline std::string geopackage(const std::string& name, int epsg,
                              const std::vector<std::pair<std::string, std::string>>& shapes) {
    return vector_dataset(name, "GPKG", epsg, shapes);
}

}  // namespace oro::test

// GDAL as this program uses it: started once, without network, its messages kept for our errors.
#pragma once

#include <cpl_minixml.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <memory>
#include <string>
#include <type_traits>

namespace oro {

// Registers the drivers below and no others: whatever else this GDAL has, plugins included, is never asked.
// Cheap after the first call; safe from any thread.
void start_gdal();

// GDAL's names of the raster formats that terrain is read from, ending in a null. They are those whose
// reading was seen to report it when a file is cut, at every place; and whose files GDAL reads itself, so
// that guard_files sees them.
const char* const* trusted_drivers();
// The names of these formats for people: "GeoTIFF, VRT, ...".
std::string trusted_formats();

// While it lives, GDAL's messages on this thread go here instead of standard error.
class GdalMessages {
  public:
    GdalMessages();
    ~GdalMessages();
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;

    // The last failure, in one line; or `otherwise` when GDAL said nothing.
    [[nodiscard]] std::string last(const std::string& otherwise) const;
    // The first warning, in one line; or "".
    [[nodiscard]] std::string warning() const;
    void clear() { text_.clear(); }

  private:
    static void CPL_STDCALL take(CPLErr severity, CPLErrorNum number, const char* message);
    std::string text_;
    std::string warning_;
};

struct CloseDataset {
    void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

// A raster of one band over memory that outlives it, row by row; null where the library has no memory for it.
Dataset dataset_over(void* pixels, GDALDataType type, int columns, int rows);

struct FreeXml {
    void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};
// A tree of XML elements of GDAL's, which it owns.
using Xml = std::unique_ptr<CPLXMLNode, FreeXml>;

struct FreeSpatialReference {
    void operator()(OGRSpatialReferenceH reference) const { OSRDestroySpatialReference(reference); }
};
using SpatialReference = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, FreeSpatialReference>;

struct FreeCoordinateTransformation {
    void operator()(OGRCoordinateTransformationH transformation) const {
        OCTDestroyCoordinateTransformation(transformation);
    }
};
using CoordinateTransformation =
    std::unique_ptr<std::remove_pointer_t<OGRCoordinateTransformationH>, FreeCoordinateTransformation>;

// WGS84, longitude before latitude, degrees.
SpatialReference wgs84_degrees();
// A CRS from WKT with x (or longitude) first; null when GDAL cannot read it.
SpatialReference spatial_reference(const std::string& wkt);

}  // namespace oro

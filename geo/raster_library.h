// GDAL as this program uses it: started once, without network, its messages kept for our errors.
#pragma once

#include <gdal.h>
#include <ogr_srs_api.h>

#include <memory>
#include <string>

namespace oro {

// Registers GDAL's drivers, less those that reach into the network. Cheap after the first call; safe from any
// thread.
void start_gdal();

// While it lives, GDAL's messages on this thread go here instead of standard error.
class GdalMessages {
  public:
    GdalMessages();
    ~GdalMessages();
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;

    // The last failure, in one line; or `otherwise` when GDAL said nothing.
    [[nodiscard]] std::string last(const std::string& otherwise) const;
    void clear() { text_.clear(); }

  private:
    static void CPL_STDCALL take(CPLErr severity, CPLErrorNum number, const char* message);
    std::string text_;
};

struct CloseDataset {
    void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

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

#include <cpl_conv.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <memory>
#include <type_traits>

#include "geo/files/foreign_text.h"
#include "geo/files/guarded_files.h"
#include "geo/files/raster_library.h"
#include "geo/meshes/equal_corners.h"
#include "geo/meshes/mesh_readers.h"
#include "geo/meshes/polygon_cut.h"
#include "geo/vectors/vector_readers.h"

namespace oro {
namespace {

Error no_mesh(const std::string& why) {
    return {ErrorKind::failed, "", why};
}

struct FreeMeshFeature {
    void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};
using OgrMeshFeature = std::unique_ptr<std::remove_pointer_t<OGRFeatureH>, FreeMeshFeature>;

// What a layer says of where it lies: a code, or WKT; "" for nothing.
std::string crs_of_layer(OGRLayerH layer) {
    OGRSpatialReferenceH reference = OGR_L_GetSpatialRef(layer);
    if (reference == nullptr) return "";
    const char* const authority = OSRGetAuthorityName(reference, nullptr);
    const char* const code = OSRGetAuthorityCode(reference, nullptr);
    if (authority != nullptr && code != nullptr) return std::string(authority) + ":" + code;
    char* wkt = nullptr;
    const char* const wkt2[] = {"FORMAT=WKT2_2019", nullptr};
    std::string text = OSRExportToWktEx(reference, &wkt, wkt2) == OGRERR_NONE && wkt != nullptr ? wkt : "";
    CPLFree(wkt);
    // GeoPackage's own words for a CRS that nobody knows.
    return text.find("Undefined") != std::string::npos ? "" : text;
}

class GeoPackageReader {
  public:
    GeoPackageReader(GDALDatasetH dataset, FileWatch& watch, const GdalMessages& messages)
        : dataset_(dataset), watch_(watch), messages_(messages) {}

    Result<SourceMesh> all() {
        mesh_.format = "GeoPackage";
        mesh_.kind = MeshKind::built;
        for (int i = 0; i < GDALDatasetGetLayerCount(dataset_); ++i) {
            const OGRLayerH layer = GDALDatasetGetLayer(dataset_, i);
            if (layer != nullptr) ORO_CHECK(read_layer(layer));
        }
        if (mesh_.triangles.empty() && flat_ > 0)
            return no_mesh(
                "no triangles: its polygons have no heights (TIN Z, PolyhedralSurface Z and "
                "MultiPolygon Z have)");
        if (tins_ > 0 && others_ == 0) {
            mesh_.format = "GeoPackage TIN";
            mesh_.kind = MeshKind::survey;
        }
        return std::move(mesh_);
    }

  private:
    Result<void> read_layer(OGRLayerH layer) {
        const std::size_t before = mesh_.triangles.size();
        const std::string name = foreign_text(OGR_L_GetName(layer));
        mesh_.parts.push_back({name, before});
        OGR_L_ResetReading(layer);
        constexpr std::size_t features_between_looks = 256;
        for (std::size_t count = 0;; ++count) {
            if (count % features_between_looks == 0 && watch_.spent()) return no_mesh(watch_.fault());
            const OgrMeshFeature feature(OGR_L_GetNextFeature(layer));
            if (!feature) break;
            if (OGRGeometryH geometry = OGR_F_GetGeometryRef(feature.get()); geometry != nullptr) {
                ++(OGR_GT_Flatten(OGR_G_GetGeometryType(geometry)) == wkbTIN ? tins_ : others_);
                ORO_CHECK(take(geometry, 0));
            }
        }
        if (!messages_.last("").empty())
            return no_mesh("layer '" + name + "' cannot be read to its end: " + messages_.last(""));
        if (mesh_.triangles.size() == before) {
            mesh_.parts.pop_back();
            return {};
        }
        const std::string crs = crs_of_layer(layer);
        if (before > 0 && crs != mesh_.crs) return no_mesh("its layers lie in several CRSs");
        mesh_.crs = crs;
        return {};
    }

    // Points and lines hold no triangles.
    Result<void> take(OGRGeometryH geometry, int depth) {
        constexpr int deepest = 32;
        if (depth > deepest) return no_mesh("a geometry is nested more than 32 deep");
        const OGRwkbGeometryType type = OGR_GT_Flatten(OGR_G_GetGeometryType(geometry));
        if (type == wkbPolygon || type == wkbTriangle) return polygon(geometry);
        if (type != wkbTIN && type != wkbPolyhedralSurface && type != wkbMultiPolygon &&
            type != wkbGeometryCollection)
            return {};
        for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
            ORO_CHECK(take(OGR_G_GetGeometryRef(geometry, i), depth + 1));
        return {};
    }

    Result<void> polygon(OGRGeometryH polygon) {
        if (OGR_G_Is3D(polygon) == 0) {
            ++flat_;
            return {};
        }
        PolygonRings rings;
        std::size_t corners = 0;
        for (int i = 0; i < OGR_G_GetGeometryCount(polygon); ++i) {
            std::vector<std::uint32_t> ring = ring_of(OGR_G_GetGeometryRef(polygon, i));
            corners += ring.size();
            if (ring.size() < 3 && i == 0) return {};
            if (ring.size() >= 3) rings.push_back(std::move(ring));
        }
        if (corners > most_polygon_corners) return no_mesh("a polygon has more than 10,000 corners");
        if (rings.empty()) return {};
        const bool is_sound = cut_polygon(mesh_.vertices, rings, mesh_.triangles);
        if (corners > 3) ++mesh_.polygons_cut;
        if (!is_sound) ++mesh_.polygons_crossing;
        return {};
    }

    // Without the first corner again at the end, and none twice in a row.
    std::vector<std::uint32_t> ring_of(OGRGeometryH line) {
        std::vector<std::uint32_t> ring;
        for (int i = 0; i < OGR_G_GetPointCount(line); ++i) {
            const std::uint32_t vertex =
                corners_.vertex({OGR_G_GetX(line, i), OGR_G_GetY(line, i), OGR_G_GetZ(line, i)});
            if (ring.empty() || ring.back() != vertex) ring.push_back(vertex);
        }
        if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
        return ring;
    }

    GDALDatasetH dataset_;
    FileWatch& watch_;
    const GdalMessages& messages_;
    SourceMesh mesh_;
    EqualCorners corners_{mesh_};
    std::size_t flat_{};             // polygons without heights
    std::size_t tins_{}, others_{};  // features
};

}  // namespace

Result<SourceMesh> read_geopackage_mesh(const std::string& path, double limit_s) {
    start_vectors();
    FileWatch watch(limit_s);
    const GdalMessages messages;
    static constexpr const char* whole[] = {"IMMUTABLE=YES", "LIST_ALL_TABLES=NO", nullptr};
    const char* const driver[] = {dataset_driver(DatasetFormat::geopackage), nullptr};
    const Dataset dataset(GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                     driver, whole, nullptr));
    if (!dataset) return no_mesh("is no GeoPackage of vectors: " + messages.last("unknown format"));
    if (!messages.last("").empty()) return no_mesh("cannot be read: " + messages.last(""));
    return GeoPackageReader(dataset.get(), watch, messages).all();
}

}  // namespace oro

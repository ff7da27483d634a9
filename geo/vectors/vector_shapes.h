// From OGR's geometries to points, lines and polygons on WGS84.
#pragma once

#include <ogr_api.h>

#include <vector>

#include "core/base/result.h"
#include "geo/sources/raster_library.h"
#include "geo/vectors/left_out.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// Splits the geometries of one layer into shapes.
class ShapeSplitter {
  public:
    // Errors (a reason, without the file's name): a CRS that is none, that PROJ does not know, or that is
    // tied to no place on the Earth. `crs` may be null.
    static Result<ShapeSplitter> of(OGRSpatialReferenceH crs);

    // Appends the shapes of a geometry, and counts what has no place. Takes curves, too.
    void split(OGRGeometryH geometry, HeightAbove heights, std::size_t record,
               std::vector<VectorShape>& shapes, LeftOut& left_out);
    // What heights count from as the CRS says it; nothing where it says nothing.
    [[nodiscard]] HeightAbove heights() const { return heights_; }
    // Of all shapes until now.
    [[nodiscard]] std::size_t places() const { return places_; }

  private:
    using Path = std::vector<VectorPlace>;
    struct Split {
        HeightAbove heights;
        std::size_t record;
        std::vector<VectorShape>* shapes;
        LeftOut* left_out;
    };
    void split_flat(OGRGeometryH geometry, const Split& to);
    void split_point(OGRGeometryH geometry, const Split& to);
    void split_line(OGRGeometryH geometry, const Split& to);
    void split_polygon(OGRGeometryH geometry, const Split& to);
    void add(VectorKind kind, std::vector<Path> paths, const Split& to);
    // The places of a simple curve; one that is none has no number for a latitude, and `why` says why.
    Path places_of(OGRGeometryH geometry, HeightAbove heights, const char*& why);

    CoordinateTransformation to_wgs84_;  // null: they are WGS84's already
    HeightAbove heights_{HeightAbove::nothing};
    double metres_per_unit_{1.0};
    std::size_t places_{};
    std::vector<double> x_, y_, z_;
    std::vector<int> done_;
};

}  // namespace oro

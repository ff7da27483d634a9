// From coordinates, of text or of OGR's geometries, to points, lines and polygons on WGS84.
#pragma once

#include <ogr_api.h>

#include <vector>

#include "core/base/result.h"
#include "geo/files/raster_library.h"
#include "geo/vectors/left_out.h"
#include "geo/vectors/text_path.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// Where shapes go, and what they are part of.
struct ShapeTarget {
    HeightAbove heights{HeightAbove::nothing};
    std::size_t record{};
    std::vector<VectorShape>* shapes{};
    LeftOut* left_out{};
};

// Splits the geometries of one layer into shapes.
class ShapeSplitter {
  public:
    // Errors (a reason, without the file's name): a CRS that is none, that PROJ does not know, or that is
    // tied to no place on the Earth. `crs` may be null.
    static Result<ShapeSplitter> of(OGRSpatialReferenceH crs);
    // For longitudes and latitudes of WGS84.
    static ShapeSplitter of_wgs84() { return {}; }
    [[nodiscard]] bool is_of_wgs84() const { return to_wgs84_ == nullptr; }

    // Appends the shapes of a geometry, and counts what has no place. Takes curves, too.
    void split(OGRGeometryH geometry, const ShapeTarget& to);
    // Appends the shape of coordinates in the layer's CRS, x or longitude first, or counts them as left out.
    // A point has one place; a line is broken where a place is none; the first ring of a polygon is its outer
    // one.
    void add_point(const TextPath& point, const ShapeTarget& to);
    void add_line(const TextPath& line, const ShapeTarget& to);
    void add_polygon(const std::vector<TextPath>& rings, const ShapeTarget& to);

    // Takes coordinates as being in another unit than that of the CRS, where that is projected. Gives what
    // they are taken times.
    double take_unit(double unit_m);

    // What heights count from as the CRS says it; nothing where it says nothing.
    [[nodiscard]] HeightAbove heights() const { return heights_; }
    // The number of places of all shapes until now.
    [[nodiscard]] std::size_t places() const { return places_; }
    // Places that told the first of a ring again at its end, of all polygons until now.
    [[nodiscard]] std::size_t ring_ends() const { return ring_ends_; }

  private:
    using Path = std::vector<VectorPlace>;
    struct Fault {
        const char* why;
        LeftOutPart part;
    };
    void split_flat(OGRGeometryH geometry, const ShapeTarget& to);
    void split_polygon(OGRGeometryH geometry, const ShapeTarget& to);
    void add(VectorKind kind, std::vector<Path> paths, const ShapeTarget& to);
    static TextPath path_of(OGRGeometryH geometry, HeightAbove heights);
    // The places of a simple curve; one that is none has no number for a latitude, and is told in `faults`.
    Path places_of(const TextPath& path, const ShapeTarget& to, std::vector<Fault>& faults);
    void transform(const TextPath& path);

    CoordinateTransformation to_wgs84_;  // null: they are WGS84's already
    HeightAbove heights_{HeightAbove::nothing};
    double metres_per_unit_{1.0};
    double axis_m_{0.0};  // metres of a projected CRS's unit; 0: it is in degrees
    double coordinate_scale_{1.0};
    std::size_t places_{};
    std::size_t ring_ends_{};
    std::vector<double> x_, y_;
    std::vector<int> done_;
};

}  // namespace oro

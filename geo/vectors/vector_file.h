// Points, lines and polygons of vector files (GPX, KML, GeoJSON, GeoPackage, shapefiles, CSV ...), as
// latitudes and longitudes of WGS84.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace oro {

// What the heights of a shape count from. GPX, KML's absolute ones and compound CRSs say sea level (whichever
// geoid they mean), GeoJSON (RFC 7946), TopoJSON and CRSs of three axes the ellipsoid. Those of other files
// whose CRS says nothing are taken to count from sea level. KML's clampToGround, its default, has none.
enum class HeightAbove { nothing, sea_level, ellipsoid, ground };

struct VectorPlace {
    double lat_deg{};  // -90 .. 90
    double lon_deg{};  // (-180, 180]; a line goes the shorter way round from each place to the next
    double height_m{std::numeric_limits<double>::quiet_NaN()};  // no number: none
};

enum class VectorKind { point, line, polygon };

// A point has one path of one place; a line one path of two or more places; a polygon its outer ring and
// then its holes, each of three or more places, the first not told again at the end.
struct VectorShape {
    VectorKind kind{};
    HeightAbove heights{HeightAbove::nothing};
    std::vector<std::vector<VectorPlace>> paths;
    std::size_t record{};  // of its layer: shapes that are split from one feature share theirs
};

// A field of a feature that holds something.
struct VectorField {
    std::size_t name{};  // number of VectorLayer::fields
    std::string text;    // UTF-8
};
using VectorRecord = std::vector<VectorField>;

struct VectorLayer {
    std::string name;
    std::vector<std::string> fields;  // names
    std::vector<VectorRecord> records;
    std::vector<VectorShape> shapes;

    // What a field says of a shape, or "". Where no field has the name in these letters one that has it in
    // others of upper or lower case will do.
    [[nodiscard]] std::string_view text(const VectorShape& shape, std::string_view field) const;
    // The number of such a field; or -1.
    [[nodiscard]] int field_number(std::string_view field) const;
};

struct VectorFile {
    std::string file;
    std::vector<VectorLayer> layers;  // those that have shapes
    std::vector<std::string>
        files;                    // that were read: `file`, and those that a shapefile or CSV has beside it
    std::uint64_t fingerprint{};  // fingerprint of these files' bytes
    std::vector<std::string> notes;  // what a user must know, one line each: what was left out, and why
    std::size_t
        places_left_out{};    // of all places that the file writes, those in no shape; notes tell of them
    std::size_t ring_ends{};  // places that tell the first of a polygon's ring again at its end

    [[nodiscard]] std::size_t count(VectorKind kind) const;
};

// A file of text may be so long, ...
inline constexpr std::uint64_t longest_vector_text = std::uint64_t{1} << 30U;
// All shapes of a file may have so many places.
inline constexpr std::size_t most_vector_places = 50'000'000;

// Reads all of a file: GPX (waypoints, routes, tracks), KML (with Google's tracks; packed as KMZ, too, with
// the files in it that network links lead to), GeoJSON, TopoJSON, CSV (columns lat and lon, x and y with a
// CRS, or WKT), GeoPackage, shapefiles, FlatGeobuf, and a .zip that holds one of them. Collections are split,
// curves become lines (an arc one for each degree), a KML Model is a point and a GroundOverlay a polygon.
// Places are turned into WGS84's by PROJ's best operation for the layer's CRS (one that GeoJSON names as it
// did before RFC 7946, too). Coordinates that are no numbers, and such as have no place on the Earth, are
// left out, a line is broken where one of its places is none, and notes tell how often, why and in which line
// first. Opens regular files of this machine, and no other; takes limit_s at most, and a second more for each
// MiB. Errors: a file that is not there, empty, damaged or of another format (with the line, of text); a
// shapefile without its .shx or .prj; one that has nothing with a place; a CRS that PROJ does not know.
Result<VectorFile> read_vectors(const std::string& file, double limit_s = 30.0);

}  // namespace oro

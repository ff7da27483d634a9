#include "geo/cover/cover_polygons.h"

#include <gdal_alg.h>
#include <ogr_api.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "geo/drape/raster_opening.h"
#include "geo/files/letter_case.h"
#include "geo/sources/raster_crs.h"
#include "geo/vectors/vector_file.h"

namespace oro {
namespace {

constexpr std::array code_fields{"code_18", "code_12", "code_06",  "code_00", "clc_code",
                                 "code",    "class",   "gridcode", "value",   "dn"};
constexpr double cell_m = 5.0;
constexpr int most_cells_along = 8192;
constexpr std::uint16_t no_code = 65535;
constexpr double deg_per_m = 1.0 / 111'320.0;  // of latitude, nearly

struct Geometry {
    void operator()(void* geometry) const { OGR_G_DestroyGeometry(geometry); }
};
using OwnGeometry = std::unique_ptr<void, Geometry>;

struct CodedShape {
    const VectorShape* shape;
    std::uint16_t code;
};

Error no_polygons(const std::string& file, const std::string& why) {
    return {ErrorKind::failed, file, why};
}

std::string listed_fields(const VectorFile& vectors) {
    std::string all;
    for (const VectorLayer& layer : vectors.layers)
        for (const std::string& field : layer.fields) all += (all.empty() ? "" : ", ") + field;
    return all.empty() ? "they have no field" : "they have " + all;
}

std::optional<std::uint16_t> code_from(std::string_view text) {
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
    if (!(value >= 0.0 && value < no_code) || value != std::floor(value)) return std::nullopt;
    return static_cast<std::uint16_t>(value);
}

Result<std::vector<CodedShape>> coded_shapes(const VectorFile& vectors) {
    std::vector<CodedShape> coded;
    bool any_polygon = false;
    for (const VectorLayer& layer : vectors.layers) {
        const auto has = [&](const char* field) { return layer.field_number(field) >= 0; };
        const auto* const field = std::ranges::find_if(code_fields, has);
        for (const VectorShape& shape : layer.shapes) {
            if (shape.kind != VectorKind::polygon) continue;
            any_polygon = true;
            if (field == code_fields.end()) break;
            const std::string_view text = layer.text(shape, *field);
            if (text.empty()) continue;
            const auto code = code_from(text);
            if (!code)
                return no_polygons(vectors.file,
                                   "its field " + std::string(*field) + " is '" + std::string(text) +
                                       "', which is no code of a class: a whole number from 0 on");
            coded.push_back({&shape, *code});
        }
    }
    if (!any_polygon) return no_polygons(vectors.file, "holds no polygons of land cover");
    if (!coded.empty()) return coded;
    std::string names;
    for (const char* const name : code_fields) names += (names.empty() ? "" : ", ") + std::string(name);
    return no_polygons(vectors.file, "its polygons have no code of a class: a field " + names + "; " +
                                         listed_fields(vectors));
}

// A ring of a polygon whose longitudes go on beyond 180 degrees instead of jumping.
struct Ring {
    std::vector<VectorPlace> places;
    double west_deg{1e9}, east_deg{-1e9};
    [[nodiscard]] double middle_deg() const { return 0.5 * (west_deg + east_deg); }
    void shift(double by_deg) {
        for (VectorPlace& place : places) place.lon_deg += by_deg;
        west_deg += by_deg;
        east_deg += by_deg;
    }
    void add(double lat_deg, double lon_deg) {
        places.push_back({.lat_deg = lat_deg, .lon_deg = lon_deg});
        west_deg = std::min(west_deg, lon_deg);
        east_deg = std::max(east_deg, lon_deg);
    }
};

// A ring that goes once round the Earth, such as the coast of Antarctica, is closed over the pole it lies
// nearer to.
Ring ring_of(const std::vector<VectorPlace>& path) {
    Ring ring;
    double lon_deg = path.front().lon_deg, sum_deg = 0.0;
    for (std::size_t i = 0; i <= path.size(); ++i) {
        const VectorPlace& place = path[i % path.size()];
        lon_deg += std::remainder(place.lon_deg - lon_deg, 360.0);
        ring.add(place.lat_deg, lon_deg);
        sum_deg += place.lat_deg;
    }
    if (std::abs(lon_deg - path.front().lon_deg) > 180.0) {
        const double pole_deg = sum_deg < 0.0 ? -90.0 : 90.0;
        ring.add(pole_deg, lon_deg);
        ring.add(pole_deg, path.front().lon_deg);
    }
    return ring;
}

struct CodedPolygon {
    std::vector<Ring> rings;
    std::uint16_t code{};
    double west_deg{1e9}, east_deg{-1e9};
};

// `near_deg` says in which turn of 360 degrees the polygon's middle lies. Its rings lie in one turn.
CodedPolygon polygon_of(const CodedShape& coded, double near_deg) {
    CodedPolygon polygon{.rings = {}, .code = coded.code};
    for (const auto& path : coded.shape->paths) {
        Ring ring = ring_of(path);
        const double to_deg = polygon.rings.empty() ? near_deg : polygon.rings.front().middle_deg();
        ring.shift(360.0 * std::round((to_deg - ring.middle_deg()) / 360.0));
        polygon.west_deg = std::min(polygon.west_deg, ring.west_deg);
        polygon.east_deg = std::max(polygon.east_deg, ring.east_deg);
        polygon.rings.push_back(std::move(ring));
    }
    return polygon;
}

struct Extent {
    double west_deg{1e9}, south_deg{1e9}, east_deg{-1e9}, north_deg{-1e9};
};

std::vector<CodedPolygon> polygons_of(const std::vector<CodedShape>& coded) {
    std::vector<CodedPolygon> polygons;
    polygons.reserve(coded.size());
    for (const CodedShape& one : coded)
        polygons.push_back(
            polygon_of(one, polygons.empty() ? 0.0 : polygons.front().rings.front().middle_deg()));
    return polygons;
}

// At most one turn of 360 degrees.
Extent extent_of(const std::vector<CodedPolygon>& polygons) {
    Extent extent;
    for (const CodedPolygon& polygon : polygons) {
        extent.west_deg = std::min(extent.west_deg, polygon.west_deg);
        extent.east_deg = std::max(extent.east_deg, polygon.east_deg);
        for (const Ring& ring : polygon.rings) {
            for (const VectorPlace& place : ring.places) {
                extent.south_deg = std::min(extent.south_deg, place.lat_deg);
                extent.north_deg = std::max(extent.north_deg, place.lat_deg);
            }
        }
    }
    extent.east_deg = std::min(extent.east_deg, extent.west_deg + 360.0);
    return extent;
}

// The size of a raster of square metres, and where its pixels are.
void place_cells(const Extent& extent, CoverSource& source) {
    const double middle_deg = 0.5 * (extent.south_deg + extent.north_deg);
    const double cosine = std::max(0.01, std::cos(radians_from_deg(middle_deg).rad));
    const double tall_m = (extent.north_deg - extent.south_deg) / deg_per_m;
    const double wide_m = (extent.east_deg - extent.west_deg) * cosine / deg_per_m;
    const double cell = std::max(cell_m, std::max(tall_m, wide_m) / (most_cells_along - 2));
    const double row_deg = cell * deg_per_m, column_deg = row_deg / cosine;
    source.columns = static_cast<int>(std::ceil(wide_m / cell)) + 2;
    source.rows = static_cast<int>(std::ceil(tall_m / cell)) + 2;
    source.crs_from_pixel = {extent.west_deg - column_deg, column_deg, 0.0,
                             extent.north_deg + row_deg,   0.0,        -row_deg};
    char text[120];
    std::snprintf(text, sizeof text, ": its polygons are drawn as cells of %.3g m", cell);
    source.notes.push_back(source.file + text);
}

OwnGeometry geometry_of(const CodedPolygon& polygon, double turned_deg) {
    OwnGeometry geometry(OGR_G_CreateGeometry(wkbPolygon));
    for (const Ring& own : polygon.rings) {
        OGRGeometryH ring = OGR_G_CreateGeometry(wkbLinearRing);
        for (const VectorPlace& place : own.places)
            OGR_G_AddPoint_2D(ring, place.lon_deg + turned_deg, place.lat_deg);
        OGR_G_AddGeometryDirectly(geometry.get(), ring);
    }
    return geometry;
}

// A polygon is drawn in each turn of 360 degrees in which it reaches into the extent.
void add_turns(const CodedPolygon& polygon, const Extent& extent, std::vector<OwnGeometry>& own,
               std::vector<double>& codes) {
    for (const double turned_deg : {-360.0, 0.0, 360.0}) {
        if (polygon.east_deg + turned_deg < extent.west_deg ||
            polygon.west_deg + turned_deg > extent.east_deg)
            continue;
        own.push_back(geometry_of(polygon, turned_deg));
        codes.push_back(polygon.code);
    }
}

Result<void> draw(const std::vector<CodedPolygon>& polygons, const Extent& extent, CoverSource& source) {
    const GdalMessages messages;
    auto cells = std::make_shared<std::vector<std::uint16_t>>(
        static_cast<std::size_t>(source.columns) * static_cast<std::size_t>(source.rows), no_code);
    source.held = cells;
    const Dataset dataset = held_dataset(source);
    if (!dataset || GDALSetGeoTransform(dataset.get(), source.crs_from_pixel.data()) != CE_None)
        return no_polygons(source.file, messages.last("there is no memory for its cells"));
    constexpr std::size_t at_once = 512;
    int band = 1;
    for (std::size_t first = 0; first < polygons.size(); first += at_once) {
        std::vector<OwnGeometry> own;
        std::vector<double> codes;
        for (std::size_t i = first; i < std::min(first + at_once, polygons.size()); ++i)
            add_turns(polygons[i], extent, own, codes);
        std::vector<OGRGeometryH> geometries;
        for (const OwnGeometry& one : own) geometries.push_back(one.get());
        if (GDALRasterizeGeometries(dataset.get(), 1, &band, static_cast<int>(geometries.size()),
                                    geometries.data(), nullptr, nullptr, codes.data(), nullptr, nullptr,
                                    nullptr) != CE_None)
            return no_polygons(source.file,
                               "its polygons cannot be drawn: " + messages.last("no reason is known"));
    }
    return {};
}

}  // namespace

bool is_vector_file(const std::string& file) {
    const std::string lower = lower_case(file);
    return std::ranges::any_of(std::array{".gpkg", ".geojson", ".topojson", ".kml", ".kmz", ".shp", ".fgb"},
                               [&](const char* ending) { return lower.ends_with(ending); });
}

Result<CoverSource> open_cover_polygons(const std::string& file) {
    start_gdal();
    ORO_TRY(const VectorFile vectors, read_vectors(file));
    ORO_TRY(const std::vector<CodedShape> coded, coded_shapes(vectors));
    CoverSource source;
    source.file = file;
    source.files = vectors.files;
    source.fingerprint = vectors.fingerprint;
    source.notes = vectors.notes;
    source.crs = "EPSG:4326 WGS 84";
    source.crs_wkt = wkt_of(wgs84_degrees().get());
    source.geographic = true;
    const std::vector<CodedPolygon> polygons = polygons_of(coded);
    const Extent extent = extent_of(polygons);
    place_cells(extent, source);
    if (!GDALInvGeoTransform(source.crs_from_pixel.data(), source.pixel_from_crs.data()))
        return no_polygons(file, "its polygons lie at one place");
    source.no_data = no_code;
    for (const CodedShape& one : coded) source.codes.insert(one.code);
    ORO_CHECK(draw(polygons, extent, source));
    return source;
}

}  // namespace oro

#include "geo/vectors/vector_shapes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "core/earth/ellipsoid.h"
#include "geo/datum/vertical_datum.h"
#include "geo/files/foreign_text.h"
#include "geo/sources/raster_crs.h"

namespace oro {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double degrees_a_chord = 1.0;
constexpr double most_turns_deg = 360.0;  // files across the antimeridian count on past 180
constexpr double highest_m = 1e8;

struct FreeGeometry {
    void operator()(OGRGeometryH geometry) const { OGR_G_DestroyGeometry(geometry); }
};
using Geometry = std::unique_ptr<std::remove_pointer_t<OGRGeometryH>, FreeGeometry>;

const char* fault_of(double lat_deg, double lon_deg) {
    if (!std::isfinite(lat_deg) || !std::isfinite(lon_deg)) return "that are no finite numbers";
    if (std::abs(lat_deg) > 90.0) return "with a latitude beyond 90 degrees";
    if (std::abs(lon_deg) > most_turns_deg) return "with a longitude beyond 360 degrees";
    return nullptr;
}

bool there(const VectorPlace& place) {
    return !std::isnan(place.lat_deg);
}

bool same(const VectorPlace& a, const VectorPlace& b) {
    return a.lat_deg == b.lat_deg && a.lon_deg == b.lon_deg;
}

// GeoPackage's number 0: latitudes and longitudes that refer to nothing known.
bool is_undefined(OGRSpatialReferenceH crs) {
    const auto is_unknown = [&](const char* part) {
        const char* const name = OSRGetAttrValue(crs, part, 0);
        return name != nullptr && std::string_view(name) == "unknown";
    };
    return is_unknown("DATUM") && is_unknown("SPHEROID");
}

bool is_wgs84(OGRSpatialReferenceH crs) {
    const SpatialReference wgs84 = wgs84_degrees();
    return OSRIsSame(crs, wgs84.get()) != 0;
}

}  // namespace

Result<ShapeSplitter> ShapeSplitter::of(OGRSpatialReferenceH crs) {
    const auto fault = [](const std::string& what) { return Error{ErrorKind::failed, "", what}; };
    if (crs == nullptr || is_undefined(crs))
        return fault(
            "states no coordinate reference system, so where it lies is unknown; give it one "
            "(ogr2ogr -a_srs)");
    const char* const name = OSRGetName(crs);
    if (OSRIsLocal(crs) != 0 || (OSRIsGeographic(crs) == 0 && OSRIsProjected(crs) == 0))
        return fault("its coordinate reference system (" + foreign_text(name ? name : "") +
                     ") is tied to no place on the Earth");
    ShapeSplitter splitter;
    const SpatialReference horizontal = horizontal_part(crs);
    if (!is_wgs84(horizontal.get())) {
        const SpatialReference wgs84 = wgs84_degrees();
        splitter.to_wgs84_.reset(OCTNewCoordinateTransformation(horizontal.get(), wgs84.get()));
        if (!splitter.to_wgs84_)
            return fault("PROJ knows no way from its coordinate reference system (" + crs_name(crs) +
                         ") to WGS84");
    }
    if (const auto datum = stated_datum(wkt_of(crs))) {
        splitter.heights_ = OSRIsCompound(crs) != 0 ? HeightAbove::sea_level : HeightAbove::ellipsoid;
        splitter.metres_per_unit_ = datum->metres_per_unit;
    }
    return splitter;
}

ShapeSplitter::Path ShapeSplitter::places_of(OGRGeometryH geometry, HeightAbove heights, const char*& why) {
    why = nullptr;
    const auto count = static_cast<std::size_t>(std::max(0, OGR_G_GetPointCount(geometry)));
    x_.assign(count, none), y_.assign(count, none), z_.assign(count, none);
    constexpr int step = sizeof(double);
    const bool has_heights = OGR_G_Is3D(geometry) != 0 && heights != HeightAbove::nothing;
    OGR_G_GetPoints(geometry, x_.data(), step, y_.data(), step, has_heights ? z_.data() : nullptr, step);
    done_.assign(count, 1);
    if (to_wgs84_ && count > 0) {
        for (std::size_t i = 0; i < count; ++i) {
            if (std::isfinite(x_[i]) && std::isfinite(y_[i])) continue;
            x_[i] = y_[i] = none;
            why = "that are no finite numbers";
        }
        const GdalMessages unsaid;  // of single places
        OCTTransformEx(to_wgs84_.get(), static_cast<int>(count), x_.data(), y_.data(), nullptr, done_.data());
    }
    Path path(count);
    for (std::size_t i = 0; i < count; ++i) {
        const bool lost = to_wgs84_ && (done_[i] == 0 || !std::isfinite(x_[i]) || !std::isfinite(y_[i]));
        const char* const fault =
            lost ? "that their coordinate reference system has no place for" : fault_of(y_[i], x_[i]);
        if (fault != nullptr) {
            if (why == nullptr) why = fault;
            path[i] = {none, none, none};
            continue;
        }
        const double height_m = z_[i] * metres_per_unit_;
        path[i] = {y_[i], normalised_lon_deg(x_[i]), std::abs(height_m) <= highest_m ? height_m : none};
    }
    return path;
}

void ShapeSplitter::add(VectorKind kind, std::vector<Path> paths, const Split& to) {
    for (const Path& path : paths) places_ += path.size();
    to.shapes->push_back({kind, to.heights, std::move(paths), to.record});
}

void ShapeSplitter::split_point(OGRGeometryH geometry, const Split& to) {
    const char* why = nullptr;
    Path path = places_of(geometry, to.heights, why);
    if (path.size() != 1 || why != nullptr)
        to.left_out->add(std::string("points ") + (why ? why : "without coordinates"));
    else
        add(VectorKind::point, {std::move(path)}, to);
}

// Broken where a place is none: nobody knows how the line goes there.
void ShapeSplitter::split_line(OGRGeometryH geometry, const Split& to) {
    const char* why = nullptr;
    const Path all = places_of(geometry, to.heights, why);
    const auto lost = static_cast<std::size_t>(
        std::ranges::count_if(all, [](const VectorPlace& place) { return !there(place); }));
    if (lost > 0) to.left_out->add(std::string("places of lines ") + why, lost);
    for (auto at = all.begin(); at != all.end();) {
        at = std::find_if(at, all.end(), there);
        const auto end = std::find_if_not(at, all.end(), there);
        if (end - at > 1)
            add(VectorKind::line, {Path(at, end)}, to);
        else if (end - at == 1)
            to.left_out->add("lines of a single place");
        at = end;
    }
}

void ShapeSplitter::split_polygon(OGRGeometryH geometry, const Split& to) {
    std::vector<Path> rings;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) {
        const char* why = nullptr;
        Path ring = places_of(OGR_G_GetGeometryRef(geometry, i), to.heights, why);
        if (why != nullptr) {
            to.left_out->add(std::string("polygons with places ") + why);
            return;
        }
        while (ring.size() > 1 && same(ring.front(), ring.back())) ring.pop_back();
        if (ring.size() >= 3) {
            rings.push_back(std::move(ring));
            continue;
        }
        to.left_out->add(i == 0 ? "polygons of fewer than three places" : "holes of fewer than three places");
        if (i == 0) return;
    }
    if (!rings.empty()) add(VectorKind::polygon, std::move(rings), to);
}

void ShapeSplitter::split_flat(OGRGeometryH geometry, const Split& to) {
    if (OGR_G_IsEmpty(geometry) != 0) {
        to.left_out->add("geometries without coordinates");
        return;
    }
    switch (wkbFlatten(OGR_G_GetGeometryType(geometry))) {
        case wkbPoint:
            split_point(geometry, to);
            return;
        case wkbLineString:
        case wkbLinearRing:
            split_line(geometry, to);
            return;
        case wkbPolygon:
        case wkbTriangle:
            split_polygon(geometry, to);
            return;
        case wkbMultiPoint:
        case wkbMultiLineString:
        case wkbMultiPolygon:
        case wkbGeometryCollection:
        case wkbPolyhedralSurface:
        case wkbTIN:
            for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
                split_flat(OGR_G_GetGeometryRef(geometry, i), to);
            return;
        default:
            to.left_out->add("geometries of a kind that is not known here");
            return;
    }
}

void ShapeSplitter::split(OGRGeometryH geometry, HeightAbove heights, std::size_t record,
                          std::vector<VectorShape>& shapes, LeftOut& left_out) {
    const Split to{heights, record, &shapes, &left_out};
    if (OGR_G_HasCurveGeometry(geometry, 1) == 0) {
        split_flat(geometry, to);
        return;
    }
    const Geometry flat(OGR_G_GetLinearGeometry(geometry, degrees_a_chord, nullptr));
    if (flat)
        split_flat(flat.get(), to);
    else
        left_out.add("curves that cannot be followed");
}

}  // namespace oro

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
    if (OSRIsProjected(crs) != 0) splitter.axis_m_ = OSRGetLinearUnits(crs, nullptr);
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

double ShapeSplitter::take_unit(double unit_m) {
    constexpr double least_difference = 1.0e-12;
    if (axis_m_ > 0.0 && std::abs(unit_m / axis_m_ - 1.0) >= least_difference)
        coordinate_scale_ = unit_m / axis_m_;
    return coordinate_scale_;
}

TextPath ShapeSplitter::path_of(OGRGeometryH geometry, HeightAbove heights) {
    TextPath path;
    const auto count = static_cast<std::size_t>(std::max(0, OGR_G_GetPointCount(geometry)));
    path.x.assign(count, none), path.y.assign(count, none), path.z.assign(count, none);
    constexpr int step = sizeof(double);
    const bool has_heights = OGR_G_Is3D(geometry) != 0 && heights != HeightAbove::nothing;
    OGR_G_GetPoints(geometry, path.x.data(), step, path.y.data(), step, has_heights ? path.z.data() : nullptr,
                    step);
    return path;
}

// x_ and y_ become longitudes and latitudes of WGS84, as far as done_ says so.
void ShapeSplitter::transform(const TextPath& path) {
    const std::size_t count = path.size();
    x_ = path.x, y_ = path.y;
    if (coordinate_scale_ != 1.0)
        for (std::size_t i = 0; i < count; ++i) x_[i] *= coordinate_scale_, y_[i] *= coordinate_scale_;
    done_.assign(count, 1);
    if (!to_wgs84_ || count == 0) return;
    for (std::size_t i = 0; i < count; ++i) {
        if (!std::isfinite(x_[i]) || !std::isfinite(y_[i])) x_[i] = y_[i] = none;
    }
    const GdalMessages unsaid;  // of single places
    OCTTransformEx(to_wgs84_.get(), static_cast<int>(count), x_.data(), y_.data(), nullptr, done_.data());
}

ShapeSplitter::Path ShapeSplitter::places_of(const TextPath& from, const ShapeTarget& to,
                                             std::vector<Fault>& faults) {
    transform(from);
    Path path(from.size());
    std::size_t written = 0;  // of the faults that the file's words have
    for (std::size_t i = 0; i < path.size(); ++i) {
        const bool is_finite = std::isfinite(from.x[i]) && std::isfinite(from.y[i]);
        const bool lost =
            to_wgs84_ && is_finite && (done_[i] == 0 || !std::isfinite(x_[i]) || !std::isfinite(y_[i]));
        const char* why =
            lost ? "that their coordinate reference system has no place for" : fault_of(y_[i], x_[i]);
        std::string word;
        if (written < from.faults.size() && from.faults[written].place == i) {
            why = from.faults[written].why;
            word = from.faults[written++].word;
        }
        if (why != nullptr) {
            path[i] = {none, none, none};
            faults.push_back({why, {1, 1, from.at.empty() ? LeftOutPart::nowhere : from.at[i], word}});
            continue;
        }
        const double height_m = to.heights == HeightAbove::nothing ? none : from.z[i] * metres_per_unit_;
        path[i] = {y_[i], normalised_lon_deg(x_[i]), std::abs(height_m) <= highest_m ? height_m : none};
    }
    if (from.faulty_heights > 0)
        to.left_out->add("heights that are no numbers", {from.faulty_heights, 0, from.faulty_height_at, ""});
    return path;
}

void ShapeSplitter::add(VectorKind kind, std::vector<Path> paths, const ShapeTarget& to) {
    for (const Path& path : paths) places_ += path.size();
    to.shapes->push_back({kind, to.heights, std::move(paths), to.record});
}

void ShapeSplitter::add_point(const TextPath& point, const ShapeTarget& to) {
    const std::size_t at = point.at.empty() ? LeftOutPart::nowhere : point.at.front();
    if (point.size() != 1) {
        to.left_out->add(point.size() == 0 ? "points without coordinates" : "points of more than one place",
                         {1, point.size(), at, ""});
        return;
    }
    std::vector<Fault> faults;
    Path path = places_of(point, to, faults);
    if (faults.empty())
        add(VectorKind::point, {std::move(path)}, to);
    else
        to.left_out->add(std::string("points ") + faults.front().why, faults.front().part);
}

// Broken where a place is none: nobody knows how the line goes there.
void ShapeSplitter::add_line(const TextPath& line, const ShapeTarget& to) {
    std::vector<Fault> faults;
    const Path all = places_of(line, to, faults);
    for (const Fault& fault : faults)
        to.left_out->add(std::string("places of lines ") + fault.why, fault.part);
    for (auto at = all.begin(); at != all.end();) {
        at = std::find_if(at, all.end(), there);
        const auto end = std::find_if_not(at, all.end(), there);
        if (end - at > 1)
            add(VectorKind::line, {Path(at, end)}, to);
        else if (end - at == 1)
            to.left_out->add(
                "lines of a single place",
                {1, 1,
                 line.at.empty() ? LeftOutPart::nowhere : line.at[static_cast<std::size_t>(at - all.begin())],
                 ""});
        at = end;
    }
}

void ShapeSplitter::add_polygon(const std::vector<TextPath>& rings, const ShapeTarget& to) {
    std::vector<Path> kept;
    std::size_t all = 0, ends = 0;
    for (const TextPath& ring : rings) all += ring.size();
    for (std::size_t i = 0; i < rings.size(); ++i) {
        std::vector<Fault> faults;
        Path ring = places_of(rings[i], to, faults);
        const std::size_t at = rings[i].at.empty() ? LeftOutPart::nowhere : rings[i].at.front();
        if (!faults.empty()) {
            LeftOutPart part = faults.front().part;
            part.places = all;
            to.left_out->add(std::string("polygons with places ") + faults.front().why, part);
            return;
        }
        while (ring.size() > 1 && same(ring.front(), ring.back())) ring.pop_back();
        if (ring.size() >= 3) {
            ends += rings[i].size() - ring.size();
            kept.push_back(std::move(ring));
            continue;
        }
        if (i == 0) {
            to.left_out->add("polygons of fewer than three places", {1, all, at, ""});
            return;
        }
        to.left_out->add("holes of fewer than three places", {1, rings[i].size(), at, ""});
        all -= rings[i].size();
    }
    if (kept.empty()) return;
    ring_ends_ += ends;
    add(VectorKind::polygon, std::move(kept), to);
}

void ShapeSplitter::split_polygon(OGRGeometryH geometry, const ShapeTarget& to) {
    std::vector<TextPath> rings;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
        rings.push_back(path_of(OGR_G_GetGeometryRef(geometry, i), to.heights));
    add_polygon(rings, to);
}

void ShapeSplitter::split_flat(OGRGeometryH geometry, const ShapeTarget& to) {
    if (OGR_G_IsEmpty(geometry) != 0) {
        to.left_out->add("geometries without coordinates");
        return;
    }
    switch (wkbFlatten(OGR_G_GetGeometryType(geometry))) {
        case wkbPoint:
            add_point(path_of(geometry, to.heights), to);
            return;
        case wkbLineString:
        case wkbLinearRing:
            add_line(path_of(geometry, to.heights), to);
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

void ShapeSplitter::split(OGRGeometryH geometry, const ShapeTarget& to) {
    if (OGR_G_HasCurveGeometry(geometry, 1) == 0) {
        split_flat(geometry, to);
        return;
    }
    const Geometry flat(OGR_G_GetLinearGeometry(geometry, degrees_a_chord, nullptr));
    if (flat)
        split_flat(flat.get(), to);
    else
        to.left_out->add("curves that cannot be followed");
}

}  // namespace oro

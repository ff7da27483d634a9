#include "geo/together/face_cut.h"

#include <geos_c.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace oro {

struct FaceCutter::Geos {
    struct Close {
        void operator()(GEOSContextHandle_t handle) const { GEOS_finish_r(handle); }
    };
    struct Destroy {
        GEOSContextHandle_t handle;
        void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
    };
    using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

    std::unique_ptr<GEOSContextHandle_HS, Close> context{GEOS_init_r()};
    std::string said;

    Geos() {
        GEOSContext_setErrorMessageHandler_r(
            context.get(),
            [](const char* message, void* to) { static_cast<std::string*>(to)->assign(message); }, &said);
    }
    [[nodiscard]] Geometry own(GEOSGeometry* geometry) const {
        return Geometry(geometry, Destroy{context.get()});
    }
    [[nodiscard]] Error error() const {
        return Error{ErrorKind::failed, "seam between grids", said.empty() ? "GEOS gave nothing" : said};
    }
    [[nodiscard]] GEOSCoordSequence* sequence(std::span<const glm::dvec2> points) const {
        return GEOSCoordSeq_copyFromBuffer_r(context.get(), &points.front().x,
                                             static_cast<unsigned int>(points.size()), 0, 0);
    }
    [[nodiscard]] GEOSGeometry* line(std::span<const glm::dvec2> points) const {
        return GEOSGeom_createLineString_r(context.get(), sequence(points));
    }
    [[nodiscard]] GEOSGeometry* ring(std::span<const glm::dvec2> points) const {
        return GEOSGeom_createLinearRing_r(context.get(), sequence(points));
    }
    [[nodiscard]] std::vector<glm::dvec2> points(const GEOSGeometry* line) const {
        const GEOSCoordSequence* all = GEOSGeom_getCoordSeq_r(context.get(), line);
        unsigned int count = 0;
        GEOSCoordSeq_getSize_r(context.get(), all, &count);
        std::vector<glm::dvec2> out(count);
        if (count > 0) GEOSCoordSeq_copyToBuffer_r(context.get(), all, &out.front().x, 0, 0);
        return out;
    }
    // Rings so that the polygon lies on the right hand of each.
    [[nodiscard]] std::vector<std::vector<glm::dvec2>> rings(const GEOSGeometry* polygon) const;
};

namespace {

// Twice the area on the right hand, where y goes down.
double doubled_area(std::span<const glm::dvec2> ring) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < ring.size(); ++i)
        sum += ring[i].x * ring[i + 1].y - ring[i + 1].x * ring[i].y;
    return sum;
}

}  // namespace

std::vector<std::vector<glm::dvec2>> FaceCutter::Geos::rings(const GEOSGeometry* polygon) const {
    std::vector<std::vector<glm::dvec2>> all{points(GEOSGetExteriorRing_r(context.get(), polygon))};
    const int holes = GEOSGetNumInteriorRings_r(context.get(), polygon);
    for (int i = 0; i < holes; ++i) all.push_back(points(GEOSGetInteriorRingN_r(context.get(), polygon, i)));
    for (std::size_t i = 0; i < all.size(); ++i) {
        if ((doubled_area(all[i]) > 0.0) != (i == 0)) std::reverse(all[i].begin(), all[i].end());
    }
    return all;
}

FaceCutter::FaceCutter(double snap) : geos_(std::make_unique<Geos>()), snap_(snap) {}
FaceCutter::~FaceCutter() = default;

Result<std::vector<PlaneFace>> FaceCutter::faces(const PlaneTriangle& triangle,
                                                 std::span<const PlaneLine> lines) {
    GEOSContextHandle_t context = geos_->context.get();
    std::vector<GEOSGeometry*> parts;
    for (std::size_t i = 0; i < 3; ++i)
        parts.push_back(geos_->line(PlaneLine{triangle[i], triangle[(i + 1) % 3]}));
    for (const PlaneLine& line : lines) parts.push_back(geos_->line(line));
    if (std::find(parts.begin(), parts.end(), nullptr) != parts.end()) {
        for (GEOSGeometry* part : parts)
            if (part != nullptr) GEOSGeom_destroy_r(context, part);
        return geos_->error();
    }
    const auto all = geos_->own(GEOSGeom_createCollection_r(context, GEOS_MULTILINESTRING, parts.data(),
                                                            static_cast<unsigned int>(parts.size())));
    if (!all) return geos_->error();
    const auto noded = geos_->own(GEOSUnaryUnionPrec_r(context, all.get(), snap_));
    if (!noded) return geos_->error();
    const GEOSGeometry* noded_lines = noded.get();
    const auto polygons = geos_->own(GEOSPolygonize_r(context, &noded_lines, 1));
    if (!polygons) return geos_->error();
    std::vector<PlaneFace> faces;
    const int count = GEOSGetNumGeometries_r(context, polygons.get());
    for (int i = 0; i < count; ++i) {
        const GEOSGeometry* polygon = GEOSGetGeometryN_r(context, polygons.get(), i);
        const auto point = geos_->own(GEOSPointOnSurface_r(context, polygon));
        if (!point) return geos_->error();
        PlaneFace face;
        GEOSGeomGetX_r(context, point.get(), &face.inside.x);
        GEOSGeomGetY_r(context, point.get(), &face.inside.y);
        bool within = true;
        const bool clockwise =
            doubled_area(std::array{triangle[0], triangle[1], triangle[2], triangle[0]}) > 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 along = triangle[(k + 1) % 3] - triangle[k], to = face.inside - triangle[k];
            within = within && ((along.x * to.y - along.y * to.x) > 0.0) == clockwise;
        }
        if (!within) continue;
        face.rings = geos_->rings(polygon);
        faces.push_back(std::move(face));
    }
    return faces;
}

Result<std::vector<PlaneTriangle>> FaceCutter::triangles(const PlaneFace& face) {
    if (face.rings.size() == 1 && face.rings[0].size() == 4)
        return std::vector<PlaneTriangle>{{face.rings[0][0], face.rings[0][2], face.rings[0][1]}};
    GEOSContextHandle_t context = geos_->context.get();
    GEOSGeometry* around = geos_->ring(face.rings[0]);
    std::vector<GEOSGeometry*> holes;
    for (std::size_t i = 1; i < face.rings.size(); ++i) holes.push_back(geos_->ring(face.rings[i]));
    const auto polygon = geos_->own(
        GEOSGeom_createPolygon_r(context, around, holes.data(), static_cast<unsigned int>(holes.size())));
    if (!polygon) return geos_->error();
    const auto parts = geos_->own(GEOSConstrainedDelaunayTriangulation_r(context, polygon.get()));
    if (!parts) return geos_->error();
    std::vector<PlaneTriangle> triangles;
    const int count = GEOSGetNumGeometries_r(context, parts.get());
    for (int i = 0; i < count; ++i) {
        const auto rings = geos_->rings(GEOSGetGeometryN_r(context, parts.get(), i));
        triangles.push_back({rings[0][0], rings[0][2], rings[0][1]});  // anticlockwise
    }
    return triangles;
}

Result<std::vector<std::array<std::size_t, 3>>> triangles_between(std::span<const glm::dvec2> points) {
    std::vector<std::array<std::size_t, 3>> triangles;
    if (points.size() < 3) return triangles;
    const FaceCutter::Geos geos;
    GEOSContextHandle_t context = geos.context.get();
    const auto all = geos.own(geos.line(points));
    if (!all) return geos.error();
    const auto made = geos.own(GEOSDelaunayTriangulation_r(context, all.get(), 0.0, 0));
    if (!made) return geos.error();
    // Corners are the points themselves, to the bit.
    std::map<std::pair<double, double>, std::size_t> number_of;
    for (std::size_t i = 0; i < points.size(); ++i) number_of.try_emplace({points[i].x, points[i].y}, i);
    const int count = GEOSGetNumGeometries_r(context, made.get());
    for (int i = 0; i < count; ++i) {
        const auto rings = geos.rings(GEOSGetGeometryN_r(context, made.get(), i));
        if (rings.empty() || rings.front().size() != 4) continue;
        std::array<std::size_t, 3> triangle{};
        bool known = true;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto found = number_of.find({rings.front()[corner].x, rings.front()[corner].y});
            known = known && found != number_of.end();
            if (known) triangle[corner] = found->second;
        }
        if (known) triangles.push_back(triangle);
    }
    return triangles;
}

}  // namespace oro

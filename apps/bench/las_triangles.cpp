#include "apps/bench/las_triangles.h"

#include <ogr_geometry.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

namespace oro {
namespace {

template <class Value>
Value value_at(const std::string& bytes, std::size_t at) {
    Value value{};
    std::memcpy(&value, bytes.data() + at, sizeof(Value));
    return value;
}

// Source: ASPRS, LAS specification 1.2, public header block.
Result<std::vector<glm::dvec3>> points_of(const std::string& path, const std::string& bytes) {
    constexpr std::size_t header_bytes = 227;
    if (bytes.size() < header_bytes || bytes.compare(0, 4, "LASF") != 0)
        return Error{ErrorKind::failed, path, "is no LAS file"};
    const std::size_t first = value_at<std::uint32_t>(bytes, 96), count = value_at<std::uint32_t>(bytes, 107),
                      size = value_at<std::uint16_t>(bytes, 105);
    if (size < 12 || first + count * size > bytes.size())
        return Error{ErrorKind::failed, path,
                     "is cut off: it should have " + std::to_string(count) + " points"};
    std::vector<glm::dvec3> points(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            points[i][static_cast<int>(axis)] =
                value_at<double>(bytes, 155 + 8 * axis) +
                value_at<double>(bytes, 131 + 8 * axis) *
                    static_cast<double>(value_at<std::int32_t>(bytes, first + i * size + 4 * axis));
    return points;
}

}  // namespace

Result<SourceMesh> triangles_of_las(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return Error{ErrorKind::failed, path, "cannot be read"};
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    ORO_TRY(const std::vector<glm::dvec3> points, points_of(path, bytes));
    SourceMesh mesh;
    mesh.path = path, mesh.format = "LAS", mesh.kind = MeshKind::survey;
    std::map<std::pair<double, double>, std::uint32_t> numbers;
    OGRMultiPoint all;
    for (const glm::dvec3& point : points) {
        const auto number = static_cast<std::uint32_t>(mesh.vertices.size());
        if (!numbers.try_emplace({point.x, point.y}, number).second) continue;
        mesh.vertices.push_back(point);
        OGRPoint one(point.x, point.y);
        all.addGeometry(&one);
    }
    const std::unique_ptr<OGRGeometry> made(all.DelaunayTriangulation(0.0, FALSE));
    if (!made) return Error{ErrorKind::failed, path, "cannot be triangulated"};
    for (const OGRGeometry* const one : *made->toGeometryCollection()) {
        const OGRLinearRing* const ring = one->toPolygon()->getExteriorRing();
        SourceTriangle corners{};
        for (int i = 0; i < 3; ++i)
            corners[static_cast<std::size_t>(i)] = numbers.at({ring->getX(i), ring->getY(i)});
        if (ring->isClockwise() != 0) std::swap(corners[1], corners[2]);
        mesh.triangles.push_back(corners);
    }
    if (mesh.triangles.empty()) return Error{ErrorKind::failed, path, "has no triangle"};
    return mesh;
}

}  // namespace oro

// A scan from the air as a mesh: Delaunay's triangles between its points.
#pragma once

#include <ogr_geometry.h>

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "tests/geo/tilesets/level_tiles.h"
#include "tests/support/test_data.h"

namespace oro::test {

// The points of a LAS file, in metres from the first. Source: ASPRS, LAS specification 1.2, public header.
inline std::vector<glm::dvec3> points_of_las(const std::filesystem::path& path, double metres) {
    const std::string bytes = all_bytes(path);
    const auto first = value_at<std::uint32_t>(bytes, 96), count = value_at<std::uint32_t>(bytes, 107);
    const auto size = value_at<std::uint16_t>(bytes, 105);
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        glm::dvec3& point = points.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t from = value_at<std::int32_t>(bytes, first + 4 * axis);
            const std::int64_t at = value_at<std::int32_t>(bytes, first + i * size + 4 * axis);
            point[static_cast<int>(axis)] =
                metres * static_cast<double>(at - from) * value_at<double>(bytes, 131 + 8 * axis);
        }
    }
    return points;
}

// Delaunay's triangles in plan; of points over each other the first.
inline SpaceMesh triangulated(const std::vector<glm::dvec3>& points) {
    std::map<std::pair<double, double>, std::uint32_t> numbers;
    SpaceMesh mesh;
    OGRMultiPoint all;
    for (const glm::dvec3& point : points)
        if (numbers.try_emplace({point.x, point.y}, static_cast<std::uint32_t>(mesh.vertices.size()))
                .second) {
            mesh.vertices.push_back(point);
            OGRPoint one(point.x, point.y);
            all.addGeometry(&one);
        }
    const std::unique_ptr<OGRGeometry> made(all.DelaunayTriangulation(0.0, FALSE));
    if (!made) return mesh;
    for (const OGRGeometry* const one : *made->toGeometryCollection()) {
        const OGRLinearRing* const ring = one->toPolygon()->getExteriorRing();
        std::array<std::uint32_t, 3> corners{};
        for (int i = 0; i < 3; ++i)
            corners[static_cast<std::size_t>(i)] = numbers.at({ring->getX(i), ring->getY(i)});
        if (ring->isClockwise() != 0) std::swap(corners[1], corners[2]);
        mesh.triangles.push_back(corners);
    }
    return mesh;
}

// Of autzen_trim.las, which is in feet: metres from its first point; nothing where it is not there.
inline std::optional<SpaceMesh> airborne_scan() {
    const auto file = real_data("meshes/autzen_trim.las");
    if (!file) return std::nullopt;
    constexpr double foot_m = 0.3048;
    return triangulated(points_of_las(*file, foot_m));
}

}  // namespace oro::test

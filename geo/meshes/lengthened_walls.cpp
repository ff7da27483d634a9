#include "geo/meshes/lengthened_walls.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/earth/ellipsoid.h"
#include "geo/meshes/ground_below.h"

namespace oro {
namespace {

using Side = std::pair<std::uint32_t, std::uint32_t>;

// A triangle's normal as long as twice its area, in the axes east, north and up of its first corner.
glm::dvec3 level_normal(const PlacedMesh& mesh, const SourceTriangle& triangle) {
    std::array<glm::dvec3, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) {
        const PlacedVertex& vertex = mesh.vertices[triangle[i]];
        at[i] = ecef_from_geodetic({vertex.lat_deg, vertex.lon_deg, vertex.H_m}).m;
    }
    const PlacedVertex& first = mesh.vertices[triangle[0]];
    return glm::transpose(ecef_from_enu(first.lat_deg, first.lon_deg)) *
           glm::cross(at[1] - at[0], at[2] - at[0]);
}

// The triangles of one building.
class BuildingWalls {
  public:
    BuildingWalls(const PlacedMesh& mesh, std::span<const std::size_t> triangles) : mesh_(mesh) {
        lowest_H_m_ = mesh.vertices[mesh.triangles[triangles.front()][0]].H_m;
        for (const std::size_t number : triangles)
            for (const std::uint32_t corner : mesh.triangles[number])
                lowest_H_m_ = std::min(lowest_H_m_, mesh.vertices[corner].H_m);
        for (const std::size_t number : triangles) add(mesh.triangles[number]);
    }

    [[nodiscard]] double lowest_H_m() const { return lowest_H_m_; }
    [[nodiscard]] const std::set<Side>& feet() const { return feet_; }

    // Under all that is not upright.
    [[nodiscard]] std::optional<double> lowest_ground(std::span<const HeightField* const> fields) const {
        std::optional<double> lowest;
        for (const SourceTriangle& triangle : level_) {
            std::vector<VectorPlace> ring;
            for (const std::uint32_t corner : triangle)
                ring.push_back({mesh_.vertices[corner].lat_deg, mesh_.vertices[corner].lon_deg});
            const std::optional<double> H_m = lowest_ground_H_m({ring}, fields);
            if (H_m) lowest = std::min(lowest.value_or(*H_m), *H_m);
        }
        return lowest;
    }

  private:
    void add(const SourceTriangle& triangle) {
        const glm::dvec3 normal = level_normal(mesh_, triangle);
        constexpr double upright = 0.02;  // within 1.1 degrees
        if (std::abs(normal.z) > upright * glm::length(normal)) {
            level_.push_back(triangle);
            return;
        }
        constexpr double foot_m = 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
            const PlacedVertex &one = mesh_.vertices[a], &other = mesh_.vertices[b];
            const bool has_length = one.lat_deg != other.lat_deg || one.lon_deg != other.lon_deg;
            if (has_length && std::max(one.H_m, other.H_m) <= lowest_H_m_ + foot_m)
                feet_.insert({std::min(a, b), std::max(a, b)});
        }
    }

    const PlacedMesh& mesh_;
    double lowest_H_m_{};
    std::vector<SourceTriangle> level_;
    std::set<Side> feet_;
};

void lead_down(const std::set<Side>& feet, double bottom_H_m, std::uint32_t feature, PlacedMesh& mesh) {
    std::map<std::uint32_t, std::uint32_t> below;
    const auto under = [&](std::uint32_t vertex) {
        const auto [found, is_new] =
            below.try_emplace(vertex, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (is_new) {
            const PlacedVertex& foot = mesh.vertices[vertex];
            mesh.vertices.push_back({foot.lat_deg, foot.lon_deg, bottom_H_m});
        }
        return found->second;
    };
    for (const auto& [a, b] : feet) {
        const std::uint32_t under_a = under(a), under_b = under(b);
        mesh.triangles.push_back({a, under_a, under_b});
        mesh.triangles.push_back({a, under_b, b});
        mesh.feature_of.insert(mesh.feature_of.end(), 2, feature);
    }
}

}  // namespace

void lengthen_walls(std::span<const HeightField* const> fields, PlacedMesh& mesh) {
    if (mesh.kind != MeshKind::city_model || mesh.feature_of.empty() || fields.empty()) return;
    std::vector<std::vector<std::size_t>> triangles_of(mesh.features.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) triangles_of[mesh.feature_of[i]].push_back(i);
    for (std::uint32_t feature = 0; feature < mesh.features.size(); ++feature) {
        const std::string& type = mesh.features[feature].type;
        if ((type != "Building" && type != "BuildingPart") || triangles_of[feature].empty()) continue;
        const BuildingWalls walls(mesh, triangles_of[feature]);
        const std::optional<double> ground_H_m = walls.lowest_ground(fields);
        if (!ground_H_m || walls.feet().empty() || walls.lowest_H_m() <= *ground_H_m) continue;
        const double bottom_H_m = *ground_H_m - walls_below_ground_m;
        lead_down(walls.feet(), bottom_H_m, feature, mesh);
        ++mesh.lengthened;
        mesh.most_lengthened_m = std::max(mesh.most_lengthened_m, walls.lowest_H_m() - bottom_H_m);
    }
}

}  // namespace oro

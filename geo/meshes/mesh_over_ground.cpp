#include "geo/meshes/mesh_over_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace oro {
namespace {

std::optional<double> ground_H_m(const HeightField& field, double lat_deg, double lon_deg) {
    const PostNumber at = field.grid.post_at(lat_deg, lon_deg);
    const double row = std::floor(at.row), column = std::floor(at.column);
    if (!(row >= 0.0 && column >= 0.0 && row + 1.0 < field.grid.rows() &&
          column + 1.0 < field.grid.columns()))
        return std::nullopt;
    const int r = static_cast<int>(row), c = static_cast<int>(column);
    const float nw = field.H_at_post_m(r, c), ne = field.H_at_post_m(r, c + 1),
                sw = field.H_at_post_m(r + 1, c), se = field.H_at_post_m(r + 1, c + 1);
    if (is_void(nw) || is_void(ne) || is_void(sw) || is_void(se)) return std::nullopt;
    const double down = at.row - row, right = at.column - column;
    return std::lerp(std::lerp(static_cast<double>(nw), static_cast<double>(ne), right),
                     std::lerp(static_cast<double>(sw), static_cast<double>(se), right), down);
}

}  // namespace

std::optional<MeshOverGround> mesh_over_ground(const PlacedMesh& mesh,
                                               std::span<const HeightField* const> fields) {
    constexpr std::size_t most_asked = 10000;
    std::vector<bool> is_used(mesh.vertices.size());
    const std::size_t own = mesh.not_added > 0 ? mesh.not_added : mesh.triangles.size();
    for (const SourceTriangle& triangle : std::span(mesh.triangles).first(own))
        for (const std::uint32_t corner : triangle) is_used[corner] = true;
    const auto used = static_cast<std::size_t>(std::ranges::count(is_used, true));
    MeshOverGround over;
    std::vector<double> above_m;
    const std::size_t stride = used / most_asked + 1;
    std::size_t number = 0;  // among those that are used
    for (std::size_t i = 0; i < is_used.size(); ++i) {
        if (!is_used[i] || number++ % stride != 0) continue;
        const PlacedVertex& vertex = mesh.vertices[i];
        for (const HeightField* const field : fields) {
            const std::optional<double> H_m = ground_H_m(*field, vertex.lat_deg, vertex.lon_deg);
            if (!H_m) continue;
            if (above_m.empty() && !field->undulation.N_m.empty())
                over.N_m = field->undulation.at_m(vertex.lat_deg, vertex.lon_deg);
            above_m.push_back(vertex.H_m - *H_m);
            break;
        }
    }
    if (above_m.empty()) return std::nullopt;
    const auto middle = above_m.begin() + static_cast<std::ptrdiff_t>(above_m.size() / 2);
    std::nth_element(above_m.begin(), middle, above_m.end());
    over.median_m = *middle;
    over.vertices = above_m.size();
    return over;
}

bool is_over_ground_swapped(const PlacedMesh& mesh, std::span<const HeightField* const> fields) {
    if (mesh.triangles.empty()) return false;
    const PlacedVertex& first = mesh.vertices[mesh.triangles.front()[0]];
    return std::abs(first.lon_deg) <= 90.0 && std::ranges::any_of(fields, [&](const HeightField* field) {
               return ground_H_m(*field, first.lon_deg, first.lat_deg).has_value();
           });
}

std::string words_of(const std::optional<MeshOverGround>& over, const std::string& geoid,
                     const std::string& what_lies) {
    if (!over) return "no vertex of it lies over terrain";
    char text[200];
    std::snprintf(text, sizeof text, "%s %.1f m %s the terrain in the median", what_lies.c_str(),
                  std::abs(over->median_m), over->median_m < 0.0 ? "under" : "over");
    constexpr double like_N_m = 2.0, least_N_m = 5.0;
    const bool floats = std::abs(over->median_m - over->N_m) < like_N_m,
               is_sunk = std::abs(over->median_m + over->N_m) < like_N_m;
    if (std::abs(over->N_m) < least_N_m || !(floats || is_sunk)) return text;
    char why[200];
    std::snprintf(why, sizeof why, ", and %s is %.1f m there: are its heights above %s? (--mesh-crs tells)",
                  geoid.c_str(), over->N_m, floats ? "the ellipsoid" : "sea level");
    return std::string(text) + why;
}

}  // namespace oro

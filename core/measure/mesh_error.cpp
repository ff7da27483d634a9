#include "core/measure/mesh_error.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace oro {
namespace {

TrueMesh pieces_of(const TrueGround& ground) {
    MeshTriangles all;
    for (const SurfaceTriangle& piece : ground.pieces()) {
        const auto first = static_cast<std::uint32_t>(all.vertices_m.size());
        for (const Geodetic& corner : piece.corners) all.vertices_m.push_back(ecef_from_geodetic(corner).m);
        all.triangles.push_back({first, first + 1, first + 2});
    }
    return {std::move(all), 0, 1};
}

// The nearest place of some meshes to a point, if it is nearer than `away_m`, which is then how far it is.
void look_nearer(const TrueMesh& mesh, const glm::dvec3& at_m, std::optional<glm::dvec3>& nearest,
                 double& away_m) {
    const auto place = mesh.nearest_m(at_m, away_m);
    if (!place) return;
    nearest = place;
    away_m = glm::distance(*place, at_m);
}

}  // namespace

MeshMeter::MeshMeter(const TrueGround& ground, const Sight& sight, const GroundMeter& meter,
                     std::span<const TrueMesh> drawn)
    : ground_(ground), sight_(sight), meter_(meter), drawn_(drawn), pieces_(pieces_of(ground)) {}

Distance MeshMeter::apart(const glm::dvec3& drawn_m, const glm::dvec3& true_m) const {
    const GroundMeter::Apart on_picture = meter_.apart(sight_.refraction.apparent_m(drawn_m - sight_.eye.m),
                                                       sight_.refraction.apparent_m(true_m - sight_.eye.m));
    return {glm::distance(drawn_m, true_m), on_picture.px, on_picture.at_least};
}

Distance MeshMeter::from_true(const glm::dvec2& point_px, const DrawnPoint& point) const {
    const glm::dvec3 drawn_m = sight_.eye.m + sight_.refraction.true_m(meter_.offset_m(point_px, point.z_m));
    std::optional<glm::dvec3> nearest;
    double away_m = HUGE_VAL;
    for (const TrueMesh& mesh : ground_.meshes()) look_nearer(mesh, drawn_m, nearest, away_m);
    look_nearer(pieces_, drawn_m, nearest, away_m);
    return nearest ? apart(drawn_m, *nearest) : Distance{};
}

Distance MeshMeter::from_drawn(const Geodetic& seen) const {
    const glm::dvec3 true_m = ecef_from_geodetic(seen).m;
    std::optional<glm::dvec3> nearest;
    double away_m = HUGE_VAL;
    for (const TrueMesh& mesh : drawn_) look_nearer(mesh, true_m, nearest, away_m);
    look_nearer(pieces_, true_m, nearest, away_m);
    const Distance from_meshes =
        nearest ? apart(*nearest, true_m) : Distance{away_m, meter_.diagonal_px(), true};
    return meter_.from_ground(true_m, sight_.refraction.apparent_m(true_m - sight_.eye.m), 0, from_meshes);
}

}  // namespace oro

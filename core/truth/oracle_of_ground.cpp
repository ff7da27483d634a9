// What the oracle is made of, and what it is asked.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/base/parallel.h"
#include "core/truth/oracle.h"
#include "core/truth/oracle_scenery.h"
#include "core/truth/triangle_bvh.h"

namespace oro {
namespace {

// Where the model of the Earth puts a point: from the eye, straight light, ECEF axes.
glm::dvec3 offset_m(const Sight& sight, const Geodetic& point) {
    if (sight.earth == Earth::ellipsoid) return ecef_from_geodetic(point).m - sight.eye.m;
    return model_offset_m(sight.earth, sight.place, point);
}

// Its sides are straight, and those of cells as curved as the ellipsoid: it is made higher and lower by the
// difference, an eighth of its angle squared times the radius.
std::array<glm::dvec3, 3> seen_corners(const Sight& sight, const SurfaceTriangle& piece) {
    double lowest_h_m = piece.corners[0].h_m, highest_h_m = lowest_h_m, length_m = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Geodetic &one = piece.corners[i], &next = piece.corners[(i + 1) % 3];
        lowest_h_m = std::min(lowest_h_m, one.h_m);
        highest_h_m = std::max(highest_h_m, one.h_m);
        length_m = std::max(length_m, glm::length(ecef_from_geodetic({one.lat_deg, one.lon_deg, 0.0}).m -
                                                  ecef_from_geodetic({next.lat_deg, next.lon_deg, 0.0}).m));
    }
    const double reach_m = piece.mesh > 0 ? 0.0 : 1.0e-5 + 1.1 * length_m * length_m / (8.0 * wgs84_a_m);
    std::array<glm::dvec3, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
        Geodetic corner = piece.corners[i];
        corner.h_m += corner.h_m < 0.5 * (lowest_h_m + highest_h_m) ? -reach_m : reach_m;
        corners[i] = sight.refraction.apparent_m(offset_m(sight, corner));
    }
    return corners;
}

// On the flat Earth the plane is cut at the meridian opposite to the eye.
bool crosses_cut(const Sight& sight, const SurfaceTriangle& piece) {
    if (sight.earth != Earth::flat) return false;
    constexpr double half_turn_deg = 180.0;
    const auto from_eye_deg = [&](std::size_t i) {
        return std::remainder(piece.corners[i].lon_deg - sight.place.lon_deg, 360.0);
    };
    return std::abs(from_eye_deg(0) - from_eye_deg(1)) > half_turn_deg ||
           std::abs(from_eye_deg(1) - from_eye_deg(2)) > half_turn_deg;
}

// A triangle of a mesh as other Earths place it.
SurfaceTriangle as_piece(const TrueMesh& mesh, std::size_t triangle) {
    SurfaceTriangle piece;
    const std::array<glm::dvec3, 3> corners = mesh.corners_m(triangle);
    for (std::size_t i = 0; i < 3; ++i) piece.corners[i] = geodetic_from_ecef({corners[i]});
    piece.mesh = mesh.number();
    return piece;
}

std::unique_ptr<const TriangleBvh> tree_of(const TrueGround& ground, const Sight& sight) {
    std::vector<std::array<glm::dvec3, 3>> triangles;
    std::vector<std::uint32_t> numbers;
    std::uint32_t number = 0;
    std::optional<Geodetic> first;
    const auto add = [&](const SurfaceTriangle& piece) {
        if (!first) first = piece.corners[0];
        if (!crosses_cut(sight, piece)) {
            triangles.push_back(seen_corners(sight, piece));
            numbers.push_back(number);
        }
        ++number;
    };
    for (const SurfaceTriangle& piece : ground.pieces()) add(piece);
    if (sight.earth != Earth::ellipsoid)
        for (const TrueMesh& mesh : ground.meshes())
            for (std::size_t i = 0; i < mesh.size(); ++i) add(as_piece(mesh, i));
    if (!first) return nullptr;
    return std::make_unique<const TriangleBvh>(
        std::move(triangles), ecef_from_enu(first->lat_deg, first->lon_deg), std::move(numbers));
}

}  // namespace

Oracle::Oracle(const TrueGround& ground, const Sight& sight) : ground_(ground), sight_(sight) {
    for (std::size_t grid = 0; grid < ground_.grids(); ++grid)
        sceneries_.push_back(std::make_unique<const Scenery>(ground_, grid, sight_));
    pieces_ = tree_of(ground_, sight_);
}

Oracle::~Oracle() = default;

Oracle::OfMesh Oracle::of_piece(std::size_t number) const {
    const std::vector<SurfaceTriangle>& pieces = ground_.pieces();
    if (number < pieces.size()) return {pieces[number].mesh, pieces[number].feature};
    number -= pieces.size();
    for (const TrueMesh& mesh : ground_.meshes()) {
        if (number < mesh.size()) return {mesh.number(), mesh.feature(number)};
        number -= mesh.size();
    }
    return {};
}

SightHit Oracle::hit_beside(const glm::dvec3& apparent_m, double t_m, const OfMesh& of) const {
    const glm::dvec3 true_m = sight_.refraction.true_m(apparent_m);
    SightHit hit;
    hit.point = sight_.earth == Earth::ellipsoid
                    ? geodetic_from_ecef({sight_.eye.m + true_m})
                    : model_point(sight_.earth, sight_.place, true_m).value_or(Geodetic{});
    hit.distance_m = t_m;
    hit.between_grids = true;
    hit.mesh = of.mesh, hit.feature = of.feature;
    hit.grid = ground_.grid_at(hit.point.lat_deg, hit.point.lon_deg).value_or(0);
    const PostGrid& posts = ground_.surface(hit.grid).field().grid;
    const PostNumber post = posts.post_at(hit.point.lat_deg, hit.point.lon_deg);
    hit.row = std::clamp(static_cast<int>(std::floor(post.row)), 0, posts.rows() - 2);
    hit.column = std::clamp(static_cast<int>(std::floor(post.column)), 0, posts.columns() - 2);
    const Diagonal diagonal = ground_.surface(hit.grid).diagonal_at(hit.row, hit.column);
    hit.west = west_of_diagonal(diagonal, post.row - hit.row, post.column - hit.column) >= 0.0;
    return hit;
}

std::optional<SightHit> Oracle::first_hit(const glm::dvec3& direction, double reach_m) const {
    return first_hit_after(glm::dvec3(0.0), direction, reach_m);
}

std::optional<SightHit> Oracle::first_hit_from(const Ecef& from, const glm::dvec3& direction,
                                               double reach_m) const {
    assert(sight_.refraction.straight() && sight_.earth == Earth::ellipsoid);
    return first_hit_after(from.m - sight_.eye.m, direction, reach_m);
}

std::vector<std::optional<SightHit>> Oracle::cast_picture(const Camera& camera, int threads) const {
    const double reach_m = sight_reach_m(camera.eye.h_m);
    std::vector<std::optional<SightHit>> hits(static_cast<std::size_t>(camera.width_px) *
                                              static_cast<std::size_t>(camera.height_px));
    in_parallel(camera.height_px, threads, [&](int y) {
        for (int x = 0; x < camera.width_px; ++x) {
            const glm::dvec3 direction = camera.ecef_direction_at({x + 0.5, y + 0.5});
            hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width_px) +
                 static_cast<std::size_t>(x)] = first_hit(direction, reach_m);
        }
    });
    return hits;
}

std::optional<SightHit> first_hit(const TrueGround& ground, const Sight& sight, const glm::dvec3& direction,
                                  double reach_m) {
    return Oracle(ground, sight).first_hit(direction, reach_m);
}

}  // namespace oro

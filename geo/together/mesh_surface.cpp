#include "geo/together/mesh_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "core/base/parallel.h"
#include "core/terrain/page_on_net.h"
#include "geo/meshes/triangle_looks.h"

namespace oro {
namespace {

// A vertex of a mesh as it is drawn: on the lattice.
SeamCorner drawn_vertex(const PlacedVertex& vertex, const UndulationField& undulation, double exaggeration) {
    const Geodetic at = geodetic_of(vertex, undulation, exaggeration);
    SeamCorner corner;
    corner.h_m = at.h_m;
    const LatticePoint point = lattice_point(ecef_from_geodetic(at).m);
    for (int axis = 0; axis < 3; ++axis)
        corner.at.m[axis] =
            static_cast<double>(point.steps[static_cast<std::size_t>(axis)]) * gpu::height_step_m;
    return corner;
}

// Of a corner of a triangle whose look is gpu::mesh_look_coloured.
VertexColour colour_at(const PlacedMesh& mesh, std::size_t triangle, std::size_t corner) {
    return mesh.part_colours.empty() ? mesh.colours[mesh.triangles[triangle][corner]]
                                     : mesh.part_colours[triangle];
}

std::vector<SeamCorner> drawn_vertices(const PlacedMesh& mesh, const UndulationField& undulation,
                                       double exaggeration) {
    std::vector<SeamCorner> corners;
    corners.reserve(mesh.vertices.size());
    for (const PlacedVertex& vertex : mesh.vertices)
        corners.push_back(drawn_vertex(vertex, undulation, exaggeration));
    return corners;
}

// Normals as long as twice a triangle's area, upwards.
std::vector<glm::dvec3> area_normals(const PlacedMesh& mesh, std::span<const glm::dvec3> vertices_m) {
    std::vector<glm::dvec3> normals;
    normals.reserve(mesh.triangles.size());
    for (const SourceTriangle& triangle : mesh.triangles) {
        const glm::dvec3 &a = vertices_m[triangle[0]], &b = vertices_m[triangle[1]],
                         &c = vertices_m[triangle[2]];
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        normals.push_back(glm::dot(normal, a) < 0.0 ? -normal : normal);
    }
    return normals;
}

// The triangles around each vertex, one list after the other.
struct TrianglesAround {
    std::vector<std::size_t> first;  // of each vertex, and the end
    std::vector<std::size_t> triangles;

    explicit TrianglesAround(const PlacedMesh& mesh) : first(mesh.vertices.size() + 1) {
        for (const SourceTriangle& triangle : mesh.triangles)
            for (const std::uint32_t corner : triangle) ++first[corner + 1];
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        triangles.resize(first.back());
        std::vector<std::size_t> next(first.begin(), first.end() - 1);
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (const std::uint32_t corner : mesh.triangles[i]) triangles[next[corner]++] = i;
    }
};

// The mean of the normals around a vertex that are within the crease's angle of a triangle's own.
glm::dvec3 normal_at(const TrianglesAround& around, const std::vector<glm::dvec3>& normals,
                     std::uint32_t vertex, std::size_t triangle, double least_cosine) {
    constexpr std::size_t most_around = 64;
    const glm::dvec3 own = normals[triangle];
    const std::size_t begin = around.first[vertex], end = around.first[vertex + 1];
    if (end - begin > most_around || least_cosine >= 1.0) return glm::normalize(own);
    glm::dvec3 sum(0.0);
    for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec3& other = normals[around.triangles[i]];
        const double cosine = glm::dot(own, other) / (glm::length(own) * glm::length(other));
        // Upright ones may have been turned either way.
        if (std::abs(cosine) >= least_cosine) sum += cosine < 0.0 ? -other : other;
    }
    return glm::normalize(sum);
}

glm::dvec3 up_at(const Ecef& at) {
    return glm::normalize(at.m / glm::dvec3(1.0, 1.0, 1.0 - wgs84_e2));
}

// Of all triangles around a vertex, by their areas; upwards where they have none, or there are none.
glm::dvec3 mean_normal_at(const TrianglesAround& around, const std::vector<glm::dvec3>& normals,
                          std::uint32_t vertex, const Ecef& at) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = around.first[vertex]; i < around.first[vertex + 1]; ++i)
        sum += normals[around.triangles[i]];
    return glm::length(sum) > 0.0 ? glm::normalize(sum) : up_at(at);
}

double least_cosine_of(const PlacedMesh& mesh) {
    return std::cos(mesh.crease_deg * std::numbers::pi / 180.0);
}

// Where the surfaces on both sides of a wall change places: the share of the way along it; none where they do
// not.
std::optional<double> meeting_of(const RimWall& wall, const std::vector<SeamCorner>& corners) {
    const double begin_m = corners[wall.over[0]].h_m - corners[wall.cut[0]].h_m,
                 end_m = corners[wall.over[1]].h_m - corners[wall.cut[1]].h_m;
    if (begin_m * end_m >= 0.0) return std::nullopt;
    return begin_m / (begin_m - end_m);
}

// Upright ground between a mesh that the terrain is cut out under and what is left of that: it closes the
// gaps that levels leave, too. By the corners of either side. What the wall's first side bounds lies on its
// right hand.
SeamSkirt skirt_of_wall(std::array<SeamCorner, 2> cut, std::array<SeamCorner, 2> over) {
    SeamSkirt skirt;
    skirt.of_mesh = true;
    skirt.up = up_at(cut[0].at);
    const glm::dvec3 left = glm::cross(skirt.up, cut[1].at.m - cut[0].at.m);
    skirt.side = glm::length(left) > 0.0 ? glm::normalize(left) : glm::dvec3(0.0);
    for (std::size_t end = 0; end < 2; ++end) {
        const bool is_higher = cut[end].h_m >= over[end].h_m;
        skirt.top[end] = is_higher ? cut[end] : over[end];
        skirt.foot[end] = is_higher ? over[end] : cut[end];
    }
    return skirt;
}

// corners: with the normals of the ground that they bound, by which a wall is lit that is no more than a
// line.
void add_skirts(const RimWall& wall, const std::vector<SeamCorner>& corners, std::vector<SeamSkirt>& skirts) {
    const std::array cut{corners[wall.cut[0]], corners[wall.cut[1]]},
        over{corners[wall.over[0]], corners[wall.over[1]]};
    const auto share = meeting_of(wall, corners);
    if (!share) {
        skirts.push_back(skirt_of_wall(cut, over));
        return;
    }
    const SeamCorner meeting{{glm::mix(cut[0].at.m, cut[1].at.m, *share)},
                             std::lerp(cut[0].h_m, cut[1].h_m, *share),
                             cut[0].normal};
    skirts.push_back(skirt_of_wall({cut[0], meeting}, {over[0], meeting}));
    skirts.push_back(skirt_of_wall({meeting, cut[1]}, {meeting, over[1]}));
}

// The same as sight lines meet it: two triangles, or where the surfaces change places between the ends one on
// either side of where they meet.
void add_rim_wall(const RimWall& wall, const std::vector<SeamCorner>& corners, std::uint32_t number,
                  std::vector<SurfaceTriangle>& pieces) {
    const SeamCorner &a = corners[wall.cut[0]], &b = corners[wall.cut[1]], &over_a = corners[wall.over[0]],
                     &over_b = corners[wall.over[1]];
    const double begin_m = over_a.h_m - a.h_m, end_m = over_b.h_m - b.h_m;
    constexpr double least_m = 1.0e-6;
    if (std::abs(begin_m) < least_m && std::abs(end_m) < least_m) return;
    const auto add = [&](const glm::dvec3& first, const glm::dvec3& second, const glm::dvec3& third) {
        SurfaceTriangle piece;
        piece.corners = {geodetic_from_ecef(Ecef{first}), geodetic_from_ecef(Ecef{second}),
                         geodetic_from_ecef(Ecef{third})};
        piece.mesh = number;
        pieces.push_back(piece);
    };
    const auto share = meeting_of(wall, corners);
    if (!share) {
        add(a.at.m, b.at.m, over_b.at.m);
        add(a.at.m, over_b.at.m, over_a.at.m);
        return;
    }
    const glm::dvec3 meeting = glm::mix(a.at.m, b.at.m, *share);
    add(a.at.m, meeting, over_a.at.m);
    add(b.at.m, over_b.at.m, meeting);
}

}  // namespace

std::vector<glm::dvec3> drawn_places_m(const PlacedMesh& mesh, const UndulationField& undulation,
                                       double exaggeration) {
    std::vector<glm::dvec3> places(mesh.vertices.size());
    drawn_places_m(mesh, undulation, exaggeration, places);
    return places;
}

void drawn_places_m(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration,
                    std::span<glm::dvec3> places_m) {
    in_chunks(places_m.size(), thread_count(), [&](std::size_t i) {
        places_m[i] = drawn_vertex(mesh.vertices[i], undulation, exaggeration).at.m;
    });
}

PlacedVertex vertex_on_lattice(const LatticeSteps& at, const UndulationField& undulation) {
    const Geodetic place = geodetic_from_ecef(Ecef{{static_cast<double>(at[0]) / lattice_steps_per_m,
                                                    static_cast<double>(at[1]) / lattice_steps_per_m,
                                                    static_cast<double>(at[2]) / lattice_steps_per_m}});
    const double N_m = undulation.N_m.empty() ? 0.0 : undulation.at_m(place.lat_deg, place.lon_deg);
    return {place.lat_deg, place.lon_deg, place.h_m - N_m};
}

void add_mesh(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration, Seam& seam) {
    const TriangleLooks looks(mesh);
    std::vector<SeamCorner> corners = drawn_vertices(mesh, undulation, exaggeration);
    std::vector<glm::dvec3> vertices_m;
    vertices_m.reserve(corners.size());
    for (const SeamCorner& corner : corners) vertices_m.push_back(corner.at.m);
    const std::vector<glm::dvec3> normals = area_normals(mesh, vertices_m);
    const TrianglesAround around(mesh);
    const double least_cosine = least_cosine_of(mesh);
    for (std::size_t number = 0; number < mesh.triangles.size(); ++number) {
        if (normals[number] == glm::dvec3(0.0)) continue;
        SeamPiece piece;
        piece.two_sided = true;
        const TriangleLook look = looks.of(number);
        piece.look = look.look, piece.tone = look.tone;
        if (look.look == gpu::mesh_look_coloured)
            for (std::size_t i = 0; i < 3; ++i) piece.colours[i] = colour_at(mesh, number, i);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t vertex = mesh.triangles[number][i];
            piece.corners[i] = corners[vertex];
            piece.corners[i].normal = normal_at(around, normals, vertex, number, least_cosine);
        }
        seam.pieces.push_back(piece);
    }
    if (mesh.rim_walls.empty()) return;
    for (std::uint32_t vertex = 0; vertex < corners.size(); ++vertex)
        corners[vertex].normal = mean_normal_at(around, normals, vertex, corners[vertex].at);
    for (const RimWall& wall : mesh.rim_walls) add_skirts(wall, corners, seam.skirts);
}

void add_mesh(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration,
              std::uint32_t number, std::vector<SurfaceTriangle>& pieces) {
    const std::vector<SeamCorner> corners = drawn_vertices(mesh, undulation, exaggeration);
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        SurfaceTriangle piece;
        for (std::size_t i = 0; i < 3; ++i)
            piece.corners[i] = geodetic_from_ecef(corners[mesh.triangles[k][i]].at);
        piece.mesh = number;
        piece.feature = mesh.feature_of.empty() ? 0 : mesh.feature_of[k] + 1;
        pieces.push_back(piece);
    }
    for (const RimWall& wall : mesh.rim_walls) add_rim_wall(wall, corners, number, pieces);
}

MeshTriangles true_triangles(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration) {
    MeshTriangles all;
    all.vertices_m = drawn_places_m(mesh, undulation, exaggeration);
    all.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    all.features.reserve(mesh.feature_of.size());
    for (const std::uint32_t feature : mesh.feature_of) all.features.push_back(feature + 1);
    return all;
}

void add_rim_walls(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration,
                   std::uint32_t number, std::vector<SurfaceTriangle>& pieces) {
    if (mesh.rim_walls.empty()) return;
    const std::vector<SeamCorner> corners = drawn_vertices(mesh, undulation, exaggeration);
    for (const RimWall& wall : mesh.rim_walls) add_rim_wall(wall, corners, number, pieces);
}

std::vector<std::array<glm::vec3, 3>> corner_normals(const PlacedMesh& mesh,
                                                     std::span<const glm::dvec3> vertices_m) {
    const std::vector<glm::dvec3> normals = area_normals(mesh, vertices_m);
    const TrianglesAround around(mesh);
    const double least_cosine = least_cosine_of(mesh);
    std::vector<std::array<glm::vec3, 3>> corners(mesh.triangles.size());
    for (std::size_t number = 0; number < mesh.triangles.size(); ++number) {
        if (normals[number] == glm::dvec3(0.0)) continue;
        for (std::size_t i = 0; i < 3; ++i)
            corners[number][i] = normal_at(around, normals, mesh.triangles[number][i], number, least_cosine);
    }
    return corners;
}

}  // namespace oro

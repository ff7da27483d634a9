#include "geo/together/mesh_surface.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/terrain/page_on_net.h"

namespace oro {
namespace {

// Vertices of a mesh as they are drawn: on the lattice.
std::vector<SeamCorner> drawn_vertices(const PlacedMesh& mesh, const UndulationField& undulation,
                                       double exaggeration) {
    std::vector<SeamCorner> corners;
    corners.reserve(mesh.vertices.size());
    for (const PlacedVertex& vertex : mesh.vertices) {
        const double N_m = undulation.N_m.empty() ? 0.0 : undulation.at_m(vertex.lat_deg, vertex.lon_deg);
        SeamCorner corner;
        corner.h_m = vertex.H_m * exaggeration + N_m;
        const LatticePoint point =
            lattice_point(ecef_from_geodetic({vertex.lat_deg, vertex.lon_deg, corner.h_m}).m);
        for (int axis = 0; axis < 3; ++axis)
            corner.at.m[axis] =
                static_cast<double>(point.steps[static_cast<std::size_t>(axis)]) * gpu::height_step_m;
        corners.push_back(corner);
    }
    return corners;
}

// Normals as long as twice a triangle's area, upwards.
std::vector<glm::dvec3> area_normals(const PlacedMesh& mesh, const std::vector<SeamCorner>& corners) {
    std::vector<glm::dvec3> normals;
    normals.reserve(mesh.triangles.size());
    for (const SourceTriangle& triangle : mesh.triangles) {
        const glm::dvec3 &a = corners[triangle[0]].at.m, &b = corners[triangle[1]].at.m,
                         &c = corners[triangle[2]].at.m;
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
                     std::uint32_t vertex, std::size_t triangle) {
    constexpr std::size_t most_around = 64;
    const glm::dvec3 own = normals[triangle];
    const std::size_t begin = around.first[vertex], end = around.first[vertex + 1];
    if (end - begin > most_around) return glm::normalize(own);
    const double least_cosine = std::cos(crease_deg * std::numbers::pi / 180.0);
    glm::dvec3 sum(0.0);
    for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec3& other = normals[around.triangles[i]];
        const double cosine = glm::dot(own, other) / (glm::length(own) * glm::length(other));
        // Upright ones may have been turned either way.
        if (std::abs(cosine) >= least_cosine) sum += cosine < 0.0 ? -other : other;
    }
    return glm::normalize(sum);
}

}  // namespace

std::vector<glm::dvec3> drawn_places_m(const PlacedMesh& mesh, const UndulationField& undulation,
                                       double exaggeration) {
    std::vector<glm::dvec3> places;
    for (const SeamCorner& corner : drawn_vertices(mesh, undulation, exaggeration))
        places.push_back(corner.at.m);
    return places;
}

void add_mesh(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration, Seam& seam) {
    const std::vector<SeamCorner> corners = drawn_vertices(mesh, undulation, exaggeration);
    const std::vector<glm::dvec3> normals = area_normals(mesh, corners);
    const TrianglesAround around(mesh);
    for (std::size_t number = 0; number < mesh.triangles.size(); ++number) {
        if (normals[number] == glm::dvec3(0.0)) continue;
        SeamPiece piece;
        piece.two_sided = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t vertex = mesh.triangles[number][i];
            piece.corners[i] = corners[vertex];
            piece.corners[i].normal = normal_at(around, normals, vertex, number);
        }
        seam.pieces.push_back(piece);
    }
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
}

}  // namespace oro

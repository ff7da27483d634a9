// What is in a mesh: how its triangles meet.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>

#include "geo/meshes/source_mesh.h"

namespace oro {

// Vertices that round to one point of a lattice of 2^-11 m (in the file's own axes; of
// degrees as long as they are near the first vertex) are one vertex here.
struct MeshCensus {
    std::size_t triangles{};      // of the mesh
    std::size_t vertices{};       // that triangles use, after welding
    std::size_t degenerate{};     // triangles without an area on the lattice; they count nowhere below
    std::size_t duplicates{};     // triangles given again, either way round; they count nowhere below
    std::size_t rim_edges{};      // edges of one triangle
    std::size_t rims{};           // closed chains of rim edges
    std::size_t open_chains{};    // chains of rim edges that end at edges of three and more triangles
    std::size_t crowded_edges{};  // edges of three and more triangles
    std::size_t turned_edges{};   // edges of two triangles, one of which is the wrong way round
    glm::dvec3 least{}, most{};   // extent of the triangles' vertices, in the file's units
};

// Counts; the mesh has a triangle, and its vertices are finite. It takes some 70 bytes a triangle. crs: that its
// numbers are in; "": as its file states.
MeshCensus census_of(const SourceMesh& mesh, const std::string& crs = "");

}  // namespace oro

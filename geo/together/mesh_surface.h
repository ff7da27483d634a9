// Meshes of a region as what is drawn between its grids, and as pieces of its true ground.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/mesh_file/stored_mesh.h"
#include "core/seam/seam.h"
#include "core/truth/true_ground.h"
#include "geo/meshes/placed_mesh.h"

namespace oro {

// Where a mesh's vertices are drawn: on the lattice of 2^-11 m, ECEF metres. undulation: N of the region;
// empty: 0.
std::vector<glm::dvec3> drawn_places_m(const PlacedMesh& mesh, const UndulationField& undulation,
                                       double exaggeration);

// The same into an array of as many.
void drawn_places_m(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration,
                    std::span<glm::dvec3> places_m);

// The vertex that is drawn at that place where nothing is exaggerated.
PlacedVertex vertex_on_lattice(const LatticeSteps& at, const UndulationField& undulation);

// Adds a mesh's triangles to what is drawn beside the grids. undulation: N of the region; empty: 0. Normals
// face upwards; at a vertex of more than 64 triangles each has its own. Where the mesh's crease is 0 all
// have.
void add_mesh(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration, Seam& seam);

// Normals at the three corners of each triangle, unit, along the axes that the vertices have (ECEF): upwards,
// smooth where triangles meet within the mesh's crease. Zero of triangles without an area.
std::vector<std::array<glm::vec3, 3>> corner_normals(const PlacedMesh& mesh,
                                                     std::span<const glm::dvec3> vertices_m);

// The same triangles as the true ground has them, without rim walls.
MeshTriangles true_triangles(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration);
// The walls along the rim of what the mesh cuts out of the terrain, as sight lines meet them. number: of the
// mesh in its region, from 1.
void add_rim_walls(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration,
                   std::uint32_t number, std::vector<SurfaceTriangle>& pieces);

// All of them as pieces. Corners are those of the lattice of 2^-11 m that is drawn,
// within 0.43 mm of the mesh.
// number: of the mesh in its region, from 1.
void add_mesh(const PlacedMesh& mesh, const UndulationField& undulation, double exaggeration,
              std::uint32_t number, std::vector<SurfaceTriangle>& pieces);

}  // namespace oro

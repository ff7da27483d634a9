// Cuts of a mesh's graph, held against the mesh by brute force, place by place.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <random>
#include <span>
#include <vector>

#include "core/mesh_graph/mesh_graph.h"
#include "core/mesh_graph/nearest_triangles.h"

namespace oro::test {

struct SpaceMesh {
    std::vector<glm::dvec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// A random place of each triangle, for its chain to be told of.
std::vector<glm::dvec3> random_places(const SpaceMesh& mesh, std::mt19937_64& random);

// Groups that stand by chance, each only where all below it do, and none whose error is above some chance
// one.
std::vector<char> random_standing(const ClusterGraph& graph, std::mt19937_64& random);

struct CutCheck {
    std::uint64_t places{};       // of the mesh, held against what is drawn
    std::uint64_t places_over{};  // farther than the error of the last group that stands on their chain
    std::uint64_t on_ground{};    // of these places, held against the ground
    std::uint64_t drawn{};        // drawn places, held against the mesh
    std::uint64_t drawn_over{};   // farther than the error of the group that made them
    std::uint64_t no_link{};      // steps of chains that are no links of the graph
    std::uint64_t open_edges{};   // edges of one triangle that the mesh does not have on its rim
    // Edges of three triangles and more beyond as many as the mesh has, and one where some edge has more
    // triangles than any of the mesh.
    std::uint64_t crowded{};
    double worst_m{};  // by which the worst place is over
};
// Holds `count` places of the mesh, and one of each drawn triangle up to as many, against brute force by code
// of its own: whether any triangle is within the error and a micrometre.
// ground: the graph's; a place that it answers for, as all groups of its chain stand, is held against the
// ground alone, others against what is drawn alone.
void check_cut(const SpaceMesh& mesh, const MeshGraph& graph, const MeshPlaceChains& chains,
               const std::vector<char>& stands, std::size_t count, std::mt19937_64& random, CutCheck& check,
               const MeshGround* ground = nullptr);

// The corners of triangles, for a tree of them.
std::vector<std::array<glm::dvec3, 3>> corners_of_all(
    const SpaceMesh& mesh, std::span<const std::array<std::uint32_t, 3>> triangles);

// What trees find of many places in many cuts.
struct ManyPlaces {
    std::uint64_t places{}, places_over{};  // as of CutCheck
    std::uint64_t drawn{}, drawn_over{};
    std::vector<double> farthest_m;  // of each group: of the places that it answers for, and of those it made
};
// Holds each `every`th place of chains, and one of each drawn triangle, as check_cut() does, by trees:
// `whole` is the mesh's. What they say is too far is measured again by brute force.
void check_many(const SpaceMesh& mesh, const NearestTriangles& whole, const MeshGraph& graph,
                const MeshPlaceChains& chains, const std::vector<char>& stands, std::size_t every,
                std::mt19937_64& random, ManyPlaces& found);

// A mutant: each chain goes, at a step by chance, to another user of the same group, and ends there.
MeshPlaceChains wrong_users(const MeshGraph& graph, const MeshPlaceChains& chains, std::mt19937_64& random);

// A mutant: of a group on whose chains places end on the ground the error is that of the groups below, as if
// what it dropped cost nothing. Gives one for each such group, whose own error is larger.
std::vector<MeshGraph> dropped_for_nothing(const MeshGraph& graph, const MeshPlaceChains& chains);

}  // namespace oro::test

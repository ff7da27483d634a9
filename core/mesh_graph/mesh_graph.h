// A mesh of triangles in space at every detail between all of them and a few.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/base/scratch_memory.h"
#include "core/clusters/cluster_graph.h"
#include "core/mesh_graph/custom_simplifier.h"
#include "core/mesh_graph/mesh_ground.h"
#include "core/mesh_graph/nested_parts.h"

namespace oro {

// A cluster graph (core/clusters/cluster_graph.h) over any triangles: closed or open ones, walls, overhangs,
// soups. Vertices are those of the mesh. What core/cluster_frame/cluster_cut.h chooses of it draws each place
// of the mesh once, for any set of groups that stands where all below stand:
// - every place that is drawn is within error_m of the mesh, of the group that made it;
// - every place of the mesh is within error_m of what is drawn, of the last group that stands on the way up
//   from its own triangle; where ground was given, of what is drawn or of the terrain at full resolution;
// - where the mesh is closed, what is drawn is closed.
// Distances are those in space, so nothing is said of how far a wall moved vertically.
struct MeshGraph {
    ClusterGraph clusters;
    // The triangle of the mesh that each triangle of `clusters` began as: it has its feature.
    std::vector<std::uint32_t> original_of;

    [[nodiscard]] double largest_error_m() const;
};

// For tests of the bound: which groups answer for some place of each triangle of the mesh, from below.
struct MeshPlaceChains {
    std::vector<glm::dvec3> places;                  // of each triangle one
    std::vector<std::vector<std::uint32_t>> groups;  // groups' numbers, rising
    std::vector<char> on_ground;                     // above the last of them the ground answers
};

struct MeshGraphOptions {
    int threads{1};
    double kept_share{0.65};  // of a group's triangles, in what comes out of it
    MeshPlaceChains* chains{};
    // Null: groups lie anywhere. Else a group uses triangles of one part alone: on the first levels of one
    // that has four of the smallest parts, on later ones of one that has four of these, and so on up to the
    // mesh. Then all that a group is made from lies in its part, and where parts meet there are borders of
    // groups until they are joined.
    const NestedParts* parts{};
    // Parts are joined where there are no more triangles than these make of all parts (coarse_triangles()),
    // and half as many as when they were joined last; or where levels make no progress.
    std::size_t part_triangles{};
    // The ground: parts of the mesh that hang together with nothing may be dropped onto it. Null: it is not
    // known, and each place of the mesh has something of the mesh near it. Outlives the call.
    const MeshGround* ground{};
    // Where the arrays of the mesh's size lie while the graph grows: in files, so that what is in memory is a
    // window of groups, and some bytes a group. Null: in memory.
    ScratchMemory* scratch{};
    // Groups that are made coarser together, and out of memory then; 0: a good number.
    std::size_t window_groups{};
    // What such a window had in memory at most: triangles with their samples. Null: not asked.
    std::size_t* most_window_bytes{};
    // What makes a group coarser; null: SpaceSimplifier. Its errors are measured in the same way, so they are
    // bounds whatever it does. Outlives the call.
    const CustomSimplifier* simplifier{};
};

// vertices: metres, from a place near the mesh. origin: that place, ECEF; groups' spheres are from the
// Earth's middle. triangles: at least one, each of three places that are not on a line. The result does not
// depend on `threads`. A group stops where the next collapse would cost more than four times the error below
// it; the next level has other groups. What cannot be made coarser stays: there may be several coarsest
// clusters. Takes 0.5 KB a triangle; with `scratch` 0.1 KB, and the rest in files. The result depends on
// neither that nor window_groups.
[[nodiscard]] MeshGraph build_mesh_graph(std::span<const glm::dvec3> vertices,
                                         std::span<const std::array<std::uint32_t, 3>> triangles,
                                         const glm::dvec3& origin_ecef_m,
                                         const MeshGraphOptions& options = {});

}  // namespace oro

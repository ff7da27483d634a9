// A large thing of a mesh, a survey say, at several levels of detail: a tree of tiles that replace each
// other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "geo/meshes/placed_mesh.h"

namespace oro {

struct ThingLevelsRequest {
    std::size_t most_triangles{};  // of a tile
    std::size_t part_triangles{};  // of a tile that has all triangles of its part
    double widest_m{};             // of a tile that has all triangles of its part, along an axis of ECEF
    bool normals{true};
    int threads{1};
    double crease_deg{default_crease_deg};  // of the mesh
};

// A tile: a part of a thing, or what is drawn in its stead.
struct ThingTile {
    int depth{};                            // 0: of the whole thing
    std::vector<SourceTriangle> triangles;  // of places; none where the part cannot be drawn with few enough
    std::vector<std::array<glm::vec3, 3>> normals;  // at their corners, ECEF; empty where none are wanted
    // Metres. No place of the part is farther from the tile's triangles, and no place of these is farther
    // from the thing, as it is before its vertices are rounded and after the tile's are rounded to steps.
    // Without triangles the thing's size. It is more than that of its children.
    double error_m{};
    double
        step_m{};  // along the axes of ECEF, from the Earth's middle: 2^-11 m, twice or four times that, ...
    std::vector<std::size_t> children;  // none or four, among the tiles
};

// Tiles of which each replaces all four of its children are a tree over the thing. Whatever tiles are drawn
// of it, as long as either a tile or all of its children are there, their triangles are a cut of one cluster
// graph (core/mesh_graph/mesh_graph.h): they meet in vertices, and what is closed is closed. Where steps are
// not the same on both sides of a border of tiles, its vertices are rounded apart.
struct ThingLevels {
    std::vector<glm::dvec3> places_m;     // ECEF, on the lattice of 2^-11 m
    std::vector<std::uint32_t> place_of;  // of each of these, its number among those that were given
    std::vector<ThingTile> tiles;         // the first is the root, each is after its parent
    int depth{};                          // of the tiles that have all triangles
};

// places_m: ECEF, on the lattice (drawn_places_m()). triangles: of the thing, at least one, of places.
// Nothing where the thing is no larger than a part, or lies so far apart that parts of a triangle each are
// too wide. The result does not depend on `threads`. Takes 0.5 KB a triangle while it works.
[[nodiscard]] std::optional<ThingLevels> levels_of_thing(std::span<const glm::dvec3> places_m,
                                                         std::span<const SourceTriangle> triangles,
                                                         const ThingLevelsRequest& request);

}  // namespace oro

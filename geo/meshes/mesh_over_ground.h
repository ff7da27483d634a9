// How high a mesh lies over the terrain below it: what shows that its heights are above something else.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/terrain/post_grid.h"
#include "geo/meshes/placed_mesh.h"

namespace oro {

struct MeshOverGround {
    double median_m{};       // of vertices, H less that of the ground
    double N_m{};            // the geoid there, at the first vertex over ground
    std::size_t vertices{};  // that were asked, 10,000 at most, and lie over ground
};

// Asks up to 10,000 vertices, evenly out of all that triangles use. fields: the ground's, the best first. Its
// height is bilinear between four posts. Nothing where no vertex lies over ground.
std::optional<MeshOverGround> mesh_over_ground(const PlacedMesh& mesh,
                                               std::span<const HeightField* const> fields);

// Whether the first vertex of a mesh would lie over ground with latitude and longitude swapped.
bool is_over_ground_swapped(const PlacedMesh& mesh, std::span<const HeightField* const> fields);

// One line: "it lies 1.2 m over the terrain in the median". Where that is within 2 m of N, or of -N, it names
// the geoid: its heights are then most likely above the ellipsoid, or the other way round.
std::string words_of(const std::optional<MeshOverGround>& over, const std::string& geoid,
                     const std::string& what_lies = "it lies");

}  // namespace oro

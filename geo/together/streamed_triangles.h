// Triangles of a mesh that is read group by group: those of a cut, and those that lines may meet.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "core/truth/true_mesh_parts.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/region/region.h"

namespace oro {

// What is known of a mesh beside its triangles, for some of these.
PlacedMesh without_triangles(const PlacedMesh& mesh);

// Whether a mesh's groups may be drawn as its file has them: it is_drawn_as_streamed(), and the region has
// the ground below that its graph was built over, if it was.
bool streams_as_drawn(const PlacedMesh& mesh, const Region& region, double exaggeration);

// The clusters of a mesh that streams_as_drawn(), by their numbers, rising: the same vertices, triangles,
// features and colours, in the same order, as the whole mesh has of them, by any number of threads. Errors:
// groups that cannot be read.
Result<PlacedMesh> streamed_cut(const PlacedMesh& mesh, const std::vector<std::uint32_t>& clusters,
                                const UndulationField& undulation, int threads);

// All triangles of a mesh that is_drawn_as_streamed(), for the true ground. The mesh outlives it.
std::shared_ptr<const TriangleSource> true_triangles_of_streamed(const PlacedMesh& mesh,
                                                                 const UndulationField& undulation);

// Lets the meshes that are read group by group hold so many bytes of these between cuts, as much each.
void hold_streamed_at_most(const std::vector<PlacedMesh>& meshes, std::uint64_t bytes);

}  // namespace oro

// Whether the errors that a stored mesh's graph states are bounds: measured again.
#pragma once

#include <optional>
#include <string>

#include "core/mesh_file/stored_mesh.h"
#include "core/mesh_graph/mesh_ground.h"

namespace oro {

// Measures each group both ways, as the builder does (docs/MESHES.md, "The bound"): all that it made against
// the whole mesh, and what it answers for of the mesh against what it made, or the ground that the graph was
// built over (null: none). Nothing where each error is a bound, to 0.1 mm, or 1 mm where it is less than
// that; else the first group that is not, in words that follow "the mesh". Takes about half the time that
// building takes.
[[nodiscard]] std::optional<std::string> understated_error(const StoredMesh& mesh, int threads,
                                                           const MeshGround* ground = nullptr);

}  // namespace oro

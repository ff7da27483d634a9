// What is drawn of meshes, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "apps/drawing/mesh_cut.h"

namespace oro {

// "triangles", "of_triangles", "error_m", "error_px", "graph_s". error_px is null where a level was asked
// for, and nothing can be promised.
nlohmann::ordered_json drawn_meshes_json(const DrawnMeshes& meshes);

}  // namespace oro

// A mesh's cluster graph level by level, as `info` tells it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/mesh_graph/mesh_graph.h"

namespace oro {

// Rows of a table, each indented by `indent`: of each level its triangles, clusters and groups, and the
// largest error of any group up to there, a bound both ways. All of one level draw the mesh once.
std::string mesh_levels_text(const MeshGraph& graph, int indent);
// The same as a list of objects.
nlohmann::ordered_json mesh_levels_json(const MeshGraph& graph);

}  // namespace oro

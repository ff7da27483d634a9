#include "apps/commands/drawn_meshes_json.h"

#include <cmath>

#include "apps/report/json_object.h"

namespace oro {

nlohmann::ordered_json drawn_meshes_json(const DrawnMeshes& meshes) {
    const MeshCut& cut = meshes.cut;
    nlohmann::ordered_json json =
        json_object("triangles", cut.triangles, "of_triangles", cut.of_triangles, "error_m", cut.error_m,
                    "error_px", nullptr, "graph_s", meshes.graph_s);
    if (std::isfinite(cut.error_px)) json["error_px"] = cut.error_px;
    return json;
}

}  // namespace oro

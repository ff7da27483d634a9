#include "geo/meshes/triangle_looks.h"

#include "core/seam/cleared_map.h"  // gpu::mesh_look_...
#include "geo/meshes/mesh_look.h"

namespace oro {

TriangleLooks::TriangleLooks(const PlacedMesh& mesh) : mesh_(mesh) {
    for (const MeshFeature& feature : mesh.features)
        // Parts of one building have one hue.
        features_.push_back({mesh.has_look_by_type ? look_of_type(feature.type) : mesh.look,
                             tone_of(feature.part_of.empty() ? feature.name : feature.part_of)});
}

TriangleLook TriangleLooks::of(std::size_t triangle) const {
    constexpr float only_tone = 0.08F;  // of a mesh without features
    TriangleLook look{mesh_.look, only_tone};
    if (!mesh_.feature_of.empty()) look = features_[mesh_.feature_of[triangle]];
    if (!mesh_.part_colours.empty() || is_coloured(mesh_, triangle)) look.look = gpu::mesh_look_coloured;
    return look;
}

}  // namespace oro

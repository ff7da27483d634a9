#include "geo/meshes/triangle_looks.h"

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
    if (mesh_.feature_of.empty()) return {mesh_.look, only_tone};
    return features_[mesh_.feature_of[triangle]];
}

}  // namespace oro

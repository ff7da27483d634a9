#include "geo/meshes/gltf_materials.h"

#include <cmath>

#include "geo/meshes/gltf_json.h"

namespace oro {

// As a rotation counter-clockwise where the second coordinate goes down.
glm::dvec2 GltfTexture::place(const glm::dvec2& at) const {
    const glm::dvec2 scaled = at * scale;
    const double c = std::cos(rotation_rad), s = std::sin(rotation_rad);
    return offset + glm::dvec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

GltfMaterials::GltfMaterials(const JsonValue& root)
    : materials_(gltf_list(root, "materials")),
      textures_(gltf_list(root, "textures")),
      samplers_(gltf_list(root, "samplers")),
      images_(gltf_list(root, "images").size()),
      read_(materials_.size()) {}

Result<GltfColour> GltfMaterials::material(std::optional<std::size_t> number) {
    if (!number || *number >= materials_.size())
        return gltf_fault("a primitive has a material that is not there");
    std::optional<GltfColour>& known = read_[*number];
    if (!known) {
        ORO_TRY(known, read(materials_[*number]));
    }
    return *known;
}

Result<GltfColour> GltfMaterials::read(const JsonValue& material) const {
    GltfColour colour;
    const auto pbr = gltf_member(material, "pbrMetallicRoughness");
    if (!pbr) return colour;
    colour.is_stated = gltf_member(*pbr, "baseColorFactor").has_value();
    ORO_TRY(const std::vector<double> factor, gltf_reals(*pbr, "baseColorFactor", {1.0, 1.0, 1.0, 1.0}));
    colour.factor = {factor[0], factor[1], factor[2]};
    if (const auto info = gltf_member(*pbr, "baseColorTexture")) {
        ORO_TRY(colour.texture, read_texture(*info));
    }
    return colour;
}

Result<GltfTexture> GltfMaterials::read_texture(const JsonValue& info) const {
    GltfTexture read;
    const auto number = gltf_count(info, "index", std::nullopt);
    if (!number || *number >= textures_.size())
        return gltf_fault("a material has a texture that is not there");
    const std::string name = "texture " + std::to_string(*number);
    const JsonValue& texture = textures_[*number];
    if (gltf_member(texture, "source")) {
        read.image = gltf_count(texture, "source", std::nullopt);
        if (!read.image || *read.image >= images_)
            return gltf_fault(name + " has an image that is not there");
    }
    ORO_CHECK(read_wraps(texture, name, read));
    auto coordinates = gltf_count(info, "texCoord", 0);
    if (const auto transform = extension_of(info, "KHR_texture_transform")) {
        ORO_TRY(const std::vector<double> offset, gltf_reals(*transform, "offset", {0.0, 0.0}));
        ORO_TRY(const std::vector<double> scale, gltf_reals(*transform, "scale", {1.0, 1.0}));
        read.offset = {offset[0], offset[1]}, read.scale = {scale[0], scale[1]};
        const auto rotation = gltf_member(*transform, "rotation");
        if (rotation && !mesh_number(rotation->source(), read.rotation_rad))
            return gltf_fault(name + " is turned by what is no number");
        coordinates = gltf_count(*transform, "texCoord", coordinates);
    }
    if (!coordinates) return gltf_fault("a material has a texCoord that is no number");
    read.coordinates = *coordinates;
    return read;
}

Result<void> GltfMaterials::read_wraps(const JsonValue& texture, const std::string& name,
                                       GltfTexture& read) const {
    if (!gltf_member(texture, "sampler")) return {};
    const auto number = gltf_count(texture, "sampler", std::nullopt);
    if (!number || *number >= samplers_.size()) return gltf_fault(name + " has a sampler that is not there");
    constexpr std::size_t clamp = 33071, mirror = 33648, repeat = 10497;
    for (std::size_t i = 0; i < read.wrap.size(); ++i) {
        const auto wrap = gltf_count(samplers_[*number], i == 0 ? "wrapS" : "wrapT", repeat);
        if (wrap != clamp && wrap != mirror && wrap != repeat)
            return gltf_fault("sampler " + std::to_string(*number) + " has a way to wrap that is none");
        read.wrap[i] = wrap == clamp    ? TextureWrap::clamp
                       : wrap == mirror ? TextureWrap::mirror
                                        : TextureWrap::repeat;
    }
    return {};
}

}  // namespace oro

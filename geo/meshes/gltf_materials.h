// Materials of glTF: the colour and the texture that a surface has.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/meshes/texture_colours.h"
#include "geo/vectors/json_text.h"

namespace oro {

// The texture of a material's colour, and how coordinates lead into it.
struct GltfTexture {
    std::optional<std::size_t> image;  // nothing: it is in a format that only an extension names
    std::array<TextureWrap, 2> wrap{};
    std::size_t coordinates{};  // n of TEXCOORD_n
    // KHR_texture_transform: coordinates are scaled, turned, then moved.
    glm::dvec2 offset{0.0}, scale{1.0};
    double rotation_rad{};

    [[nodiscard]] glm::dvec2 place(const glm::dvec2& at) const;
};

// What colours a primitive: linear light.
struct GltfColour {
    glm::dvec3 factor{1.0};
    bool is_stated{};  // the factor
    std::optional<GltfTexture> texture;
};

// The materials of a file, each read once.
class GltfMaterials {
  public:
    explicit GltfMaterials(const JsonValue& root);
    // Errors: a material, texture, image or sampler that is not there; a list of numbers that is none.
    Result<GltfColour> material(std::optional<std::size_t> number);

  private:
    [[nodiscard]] Result<GltfColour> read(const JsonValue& material) const;
    [[nodiscard]] Result<GltfTexture> read_texture(const JsonValue& info) const;
    Result<void> read_wraps(const JsonValue& texture, const std::string& name, GltfTexture& read) const;

    std::vector<JsonValue> materials_, textures_, samplers_;
    std::size_t images_;
    std::vector<std::optional<GltfColour>> read_;
};

}  // namespace oro

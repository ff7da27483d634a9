// Colours of vertices from the textures of a mesh's file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "geo/meshes/source_mesh.h"

namespace oro {

// What a texture shows beyond its borders.
enum class TextureWrap { repeat, mirror, clamp };

// A triangle of a mesh, by its number, and where its corners lie in a texture: from 0 to 1 to the right and
// down from the texture's top left. Coordinates are finite.
struct TexturedTriangle {
    std::uint32_t triangle{};
    std::array<glm::vec2, 3> at{};
};

// The triangles of one material, and the texture that it has.
struct TexturedPart {
    std::size_t texture{};              // of the list of TextureBytes
    std::array<TextureWrap, 2> wrap{};  // to the right, and down
    std::vector<TexturedTriangle> triangles;
};

// A texture as its file has it: bytes of a PNG or a JPEG.
struct TextureBytes {
    std::string name;  // what errors call it
    std::string_view bytes;
};

// A texture has so many pixels at most: 16,384 x 16,384.
inline constexpr std::uint64_t most_texture_pixels = std::uint64_t{1} << 28U;

// Multiplies the light of the vertices of parts, whose colours are stated, by the mean light of what a
// texture shows around them: of each triangle the third that is nearest to the vertex by its barycentric
// coordinates, by its area in space. Vertices of one part that lie at one place have one mean, so seams of a
// texture do not show. Samples lie at most a texel apart, but for triangles that are many times larger in the
// texture than others. Textures are decoded one after the other, three bytes a pixel. Fills mesh.textures,
// mesh.texels and mesh.textured_vertices. The result is the same by any number of threads. Errors: a
// texture that is damaged, or larger than most_texture_pixels, by its name.
Result<void> colour_by_textures(const std::vector<TextureBytes>& textures,
                                const std::vector<TexturedPart>& parts, SourceMesh& mesh);

// Textures that are not read, and why: counted, with the first of them.
class UnreadTextures {
  public:
    void add(const std::string& name, const std::string& why);
    // Nothing where there are none.
    void note_in(SourceMesh& mesh) const;

  private:
    std::vector<std::string> names_;
    std::string first_;
};

}  // namespace oro

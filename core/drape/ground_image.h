// Images that lie over a region's ground, as tiles of a pyramid: what the GPU gets of them, wherever they
// come from.
#pragma once

#include <compare>
#include <cstdint>
#include <span>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "shaders/shared.h"

namespace oro {

// A tile: 256 x 256 texels over 128 2^level posts of the region a side. Levels below 0 are finer than its
// posts.
struct ImageTile {
    int level{};
    int row{};
    int column{};
    auto operator<=>(const ImageTile&) const = default;
};

// Number in the region of the place of texel i of a tile, along either axis: its middle. i is -1 .. 256, the
// first and the last are those of the rim.
[[nodiscard]] inline double post_of_texel(int level, int tile, int i) {
    const double quad = static_cast<double>(std::int64_t{tile} * gpu::page_quads) + 0.5 * (i + 0.5);
    return level >= 0 ? quad * static_cast<double>(std::int64_t{1} << level)
                      : quad / static_cast<double>(std::int64_t{1} << -level);
}

// Images over a region, one on top of the other; safe to ask from several threads.
class GroundImage {
  public:
    GroundImage() = default;
    virtual ~GroundImage() = default;
    GroundImage(const GroundImage&) = delete;
    GroundImage& operator=(const GroundImage&) = delete;

    // Finer levels show nothing more; at least gpu::drape_finest.
    [[nodiscard]] virtual int finest_level() const = 0;
    // Its one tile covers the region.
    [[nodiscard]] virtual int coarsest_level() const = 0;
    // Fills a tile's gpu::drape_words texels, row by row from the north-west one of its rim: RGBA, red in the
    // low bits, sRGB codes times alpha. False where nothing of an image lies in it. Errors: a file that
    // cannot be read.
    virtual Result<bool> load(const ImageTile& tile, std::span<std::uint32_t> texels) const = 0;
};

}  // namespace oro

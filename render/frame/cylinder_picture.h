// A picture all around, drawn as pictures of a pinhole eye that are brought onto a cylinder.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/frame/cylinder_tiles.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// May write on the rows of a tile's picture, sRGB, before they are brought onto the cylinder.
using OverTile = std::function<Result<void>(const CylinderTile& tile, std::vector<std::uint8_t>& rgb)>;

// What is drawn over the ground itself.
struct CylinderExtras {
    bool ridges{true};  // lines where nearer ground ends (core/frame/ridge_lines.h)
    OverTile over;      // after them
    // Once pages take more on the GPU, they are let go of after each column of tiles: one column of a region
    // of 12 tiles of SRTM takes some 60 MB, and all together 430 MB.
    std::uint64_t kept_page_bytes{48'000'000};
};

struct CylinderPicture {
    PictureReport report;           // sums over all tiles
    std::vector<std::uint8_t> rgb;  // rows from the top, sRGB
    int tiles{};
    double near_trees_share{};   // of its area, where a tree near the eye is shown (counts_near_trees)
    std::uint64_t page_bytes{};  // the most that buffers of pages took on the GPU
};

// Draws what an eye sees on a cylinder. tau_px of the options is in pixels of the cylinder, and so is the
// width of contour lines. Memory: the picture, one tile at a time, and on the GPU the pages of one column of
// tiles. Errors: those of the device and of `over`.
Result<CylinderPicture> render_cylinder(const Gpu& gpu, Scene& scene, const Geodetic& eye,
                                        const Cylinder& around, const CylinderCut& cut,
                                        const gpu::FrameStyle& style, const PictureOptions& options,
                                        const CylinderExtras& extras = {},
                                        const RenderProgress& progress = {});

}  // namespace oro

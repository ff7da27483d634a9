// A cylinder's picture from pictures of a pinhole eye: which of these it takes, and its pixels from theirs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "core/earth/cylinder.h"

namespace oro {

// A rectangle of a cylinder's picture, and the eye that sees all of it with room around.
struct CylinderTile {
    int x_px{};
    int y_px{};
    int width_px{};
    int height_px{};
    Camera camera;
    // What of the camera's picture unroll() reads, and the pixels beside it that ridge lines look at.
    Tile part;
};

// How a cylinder is cut.
struct CylinderCut {
    double oversampling{2.0};   // how much finer tiles are than the cylinder where it is finest in them
    int largest_side_px{2048};  // of a tile's picture; 1.25 times that 35 degrees off level, more beyond
    double widest_deg{45.0};    // of a tile, across and up
    double shift_px{0.0};       // moves all borders between columns of tiles (tests)
    // Far forests rise into pixels above them, and water mirrors what stands over it (shaders/growth): tiles
    // are as high as the cylinder then, where that is no more than 90 degrees and the picture not too large,
    // and see what lies beside them.
    bool with_forests{false};
};

// Tiles that together are the cylinder, each once; all of them have pictures of one size.
std::vector<CylinderTile> cylinder_tiles(const Cylinder& around, const Geodetic& eye, const CylinderCut& cut);

// Brings a tile's picture into the cylinder's: each pixel is the mean, in linear light, of what the tile
// shows within it. `drawn`: rows of the tile's picture, sRGB; `rgb`: those of the cylinder's.
void unroll(const Cylinder& around, const CylinderTile& tile, std::span<const std::uint8_t> drawn,
            std::span<std::uint8_t> rgb, int threads);

}  // namespace oro

// The picture that a frame with trees is a tile of, after its GrowthTable (shared_growth.h). Compiled as C++
// and as GLSL.
#ifndef OROGRAPH_SHADERS_GROWTH_SHARED_PICTURE_H
#define OROGRAPH_SHADERS_GROWTH_SHARED_PICTURE_H

#ifdef __cplusplus
#include "shaders/shared.h"
namespace oro::gpu {
#endif

// What one of its pixels shows: as growth/pixels_kept.glsl has it, but 0 to 1 where that is 1 and more: the share of
// samples that show no sky and no water. And its reversed depth. All zero: its tile is not drawn yet.
struct KeptOfPicture {
    uvec2 pixel;
    float depth;
};

struct TiledPicture {
    uvec2 pixels;  // device address of KeptOfPicture[], row by row: what tiles show that are drawn; 0: the
                   // frame is all of it
    uint width_px;
    uint height_px;
    uint step_px;   // of so many pixels across and down one is kept, their mean
    uint own_x_px;  // the part of the frame that no other tile draws: within the frame
    uint own_y_px;
    uint own_width_px;
    uint own_height_px;
};

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif

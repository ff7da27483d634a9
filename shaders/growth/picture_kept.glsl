// What the pixels of a whole picture show, for a frame that is a tile of it: its own, and those of tiles that were drawn before. Pixels are the
// frame's, also beyond its sides. Needs pixels_kept.glsl and kept_colour.glsl.
#include "shaders/growth/shared_picture.h"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer TablesOfPicture {
    GrowthTable growth;
    TiledPicture picture;
};
#define PICTURE TablesOfPicture(growth_table).picture
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer KeptPicture { KeptOfPicture at[]; };

ivec2 size_of_frame() { return ivec2(FRAME.width_px, FRAME.height_px); }
bool is_tile() { return PICTURE.pixels != uvec2(0u); }
ivec2 size_of_picture() { return is_tile() ? ivec2(PICTURE.width_px, PICTURE.height_px) : size_of_frame(); }
ivec2 first_of_frame() { return is_tile() ? ivec2(FRAME.first_x_px, FRAME.first_y_px) : ivec2(0); }
bool is_within(ivec2 pixel, ivec2 size) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, size)); }

uint number_in_picture(ivec2 kept) { return uint(kept.y) * ((PICTURE.width_px + PICTURE.step_px - 1u) / PICTURE.step_px) + uint(kept.x); }
KeptOfPicture kept_of_picture(ivec2 pixel) {
    return KeptPicture(PICTURE.pixels).at[number_in_picture((pixel + first_of_frame()) / int(PICTURE.step_px))];
}
vec4 kept_anywhere(ivec2 pixel) { return is_within(pixel, size_of_frame()) ? kept_at(pixel) : colour_of_kept(kept_of_picture(pixel).pixel); }
float depth_anywhere(ivec2 pixel) { return is_within(pixel, size_of_frame()) ? depth_in(pixel) : kept_of_picture(pixel).depth; }

// Colours of posts, laid over a region's ground as an image is: what was found out about each post.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/drape/ground_image.h"
#include "core/terrain/grid_part.h"

namespace oro {

// The colours of a part of a region's posts, row by row from the north-west one: each as a texel of
// GroundImage has it (RGBA, red in the low bits, sRGB codes times alpha). 0 is no colour at all.
struct PostColours {
    PostGrid grid;              // whose posts they are
    std::size_t grid_number{};  // that grid, of its region's
    GridPart part;
    std::vector<std::uint32_t> rgba;
};

// A texel of a colour of sRGB codes that lets through the share 1 - alpha of what is below it.
std::uint32_t texel_of(std::uint8_t red, std::uint8_t green, std::uint8_t blue, double alpha);

// Gives colours of posts over a grid of their region, by its number, and below them `under`, whose own
// colours keep the share `opacity` (0 to 1); null: nothing is below. A texel has the colour of the nearest
// post; of a coarse level the mean of up to 8 x 8 posts evenly within it. `grid` may be another one than the
// colours', or have every n-th of its posts: then the places of its texels decide. Both inputs stay with what
// is given.
std::unique_ptr<const GroundImage> colours_over_ground(const PostGrid& grid, std::size_t grid_number,
                                                       std::shared_ptr<const PostColours> colours,
                                                       std::unique_ptr<const GroundImage> under,
                                                       double opacity);

}  // namespace oro

// How the texels of a tile are found from the pixels of a raster.
#pragma once

#include <optional>

#include "core/terrain/post_grid.h"
#include "geo/drape/image_place.h"
#include "geo/drape/placed_raster.h"
#include "geo/drape/window_read.h"

namespace oro {

// The pixels that stand for one before, and the places of a texel along either axis that are looked at
// afterwards. Together they cover the texel.
struct Sampling {
    int step{1};
    int columns{1};
    int rows{1};
    [[nodiscard]] int count() const { return columns * rows; }
    // The number-th place of a texel, to be asked of TilePlacing::at.
    [[nodiscard]] PixelPlace place_in(int texel_column, int texel_row, int number) const {
        return {texel_column - 1 + (number % columns + 0.5) / columns - 0.5,
                texel_row - 1 + (number / columns + 0.5) / rows - 0.5};
    }
};
// per_texel: TilePlacing::per_texel().
Sampling sampling_of(const PixelPlace& per_texel);

// What of a raster a tile can see, moved by so much: whole steps, so that neighbours read the same pixels;
// nothing where that is nothing. Makes the steps longer where there would be too many pixels.
std::optional<PixelWindow> window_of(const PlacedRaster& raster, const TilePlacing& tile,
                                     const PixelPlace& moved, Sampling& sampling);

// The turns of longitude in which a tile may meet a raster, as pixels to move by: one, none, of a raster
// whose longitudes do not go round.
std::vector<PixelPlace> turns_of(const ImagePlacing& placing);

// Whether a raster lies anywhere over a grid.
bool lies_over(const PlacedRaster& raster, const ImagePlacing& placing, const PostGrid& grid);

// The finest level that shows more of a raster than the one above it: a pixel is at least two texels.
// Interpolated twice, edges are then where they are interpolated once.
int finest_level_of(const PlacedRaster& raster, const ImagePlacing& placing, const PostGrid& grid);
// Numbers of quads of the finest level must be whole numbers of the GPU.
int least_level(const PostGrid& grid);

}  // namespace oro

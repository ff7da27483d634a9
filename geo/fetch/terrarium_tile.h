// Heights that servers give as pictures for web maps ("terrarium"), put together as a GeoTIFF of one tile of
// a layout. Source: https://github.com/tilezen/joerd/blob/master/docs/formats.md#terrarium
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/base/result.h"
#include "geo/fetch/fetch_file.h"
#include "geo/fetch/tile_layout.h"

namespace oro {

// H = R 256 + G + B / 256 - 32768 metres.
double H_of_terrarium_m(const std::array<std::uint8_t, 3>& rgb);

// The pictures of a zoom that a tile touches: from west and north on, so many each way.
struct PictureBlock {
    int zoom{};
    std::int64_t west{}, north{}, columns{}, rows{};
};
PictureBlock pictures_of(const TileLayout& layout, const TileName& tile);

// Asks for the pictures of a tile, `jobs` at a time, and writes them as the GeoTIFF `path`: Float32 in
// EPSG:3857, pixel for pixel, without a change, with the layout's attribution; where the server has no
// picture, there is no height. Pictures that have come are kept in the folder PATH.parts until all are there,
// so that a later run goes on with them. Says that the file is not there where the server has none of the
// pictures. Errors: those of fetch_file(); a picture that is none of 256 x 256 pixels; more than 4096 of
// them; those of writing.
Result<FetchedFile> fetch_terrarium_tile(const TileLayout& layout, const TileName& tile,
                                         const std::string& path, const FetchLimits& limits, int jobs);

// Whether a file is what fetch_terrarium_tile() writes of a tile: size, place, CRS, all its blocks. Errors:
// what it is instead; `shown` stands for the file.
Result<void> check_terrarium_tile(const std::string& file, const std::string& shown, const TileLayout& layout,
                                  const TileName& tile);

}  // namespace oro

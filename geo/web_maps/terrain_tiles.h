// Heights as tiles of a web map: PNGs whose colours are numbers ("terrain-rgb").
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/truth/true_ground.h"
#include "geo/web_maps/kept_web_tiles.h"
#include "geo/web_maps/mercator_tiles.h"

namespace oro {

// H = -10000 + 0.1 (R 65536 + G 256 + B) metres, as Mapbox has it. Rounded to the nearest tenth of a metre;
// heights beyond -10,000 to 1,667,721.5 m take the nearest that there is.
// Source: docs.mapbox.com/data/tilesets/reference/mapbox-terrain-rgb-v1.
std::array<std::uint8_t, 3> terrain_rgb(double H_m);
double H_of_terrain_rgb_m(const std::array<std::uint8_t, 3>& rgb);

// H of a ground at a place: its h less its N; nothing where it has none.
std::optional<double> ground_H_m(const TrueGround& ground, double lat_deg, double lon_deg);

struct TerrainTilesRequest {
    ZoomRange zooms;
    double hole_H_m{};  // what pixels without ground hold
    int threads{1};
    WebTilesPart share{};  // whose `kept` stays where it is
};
struct TerrainTilesWritten {
    std::uint64_t tiles{}, bytes{};
    std::uint64_t hole_pixels{};  // without ground, in tiles that have some
};
// Told how much is done, 0 .. 1, from the calling thread.
using TilesProgress = std::function<void(double share)>;

// Writes FOLDER/z/x/y.png of every tile that has ground at the centre of a pixel: each pixel has H of the
// ground at its centre, asked of the surface and not resampled. The folder is there and empty. Same bytes for
// any number of threads, and wherever tiles that are kept were made. Errors: what cannot be written, posts
// that cannot be read.
Result<TerrainTilesWritten> write_terrain_tiles(const std::string& folder, const TrueGround& ground,
                                                const TerrainTilesRequest& request,
                                                const TilesProgress& progress);

// Makes the tiles of one part that are not kept yet, and keeps them: how many there are now of the part,
// those without ground among them. request.share.kept is there. Errors: as write_terrain_tiles().
Result<std::uint64_t> keep_terrain_tiles(const TrueGround& ground, const TerrainTilesRequest& request,
                                         const TilesProgress& progress);

// How far a zoom's heights, as they are encoded and bilinear between the centres of pixels, are from the
// ground, at random places.
struct ZoomError {
    int zoom{};
    std::uint64_t places{};  // fewer than asked for where there are few whose four pixels all have ground
    double largest_m{}, rms_m{};
};
// `places` for each zoom, each post of the ground's grids as likely as another; the same ones in each run.
Result<std::vector<ZoomError>> terrain_tiles_error(const TrueGround& ground, const ZoomRange& zooms,
                                                   int places, int threads);

}  // namespace oro

// The ground as a pyramid of quantized meshes for globes, and how far they are from it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/truth/true_ground.h"
#include "geo/web_maps/quantized_mesh.h"
#include "geo/web_maps/terrain_tiles.h"

namespace oro {

// A tile that was written, and what its heights are counted in.
struct QuantizedTile {
    GeographicTile tile;
    HeightSteps steps;
    bool has_ground{};
};
struct QuantizedTiles {
    std::vector<QuantizedTile> tiles;  // sorted
    std::uint64_t bytes{};
    std::uint64_t hole_corners{};  // without ground, in tiles that have some

    // Tiles x0 .. x1, y0 .. y1 of a zoom that are all there: together all of its tiles, each once.
    struct Rectangle {
        std::int64_t first_x{}, first_y{}, last_x{}, last_y{};
    };
    [[nodiscard]] std::vector<Rectangle> rectangles(int zoom) const;
};

struct QuantizedTilesRequest {
    int highest_zoom{};
    double hole_H_m{};  // what corners without ground hold
    int threads{1};
    WebTilesPart share{};  // whose `kept` stays where it is
};

// Writes FOLDER/z/x/y.terrain of every tile of zoom 0 to the highest that has ground at a corner of its
// quads, and both tiles of zoom 0, without which viewers show nothing. A corner has h of the ground, asked of
// the surface and not resampled; one without ground has the H of holes, and N. The folder is there and empty.
// Same bytes for any number of threads, and wherever tiles that are kept were made. Errors: what cannot be
// written, posts that cannot be read; no corner with ground (no_data).
Result<QuantizedTiles> write_quantized_tiles(const std::string& folder, const TrueGround& ground,
                                             const QuantizedTilesRequest& request,
                                             const TilesProgress& progress);

// Makes the tiles of one part that are not kept yet, and keeps them: how many there are now of the part,
// those without ground among them. request.share.kept is there. Errors: as write_quantized_tiles().
Result<std::uint64_t> keep_quantized_tiles(const TrueGround& ground, const QuantizedTilesRequest& request,
                                           const TilesProgress& progress);

// How far each zoom's triangles are from the ground in height, at random places: as terrain_tiles_error().
Result<std::vector<ZoomError>> quantized_tiles_error(const TrueGround& ground, const QuantizedTiles& tiles,
                                                     const QuantizedTilesRequest& request, int places);

}  // namespace oro

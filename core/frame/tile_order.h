// In which order tiles of a picture are drawn, so that those come first that later ones look into.
#pragma once

#include <vector>

#include "core/earth/camera.h"

namespace oro {

// Left borders of the tiles of a row of tiles, of one width but for the last, in an order in which what
// stands over a place lies in the picture in its own tile, in one before, or in another row of tiles. Lines
// that are upright in space meet in one point of the picture, or are parallel. Rows of tiles come from the
// top down: that is right unless that point is in the picture, or the camera is turned upside down.
std::vector<int> columns_by_uprights(const Camera& camera, int tile_width_px);

}  // namespace oro

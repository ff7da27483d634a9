// Terrain by a formula, for benchmarks of triangles alone.
#pragma once

#include "core/earth/camera.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Hills on all scales down to the post spacing, 0 to some 1,500 m: a square of so many meshlets along each
// side. The same on every machine up to the last digits of sine.
HeightField made_region(int patches);

// An eye straight above the middle, from where the whole square just fits.
Camera eye_above(const HeightField& field, int width_px, int height_px);

}  // namespace oro

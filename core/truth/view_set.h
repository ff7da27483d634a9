// Sets of views for measuring: from all heights, in all directions.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/earth/camera.h"
#include "core/terrain/post_grid.h"
#include "core/truth/true_ground.h"

namespace oro {

// An eye over a region, as likely 2 to 20 m above the ground as 50 to 500 km, heading and looking anywhere
// from straight down to above the level (but not at the sky alone from far up), a third of them rolled; field
// of view 10 to 90 degrees. Places over void posts count as sea level. The same engine gives the same cameras
// on every machine up to rounding.
Camera made_camera(std::mt19937_64& random, const HeightField& field, int width_px, int height_px,
                   double exaggeration = 1.0);

// `count` of them from one seed, of which each sees ground in at least a tenth of its picture where 50 tries
// find such a one.
std::vector<Camera> made_cameras(std::uint64_t seed, const HeightField& field, int count, int width_px,
                                 int height_px, double exaggeration = 1.0);
// Cameras over a ground: of several grids, each is as likely to be below the eye as another. Of one, the
// cameras are those of its field.
std::vector<Camera> made_cameras(std::uint64_t seed, const TrueGround& ground, int count, int width_px,
                                 int height_px);

}  // namespace oro

// Which ground a picture shows, without drawing the picture.
#pragma once

#include <functional>

#include "core/measure/drawn_point.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// Takes what the middle of a pixel shows.
using GroundSink = std::function<void(int x_px, int y_px, const DrawnPoint& point)>;

// Tells what every step-th pixel shows, across and down, from the first: of the picture that render_picture()
// draws with these options (their samples count for nothing). Tile by tile, row by row. Errors: those of the
// device and of the scene's pages.
Result<void> shown_ground(const Gpu& gpu, Scene& scene, const Camera& camera, const PictureOptions& options,
                          int step_px, const GroundSink& sink);

// Takes what some whole rows of a tile show, row by row, the first of them so many below the tile's top.
using TriangleSink = std::function<void(const Tile& tile, int first_row, int rows,
                                        const std::vector<ShownTriangle>& triangles)>;
// Gives the triangles that pixels show to `sink`.
Result<void> shown_triangles(const Gpu& gpu, Scene& scene, const Camera& camera,
                             const PictureOptions& options, const TriangleSink& sink);

}  // namespace oro

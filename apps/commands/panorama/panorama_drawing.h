// A panorama from what is asked of it to its scene: what the command panorama draws, before it is written.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "apps/drawing/region_scene.h"
#include "apps/options/options.h"
#include "apps/panorama/panorama_picture.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "core/base/progress.h"

namespace oro {

// What is asked of a panorama's frame. Nothing: the view's own; without one all around, the elevations that
// hold the ground and its skyline, and 20 pixels a degree.
struct AskedFrame {
    std::optional<std::pair<double, double>> sector;  // from, sweep
    std::optional<std::pair<double, double>> elevation;
    std::optional<int> width_px;
    std::optional<bool> ridges;
};

// Completes the view's frame and its camera, which stands for the scene until the sheet is laid out. Gives
// whether ground close to the eye stands higher than the elevations that were found. Errors (usage): a scene
// of too many pixels.
Result<bool> set_frame(const AskedFrame& asked, const TrueGround& ground, View& view);
// A style is chosen for what a part of the cylinder shows on a plane. Errors: those of load_style().
Result<Style> style_of_panorama(const View& view, const Region& region);

struct PanoramaDrawing {
    MemoryOptions memory;
    bool quiet{};            // what a user must know of images and levels is not said
    std::stop_token stop{};  // asked to stop, it ends soon, with an error that nobody need be told
};
// Measures the levels of the region and draws the scene, on a device of its own. Errors: the device; those of
// draw_scene().
Result<CylinderPicture> draw_panorama(const View& view, const Region& region, const RegionCuts& cuts,
                                      const TrueGround& ground, const Style& style, const Cylinder& around,
                                      const PanoramaDrawing& drawing, const Progress& progress);

}  // namespace oro

// A map from straight above: each pixel shows the ground at its own place of the CRS.
#pragma once

#include "apps/options/options.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "core/truth/true_ground.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// Errors (usage): options that a map has no use for (an eye, air, names ...), or that are for maps alone.
Result<void> check_map_options(const ShotOptions& options);

// Makes a view of a region into that of a map: its frame, its size, its eye, which is above the map's middle
// and from which the sun is seen. Without --tau and --accuracy it leaves out a tenth of the detail that a
// picture would. Errors: those of map_frame(), and of options.
Result<void> make_map(View& view, const ShotOptions& options, const Region& region);

// The next row of a map, width * 4 bytes: red, green, blue, opacity.
using MapRowSink = std::function<Result<void>(std::span<const std::uint8_t> rgba)>;

// Draws a map, from the top row down. Squares of it are drawn as pictures straight down from afar, through
// the frame path of all pictures, twice as fine and without air before them; each pixel then takes what they
// show at its place: longitude and latitude by PROJ, the ground's height there in double, projected into the
// picture. So slopes stand where they are, not aside of it. Without ground there, a pixel is transparent.
// Errors: those of render_picture(), of PROJ and of the sink.
Result<PictureReport> draw_map(const Gpu& gpu, Scene& scene, const View& view, const TrueGround& ground,
                               const Style& style, RasterPath path, const MapRowSink& sink,
                               const RenderProgress& progress);

}  // namespace oro

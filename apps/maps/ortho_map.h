// A map from straight above: each pixel shows the ground at its own place of the CRS.
#pragma once

#include <optional>
#include <vector>

#include "apps/options/options.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "core/earth/camera.h"
#include "core/truth/true_ground.h"
#include "geo/rasters/map_frame.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// Some pixels of a map, in whole rows from (x_px, y_px) on, and the ground at the middle of each.
struct MapSquare {
    int x_px{}, y_px{}, width_px{}, height_px{};
    std::vector<std::optional<Ecef>> ground;           // nothing: there is none
    std::vector<glm::dvec2> at_px;                     // in the picture, where there is ground
    glm::dvec2 right_px{1.0, 0.0}, down_px{0.0, 1.0};  // about: from a pixel to the next, in the picture
    Camera camera;  // of the picture; no pixels where the square has no ground

    [[nodiscard]] std::size_t number(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x);
    }
};

// The ground at a place of a map, above the ellipsoid: of the grid that is the ground there; the sea's
// surface where a grid has void posts, if these are sea. Nothing where there is none.
std::optional<double> map_ground_h_m(const TrueGround& ground, const MapPlace& place, bool voids_are_sea);

// The ground of a square: by the surface, in which void posts lie at sea level where `voids_are_sea`. Then
// the camera: straight above the square's middle, so far away that its whole width is seen within three
// degrees, with `finer` pixels of it for one of the map's. Float32 places ground as seen from there within
// 0.02 px.
MapSquare map_square(const MapSquare& where, MapPlaces& places, const TrueGround& ground, bool voids_are_sea,
                     int finer);

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

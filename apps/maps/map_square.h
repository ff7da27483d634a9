// A square of a map and the picture from afar that it is taken from.
#pragma once

#include <optional>
#include <vector>

#include "core/earth/camera.h"
#include "core/truth/true_ground.h"
#include "geo/rasters/map_frame.h"

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

// The ground of a square: by the surface, in which void posts lie at sea level where `voids_are_sea`. Then
// the camera: straight above the square's middle, so far away that its whole width is seen within three
// degrees, with `finer` pixels of it for one of the map's. Float32 places ground as seen from there within
// 0.02 px.
MapSquare map_square(const MapSquare& where, MapPlaces& places, const TrueGround& ground, bool voids_are_sea,
                     int finer);

}  // namespace oro

// Lines where nearer ground ends before farther ground or the sky: what a drawn panorama is read by.
#pragma once

#include <cstdint>
#include <span>

namespace oro {

// A picture's reversed depths (near_plane_m / distance along the view's axis; 0: sky), row by row. Below 0:
// that of trees or grass.
struct DepthRows {
    std::span<const float> depths;
    int width_px{};
    int height_px{};
};

// Darkens the pixels of nearer ground that such a line runs along: the more so the nearer the ground is and
// the farther what is behind it. Ground that only falls away steeply, as a plain does towards its horizon,
// has none: the reversed depths of a plane change evenly. Trees and grass have none near the eye, where each
// of them would be drawn round, and whole ones far off, where forests end as the ground does. `rgb`: sRGB, of
// the same size.
void draw_ridges(const DepthRows& picture, std::span<std::uint8_t> rgb, int threads);

// How dark, 0 .. 1, the line in a pixel is of which these are the reversed depths: its own, that of one
// beside it, and that on the other side. `distance_m`: of the pixel's ground.
double ridge_share(double own, double beyond, double before, double distance_m);

}  // namespace oro

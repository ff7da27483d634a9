// How far a flat triangle is from the ground that it stands for: the ellipsoid bulges between its corners.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/earth/ellipsoid.h"
#include "core/terrain/post_grid.h"

namespace oro {

// How far a point of a flat triangle is, at most, from the ground point of its row and column.
struct FlatTriangle {
    double up_m;
    double sideways_m;
};

// The bounds of a triangle whose legs are so many posts long, by the sine and cosine of its latitude;
// steepness: how much it rises, metres a metre. Between its corners X(lat, lon, h) is off the straight line
// by at most an eighth of its second derivatives: of the ellipsoid's bulge, of meridians that come together,
// and of verticals that are not parallel: the foot and the head of a wall.
inline FlatTriangle flat_triangle(const PostGrid& grid, const SineCosine& lat, double h_m, double steepness,
                                  double posts) {
    const double tall = posts * grid.row_step_rad();
    const double wide = posts * grid.column_step_rad();
    if (grid.net) {
        const double bent = grid.net->bend() * (tall + wide) * (tall + wide) / 8.0 +
                            grid.net->kink() * (tall + wide) / 4.0;
        const double off_m = (wgs84_a_m + std::max(0.0, h_m)) * bent;
        return {off_m,
                off_m + (wgs84_a_m + std::max(0.0, h_m)) * steepness * (tall + wide) * (tall + wide) / 4.0};
    }
    const double cosine = std::min(1.0, lat.cosine + tall), sine = std::abs(lat.sine);
    const double radius_m = wgs84_a_m + std::max(0.0, h_m);
    const double up = (tall * tall + wide * wide * cosine * cosine) / 8.0;
    const double leaning = steepness * (tall * tall + wide * wide * cosine * cosine) / 4.0;
    const double sideways = sine * (tall * wide / 4.0 + wide * wide * cosine / 8.0) + leaning;
    return {radius_m * up, radius_m * sideways};
}
inline FlatTriangle flat_triangle(const PostGrid& grid, double lat_deg, double h_m, double steepness,
                                  double posts) {
    return flat_triangle(grid, sine_cosine_deg(lat_deg), h_m, steepness, posts);
}
// Wherever on the grid: none that steep is farther off, as none has a larger sine or a larger cosine.
inline FlatTriangle widest_flat_triangle(const PostGrid& grid, double h_m, double steepness, double posts) {
    const double north_deg = std::abs(grid.north_deg()), south_deg = std::abs(grid.south_deg());
    const bool equator = grid.north_deg() > 0.0 && grid.south_deg() < 0.0;
    const double near_deg = equator ? 0.0 : std::min(north_deg, south_deg);
    const double far_deg = std::min(90.0, std::max(north_deg, south_deg));
    return flat_triangle(grid, {sine_cosine_deg(far_deg).sine, sine_cosine_deg(near_deg).cosine}, h_m,
                         steepness, posts);
}

}  // namespace oro

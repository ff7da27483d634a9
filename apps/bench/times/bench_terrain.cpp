#include "apps/bench/times/bench_region.h"

#include <cmath>

#include "shaders/shared.h"

namespace oro {

HeightField made_region(int patches) {
    constexpr double posts_per_deg = 1200.0;
    const int posts = patches * static_cast<int>(gpu::meshlet_quads) + 1;
    HeightField field;
    field.grid.lat = {posts_per_deg, 46.0 + posts / posts_per_deg, 0, -1, posts};
    field.grid.lon = {posts_per_deg, 8.0, 0, 1, posts};
    field.H_m.reserve(field.grid.post_count());
    for (int row = 0; row < posts; ++row) {
        for (int column = 0; column < posts; ++column) {
            double H_m = 750.0, height_m = 400.0, scale = 0.002;
            for (int octave = 0; octave < 8; ++octave, height_m *= 0.5, scale *= 2.1)
                H_m += height_m * std::sin(scale * row + octave) * std::cos(scale * column - octave);
            field.H_m.push_back(static_cast<float>(H_m));
        }
    }
    return field;
}

Camera eye_above(const HeightField& field, int width_px, int height_px) {
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    const double lat_deg = 0.5 * (field.grid.north_deg() + field.grid.south_deg());
    const double half_m = 0.5 * (field.grid.north_deg() - field.grid.south_deg()) * 111200.0;
    camera.eye = {lat_deg, 0.5 * (field.grid.west_deg() + field.grid.east_deg()),
                  2000.0 + 1.05 * half_m / camera.half_fov_tangent().y};
    camera.attitude.pitch_deg = -90.0;
    return camera;
}

}  // namespace oro

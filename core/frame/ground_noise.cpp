#include "core/frame/ground_noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace oro {
namespace {

constexpr double largest_cell_m = 9500.0;
constexpr double lacunarity = static_cast<double>(gpu::noise_lacunarity);
// Of noise between random numbers, evenly spread from -1 to 1, at a lattice's points: a third there; on
// average over a cell (181 + 50) / 462 per axis of that, with the fade 6 t^5 - 15 t^4 + 10 t^3.
constexpr double octave_variance = 0.4810 / 3.0;

// 1 at a middle cell, and a power of the ratio below and above it.
double band(double cell_m, double middle_m, double below, double above) {
    return std::pow(cell_m / middle_m, cell_m < middle_m ? below : -above);
}
// Half of them where borders, patches and grain of a landscape are said to be; by eye.
struct Amplitudes {
    double border, patches, grain;
};
Amplitudes amplitudes(double cell_m) {
    return {band(cell_m, 1100.0, 0.55, 0.3), band(cell_m, 1500.0, 0.25, 0.2),
            cell_m > 400.0   ? 0.0
            : cell_m > 100.0 ? 0.6
                             : 1.5};
}

using Shapes = std::array<Amplitudes, gpu::noise_octaves>;

// So that border and patches have a variance of 1, and an octave of the grain.
Shapes noise_shapes() {
    Shapes shapes{};
    Amplitudes variance{};
    double cell_m = largest_cell_m;
    for (Amplitudes& shape : shapes) {
        shape = amplitudes(cell_m);
        variance.border += octave_variance * shape.border * shape.border;
        variance.patches += octave_variance * shape.patches * shape.patches;
        cell_m /= lacunarity;
    }
    for (Amplitudes& shape : shapes) {
        shape.border /= std::sqrt(variance.border);
        shape.patches /= std::sqrt(variance.patches);
        shape.grain /= std::sqrt(octave_variance);
    }
    return shapes;
}

}  // namespace

void set_ground_noise(const Ecef& eye, gpu::FrameConstants& constants) {
    static const Shapes shapes = noise_shapes();
    glm::dvec3 at = eye.m;
    double cell_m = largest_cell_m;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        gpu::NoiseOctave& octave = constants.noise[i];
        for (int axis = 0; axis < 3; ++axis) {
            const double cells = at[axis] / cell_m, whole = std::floor(cells);
            octave.cell[axis] = static_cast<std::uint32_t>(static_cast<std::int64_t>(whole));
            octave.part[axis] = static_cast<float>(cells - whole);
        }
        octave.cell_m = static_cast<float>(cell_m);
        octave.border = static_cast<float>(shapes[i].border);
        octave.patches = static_cast<float>(shapes[i].patches);
        octave.grain = static_cast<float>(shapes[i].grain);
        // A rotation: rows of a third of (2 -2 1), (1 2 2), (2 1 -2). As shaders/shade/ground_noise.glsl.
        at = glm::dvec3(2.0 * at.x - 2.0 * at.y + at.z, at.x + 2.0 * at.y + 2.0 * at.z,
                        2.0 * at.x + at.y - 2.0 * at.z) /
             3.0;
        cell_m /= lacunarity;
    }
}

}  // namespace oro

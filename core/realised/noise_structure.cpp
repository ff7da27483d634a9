#include "core/realised/noise_structure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/made/made_heights.h"

namespace oro {
namespace {

constexpr double table_step = 0.05;
constexpr std::array correlations{
    1.000000,  0.991539,  0.966489,  0.925920,  0.871528,  0.805513,  0.730438,  0.649069,  0.564223,
    0.478627,  0.394792,  0.314917,  0.240824,  0.173915,  0.115157,  0.065100,  0.023898,  -0.008643,
    -0.033013, -0.049941, -0.060330, -0.065201, -0.065625, -0.062670, -0.057349, -0.050571, -0.043118,
    -0.035613, -0.028527, -0.022171, -0.016722, -0.012238, -0.008689, -0.005983, -0.003996, -0.002588,
    -0.001625, -0.000989, -0.000584, -0.000333, -0.000184, 0.0,       0.0};

int shift_of(double cell_m) {
    return static_cast<int>(std::lround(std::log2(cell_m * 192.0)));
}

}  // namespace

double lattice_correlation(double cells) {
    const double at = cells / table_step;
    const auto first = static_cast<std::size_t>(at);
    if (first + 2 >= correlations.size()) return 0.0;
    // Cubic between four entries, so that it is smooth; the function is even. Source: E. Catmull & R. Rom,
    // 1974.
    const double before = correlations[first == 0 ? 1 : first - 1], from = correlations[first],
                 to = correlations[first + 1], after = correlations[first + 2];
    const double t = at - static_cast<double>(first);
    const double rise = 0.5 * (to - before), next_rise = 0.5 * (after - from);
    const double t2 = t * t, t3 = t2 * t;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * from + (t3 - 2.0 * t2 + t) * rise + (3.0 * t2 - 2.0 * t3) * to +
           (t3 - t2) * next_rise;
}

double covariance_of(std::span<const NoiseBand> bands, double distance_m) {
    double sum = 0.0;
    for (const NoiseBand& band : bands) sum += band.variance * lattice_correlation(distance_m / band.cell_m);
    return sum;
}

double semivariance_of(std::span<const NoiseBand> bands, double distance_m) {
    double sum = 0.0;
    for (const NoiseBand& band : bands)
        sum += band.variance * (1.0 - lattice_correlation(distance_m / band.cell_m));
    return sum;
}

double second_difference_of(std::span<const NoiseBand> bands, double distance_m) {
    return 8.0 * semivariance_of(bands, distance_m) - 2.0 * semivariance_of(bands, 2.0 * distance_m);
}

double lattice_cell_near(double length_m) {
    return std::exp2(std::clamp(shift_of(length_m), 4, 28)) / 192.0;
}

void add_noise(std::span<const NoiseBand> bands, double scale, std::uint32_t seed, const NoisePlaces& places,
               std::span<float> values) {
    for (std::size_t i = 0; i < bands.size(); ++i) {
        const gpu::MadeOctave octave =
            made_octave(seed, static_cast<std::uint32_t>(i),
                        static_cast<std::uint32_t>(shift_of(bands[i].cell_m * scale)));
        const auto factor =
            static_cast<float>(std::sqrt(bands[i].variance) / lattice_deviation / 268435456.0);
        add_made_noise(octave, factor, places.x, places.y, places.z, values);
    }
}

}  // namespace oro

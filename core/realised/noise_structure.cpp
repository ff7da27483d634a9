#include "core/realised/noise_structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/made/made_heights.h"

namespace oro {
namespace {

// Of noise along one axis of its lattice, at places so many cells apart: the mean over a cell of the products
// of two corners' weights w, and of the weights times the distances from the corner.
struct AlongAxis {
    double weights{};
    double slopes{};
};

double corner_weight(double t) {
    const double a = std::abs(t);
    return a >= 1.0 ? 0.0 : 1.0 - a * a * a * (10.0 + a * (6.0 * a - 15.0));
}

// By Gauss and Legendre's rule of 8 points between the places where a polynomial ends (-1, 0, 1 and the same
// less `apart`): exact, for no product has a degree above 12.
AlongAxis along_axis(double apart) {
    constexpr std::array nodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                               0.9602898564975363};
    constexpr std::array shares{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                0.1012285362903763};
    std::array ends{-1.0, 0.0, 1.0, -1.0 - apart, -apart, 1.0 - apart};
    std::ranges::sort(ends);
    AlongAxis sum;
    for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
        const double half = 0.5 * (ends[piece + 1] - ends[piece]), middle = ends[piece] + half;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (const double side : {-1.0, 1.0}) {
                const double t = middle + side * half * nodes[i];
                const double product = shares[i] * half * corner_weight(t) * corner_weight(t + apart);
                sum.weights += product;
                sum.slopes += product * t * (t + apart);
            }
    }
    return sum;
}

constexpr int table_entries = 200;  // of two cells

// The covariance of an octave of amplitude 1, over all places and directions: slopes are along edges of a
// cube, so that the mean square of each part is 2/3 and parts are independent. Directions by Simpson's rule
// over an eighth of the sphere, in the cosine of the polar angle and the azimuth.
std::array<double, table_entries + 3> covariances() {
    constexpr int fine = 4 * table_entries;
    std::array<AlongAxis, fine + 3> axis;
    for (std::size_t i = 0; i < axis.size(); ++i) axis[i] = along_axis(2.0 * static_cast<double>(i) / fine);
    const auto at = [&](double apart) {
        // Cubic between entries: 1e-10 off.
        const double place = apart * fine / 2.0;
        const auto first = std::min(static_cast<std::size_t>(place), axis.size() - 3);
        const double t = place - static_cast<double>(first);
        const AlongAxis& before = axis[first == 0 ? 1 : first - 1];
        const auto between = [&](double a, double b, double c, double d) {
            return b + t * ((c - a / 3.0 - b / 2.0 - d / 6.0) +
                            t * ((a + c) / 2.0 - b + t * ((d - a) / 6.0 + (b - c) / 2.0)));
        };
        return AlongAxis{
            between(before.weights, axis[first].weights, axis[first + 1].weights, axis[first + 2].weights),
            between(before.slopes, axis[first].slopes, axis[first + 1].slopes, axis[first + 2].slopes)};
    };
    constexpr int steps = 24;
    const auto simpson = [](int i) { return i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0; };
    std::array<double, table_entries + 3> table{};
    for (std::size_t entry = 0; entry < table.size(); ++entry) {
        const double apart = 2.0 * static_cast<double>(entry) / table_entries;
        double sum = 0.0;
        for (int i = 0; i <= steps; ++i) {
            const double up = static_cast<double>(i) / steps, out = std::sqrt(1.0 - up * up);
            const AlongAxis z = at(apart * up);
            for (int k = 0; k <= steps; ++k) {
                const double azimuth = 0.5 * std::numbers::pi * k / steps;
                const AlongAxis x = at(apart * out * std::cos(azimuth)),
                                y = at(apart * out * std::sin(azimuth));
                sum += simpson(i) * simpson(k) *
                       (x.slopes * y.weights * z.weights + x.weights * y.slopes * z.weights +
                        x.weights * y.weights * z.slopes);
            }
        }
        table[entry] = 2.0 / 3.0 * sum / (9.0 * steps * steps);
    }
    return table;
}

int shift_of(double cell_m) {
    return static_cast<int>(std::lround(std::log2(cell_m * 192.0)));
}

}  // namespace

double lattice_correlation(double cells) {
    static const std::array<double, table_entries + 3> table = covariances();
    const double at = cells * table_entries / 2.0;
    const auto first = static_cast<std::size_t>(std::min(at, table_entries + 1.0));
    if (first >= table_entries) return 0.0;
    // The cubic through four entries; the function is even.
    const double t = at - static_cast<double>(first);
    const double a = table[first == 0 ? 1 : first - 1], b = table[first], c = table[first + 1],
                 d = table[first + 2];
    const double between = b + t * ((c - a / 3.0 - b / 2.0 - d / 6.0) +
                                    t * ((a + c) / 2.0 - b + t * ((d - a) / 6.0 + (b - c) / 2.0)));
    return between / table[0];
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

#include "core/realised/post_predictor.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oro {
namespace {

// Solves a x = b for several b by elimination, rows exchanged for the largest pivot; each b becomes its x.
// False: there is none.
bool solve(std::vector<double>& a, std::vector<std::vector<double>>& sides) {
    const std::size_t count = sides.front().size();
    for (std::size_t step = 0; step < count; ++step) {
        std::size_t largest = step;
        for (std::size_t row = step + 1; row < count; ++row)
            if (std::abs(a[row * count + step]) > std::abs(a[largest * count + step])) largest = row;
        if (!(std::abs(a[largest * count + step]) > 1e-12)) return false;
        if (largest != step) {
            std::swap_ranges(a.begin() + static_cast<std::ptrdiff_t>(step * count),
                             a.begin() + static_cast<std::ptrdiff_t>((step + 1) * count),
                             a.begin() + static_cast<std::ptrdiff_t>(largest * count));
            for (std::vector<double>& b : sides) std::swap(b[step], b[largest]);
        }
        for (std::size_t row = step + 1; row < count; ++row) {
            const double share = a[row * count + step] / a[step * count + step];
            if (share == 0.0) continue;
            for (std::size_t i = step; i < count; ++i) a[row * count + i] -= share * a[step * count + i];
            for (std::vector<double>& b : sides) b[row] -= share * b[step];
        }
    }
    for (std::vector<double>& b : sides) {
        for (std::size_t step = count; step-- > 0;) {
            for (std::size_t i = step + 1; i < count; ++i) b[step] -= a[step * count + i] * b[i];
            b[step] /= a[step * count + step];
        }
    }
    return true;
}

}  // namespace

std::vector<std::vector<float>> predictor_weights(std::span<const NoiseBand> terrain,
                                                  std::span<const NoiseBand> errors, double row_spacing_m,
                                                  double column_spacing_m, int finer) {
    constexpr int side = predictor_side, taps = side * side;
    constexpr std::size_t count = taps + 1;
    // By differences of rows and columns: what any two of the posts have in common.
    std::vector<double> ground(static_cast<std::size_t>(taps)), noise(static_cast<std::size_t>(taps));
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const double away_m = std::hypot(row * row_spacing_m, column * column_spacing_m);
            const auto at = static_cast<std::size_t>(row * side + column);
            ground[at] = semivariance_of(terrain, away_m);
            noise[at] = covariance_of(errors, away_m);
        }
    }
    // Scaled to errors of 1, so that the numbers are of one size.
    const double unit = std::max(noise[0], 1e-12);
    const auto apart = [](int one, int other) {
        return static_cast<std::size_t>(std::abs(one / side - other / side) * side +
                                        std::abs(one % side - other % side));
    };
    std::vector<double> a(count * count);
    for (int i = 0; i < taps; ++i) {
        const auto row = static_cast<std::size_t>(i);
        for (int j = 0; j < taps; ++j)
            a[row * count + static_cast<std::size_t>(j)] = (noise[apart(i, j)] - ground[apart(i, j)]) / unit;
        a[row * count + row] += 1e-6;
        a[row * count + taps] = a[taps * count + row] = 1.0;
    }
    std::vector<std::vector<double>> sides;
    for (int place = 0; place < finer * finer; ++place) {
        const double down = predictor_reach + static_cast<double>(place / finer) / finer,
                     right = predictor_reach + static_cast<double>(place % finer) / finer;
        std::vector<double>& b = sides.emplace_back(count, 1.0);
        for (int i = 0; i < taps; ++i)
            b[static_cast<std::size_t>(i)] =
                -semivariance_of(terrain, std::hypot((i / side - down) * row_spacing_m,
                                                     (i % side - right) * column_spacing_m)) /
                unit;
    }
    if (!solve(a, sides)) return {};
    std::vector<std::vector<float>> weights;
    for (const std::vector<double>& b : sides) weights.emplace_back(b.begin(), b.begin() + taps);
    return weights;
}

}  // namespace oro

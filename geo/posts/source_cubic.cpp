#include "geo/posts/source_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oro {
namespace {

struct Weights {
    int first{};  // post that the first weight belongs to
    std::array<double, 4> w{};
};

// Along one axis: Keys' kernel inside, a straight line beyond the ends; phantom posts outside go on straight.
Weights cubic_weights(double at, int count, bool round) {
    Weights result;
    const double floor = std::floor(at);
    const int i = round ? static_cast<int>(floor) : std::clamp(static_cast<int>(floor), 0, count - 2);
    const double t = at - i;
    result.first = i - 1;
    auto& w = result.w;
    if (t < 0.0 || t > 1.0) {
        w = {0.0, 1.0 - t, t, 0.0};
        return result;
    }
    w = {t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2.0 - 1.5 * t)),
         t * t * (-0.5 + 0.5 * t)};
    if (round) return result;
    if (i - 1 < 0) {
        w[1] += 2.0 * w[0];
        w[2] -= w[0];
        w[0] = 0.0;
    }
    if (i + 2 > count - 1) {
        w[2] += 2.0 * w[3];
        w[1] -= w[3];
        w[3] = 0.0;
    }
    return result;
}

// Sum over the stencil; false when a post that counts is void.
bool weighted(const PostBlock& block, int columns, bool round, const Weights& u, const Weights& v,
              double& height) {
    constexpr double counts = 1e-9;
    height = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
        if (std::abs(v.w[j]) < counts) continue;
        for (std::size_t i = 0; i < 4; ++i) {
            if (std::abs(u.w[i]) < counts) continue;
            const float post = height_or_void(block, columns, round, u.first + static_cast<int>(i),
                                              v.first + static_cast<int>(j));
            if (is_void(post)) return false;
            height += u.w[i] * v.w[j] * static_cast<double>(post);
        }
    }
    return true;
}

Weights linear_weights(double at, const Weights& cubic) {
    const double t = at - (cubic.first + 1);
    return {cubic.first, {0.0, 1.0 - t, t, 0.0}};
}

}  // namespace

float height_or_void(const PostBlock& block, int columns, bool round, int column, int row) {
    if (round) column = ((column % columns) + columns) % columns;
    const PostWindow& w = block.window;
    if (row < w.row || row >= w.row + w.rows || column < w.column || column >= w.column + w.columns)
        return void_height_m;
    return block.at(row, column);
}

float cubic_height_m(const PostBlock& block, int rows, int columns, bool round, double column, double row,
                     double limit_m) {
    const double on_column = round ? column : std::clamp(column, 0.0, columns - 1.0);
    const double on_row = std::clamp(row, 0.0, rows - 1.0);
    const Weights u = cubic_weights(column, columns, round);
    const Weights v = cubic_weights(row, rows, false);
    const Weights u_linear = linear_weights(on_column, cubic_weights(on_column, columns, round));
    const Weights v_linear = linear_weights(on_row, cubic_weights(on_row, rows, false));
    double linear = 0.0;
    double cubic = 0.0;
    if (!weighted(block, columns, round, u_linear, v_linear, linear)) return void_height_m;
    if (!weighted(block, columns, round, u, v, cubic)) return static_cast<float>(linear);
    return static_cast<float>(std::clamp(cubic, linear - limit_m, linear + limit_m));
}

}  // namespace oro

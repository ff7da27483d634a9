// Means of the ground as one post after the other gives them: the rule that GroundMeans' vector code is held
// to.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/packing.hpp>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/post_grid.h"
#include "shaders/shared.h"

namespace oro::test {

// All levels' squares, row by row. Regions on latitudes and longitudes that do not go round the Earth.
class OldGroundMeans {
  public:
    OldGroundMeans(const PostGrid& grid, const DrawnHeights& heights, float exaggeration)
        : grid_(grid), heights_(heights), exaggeration_(exaggeration) {}

    struct Sums {
        float x{}, y{}, z{}, xx{}, xy{}, yy{}, h_m{}, hh_m2{}, posts{};
        void add(const Sums& o) {
            x += o.x;
            y += o.y;
            z += o.z;
            xx += o.xx;
            xy += o.xy;
            yy += o.yy;
            h_m += o.h_m;
            hh_m2 += o.hh_m2;
            posts += o.posts;
        }
    };

    // Of one post; weight: of the slopes of those beside it.
    [[nodiscard]] Sums post(int row, int column, float weight) const {
        const std::int32_t here = steps(row, column);
        if (here == void_height_steps) return {};
        float down = rise(row, column, 1, 0), right = rise(row, column, 0, 1), downs = 1.0F, rights = 1.0F;
        for (const int side : {-1, 1}) {
            if (weight == 0.0F) break;
            if (steps(row, column + side) != void_height_steps) {
                down += weight * rise(row, column + side, 1, 0);
                downs += weight;
            }
            if (steps(row + side, column) != void_height_steps) {
                right += weight * rise(row + side, column, 0, 1);
                rights += weight;
            }
        }
        const double lat_deg = row_lat_deg(grid_, row);
        const double down_m = meridian_radius_m(lat_deg) * radians_from_deg(grid_.lat.spacing_deg()).rad;
        const double right_m = prime_vertical_radius_m(lat_deg) * std::abs(sine_cosine_deg(lat_deg).cosine) *
                               radians_from_deg(grid_.lon.spacing_deg()).rad;
        down *= static_cast<float>(height_step_m / down_m) / downs;
        right *= static_cast<float>(height_step_m / std::max(right_m, 1.0e-3)) / rights;
        const float length = std::sqrt(down * down + right * right + 1.0F);
        const float h_m = static_cast<float>(here) * static_cast<float>(height_step_m) / exaggeration_;
        const float x = -right / length, y = down / length;
        return {x, y, 1.0F / length, x * x, x * y, y * y, h_m, h_m * h_m, 1.0F};
    }
    // Of a square of 2^level posts each way.
    [[nodiscard]] Sums sums(int level, int row, int column) const {
        if (level == 0) return post(row, column, 0.8F);
        Sums sum;
        for (int part = 0; part < 4; ++part)
            sum.add(sums(level - 1, 2 * row + part / 2, 2 * column + part % 2));
        return sum;
    }

    [[nodiscard]] static gpu::MeansSquare packed(const Sums& sums) {
        if (sums.posts == 0.0F) return {};
        const auto part = [&](float sum) {
            return static_cast<std::int32_t>(std::lround(sum / sums.posts * gpu::means_normal_steps));
        };
        const auto x = static_cast<std::uint32_t>(part(sums.x)), y = static_cast<std::uint32_t>(part(sums.y));
        const auto z = static_cast<std::uint32_t>(std::max(part(sums.z), 1));
        const float h_m = sums.h_m / sums.posts;
        const float spread_m = std::sqrt(std::max(0.0F, sums.hh_m2 / sums.posts - h_m * h_m));
        return {(x & 0x7ffU) | (y & 0x7ffU) << 11U | z << 22U,
                glm::packHalf2x16({std::clamp(h_m, -65000.0F, 65000.0F), std::min(spread_m, 65000.0F)}),
                spread(sums)};
    }

  private:
    [[nodiscard]] std::int32_t steps(int row, int column) const {
        if (row < 0 || row >= grid_.rows() || column < 0 || column >= grid_.columns())
            return void_height_steps;
        return heights_.at(row, column);
    }
    [[nodiscard]] float rise(int row, int column, int rows, int columns) const {
        const std::int32_t here = steps(row, column), before = steps(row - rows, column - columns),
                           after = steps(row + rows, column + columns);
        const bool no_before = before == void_height_steps, no_after = after == void_height_steps;
        const float whole = static_cast<float>((no_after ? here : after) - (no_before ? here : before));
        return no_before == no_after ? 0.5F * whole : whole;
    }
    [[nodiscard]] static std::uint32_t spread(const Sums& sums) {
        const float x = sums.x / sums.posts, y = sums.y / sums.posts;
        const float along_x = std::sqrt(std::max(0.0F, sums.xx / sums.posts - x * x));
        const float along_y = std::sqrt(std::max(0.0F, sums.yy / sums.posts - y * y));
        const float both = along_x * along_y;
        const float correlation = both > 1.0e-6F ? (sums.xy / sums.posts - x * y) / both : 0.0F;
        const auto steps = [](float part, float count) {
            return static_cast<std::uint32_t>(
                static_cast<std::int32_t>(std::lround(std::clamp(part, -1.0F, 1.0F) * count)));
        };
        return steps(along_x, gpu::means_spread_steps) | steps(along_y, gpu::means_spread_steps) << 11U |
               steps(correlation, gpu::means_correlation_steps) << 22U;
    }

    const PostGrid& grid_;
    const DrawnHeights& heights_;
    float exaggeration_;
};

}  // namespace oro::test

#include "core/lod/ground_means.h"

#include <algorithm>
#include <cmath>
#include <glm/packing.hpp>

#include "core/base/parallel.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/level_grid.h"

namespace oro {

namespace {

// Ground is shaded from slopes that are smooth at and between posts. What squares of several posts know of
// their spread is of such slopes: those of the posts beside weigh half by Horn's formula, more for what is
// between posts. By trial. Source: B. K. P. Horn, Hill shading and the reflectance map, Proceedings of the
// IEEE 69(1), 1981.
constexpr float neighbour_weight = 0.8F;

}  // namespace

// Sums over the posts of a square.
struct GroundMeans::Sums {
    float x{}, y{}, z{};     // of unit normals: east, north, up
    float xx{}, xy{}, yy{};  // of their products
    float h_m{};
    float hh_m2{};
    float posts{};

    void add(const Sums& other) {
        x += other.x;
        y += other.y;
        z += other.z;
        xx += other.xx;
        xy += other.xy;
        yy += other.yy;
        h_m += other.h_m;
        hh_m2 += other.hh_m2;
        posts += other.posts;
    }
};

GroundMeans::GroundMeans(const PostGrid& grid, const DrawnHeights& heights, double exaggeration, int threads)
    : grid_(grid),
      heights_(heights),
      exaggeration_(static_cast<float>(exaggeration)),
      wraps_longitude_(grid.wraps_longitude()) {
    for (int row = 0; !grid.net && row < grid.rows(); ++row) {
        const double lat_deg = row_lat_deg(grid, row);
        const double down_m = meridian_radius_m(lat_deg) * radians_from_deg(grid.lat.spacing_deg()).rad;
        const double right_m = prime_vertical_radius_m(lat_deg) * std::abs(sine_cosine_deg(lat_deg).cosine) *
                               radians_from_deg(grid.lon.spacing_deg()).rad;
        rows_.push_back({static_cast<float>(height_step_m / down_m),
                         static_cast<float>(height_step_m / std::max(right_m, 1.0e-3))});
    }
    if (grid.net) measure_net();
    levels_.push_back({grid.rows(), wraps_longitude_ ? grid.columns() - 1 : grid.columns(), {}});
    std::vector<Sums> below;
    for (int level = 1; level < level_count(grid); ++level) add_level(below, threads);
}

void GroundMeans::measure_net() {
    net_columns_ = (grid_.columns() + scale_posts - 2) / scale_posts + 1;
    const int rows = (grid_.rows() + scale_posts - 2) / scale_posts + 1;
    for (int i = 0; i < rows * net_columns_; ++i) {
        const LatticeGeoreference::LatticeFrame local_frame =
            grid_.net->local_frame_at(i / net_columns_ * scale_posts, i % net_columns_ * scale_posts);
        net_scales_.push_back({static_cast<float>(height_step_m / local_frame.row_m),
                               static_cast<float>(height_step_m / local_frame.column_m),
                               static_cast<float>(std::cos(local_frame.turn_rad)),
                               static_cast<float>(std::sin(local_frame.turn_rad))});
    }
}

GroundMeans::NetScale GroundMeans::scale_on_net(int row, int column) const {
    const float down = static_cast<float>(row % scale_posts) / scale_posts,
                right = static_cast<float>(column % scale_posts) / scale_posts;
    const NetScale* const north =
        net_scales_.data() + row / scale_posts * net_columns_ + column / scale_posts;
    const int on = column % scale_posts == 0 ? 0 : 1, below = row % scale_posts == 0 ? 0 : net_columns_;
    const auto mixed = [&](float NetScale::*part) {
        const float upper = north[0].*part + right * (north[on].*part - north[0].*part);
        const float lower = north[below].*part + right * (north[below + on].*part - north[below].*part);
        return upper + down * (lower - upper);
    };
    return {mixed(&NetScale::down_per_m), mixed(&NetScale::right_per_m), mixed(&NetScale::turn_cosine),
            mixed(&NetScale::turn_sine)};
}

std::int32_t GroundMeans::steps(int row, int column) const {
    if (row < 0 || row >= grid_.rows()) return void_height_steps;
    if (wraps_longitude_) column = (column + grid_.columns() - 1) % (grid_.columns() - 1);
    if (column < 0 || column >= grid_.columns()) return void_height_steps;
    return heights_.at(row, column);
}

// From the post before to the one after, in steps: rows apart or columns apart. The post itself must not be
// void.
float GroundMeans::rise(int row, int column, int rows, int columns) const {
    const std::int32_t here = steps(row, column), before = steps(row - rows, column - columns),
                       after = steps(row + rows, column + columns);
    const bool no_before = before == void_height_steps, no_after = after == void_height_steps;
    const float whole = static_cast<float>((no_after ? here : after) - (no_before ? here : before));
    return no_before == no_after ? 0.5F * whole : whole;
}

GroundMeans::Sums GroundMeans::post(int row, int column, float neighbour_share) const {
    const std::int32_t here = steps(row, column);
    if (here == void_height_steps) return {};
    float down = rise(row, column, 1, 0), right = rise(row, column, 0, 1), down_whole = 1.0F,
          right_whole = 1.0F;
    for (int side = -1; neighbour_share > 0.0F && side <= 1; side += 2) {
        if (steps(row, column + side) != void_height_steps) {
            down += neighbour_share * rise(row, column + side, 1, 0);
            down_whole += neighbour_share;
        }
        if (steps(row + side, column) != void_height_steps) {
            right += neighbour_share * rise(row + side, column, 0, 1);
            right_whole += neighbour_share;
        }
    }
    if (grid_.net) {
        // Rows and columns are turned from south and east.
        const NetScale scale = scale_on_net(row, column);
        const float along = right * scale.right_per_m / right_whole,
                    back = down * scale.down_per_m / down_whole;
        right = along * scale.turn_cosine + back * scale.turn_sine;
        down = back * scale.turn_cosine - along * scale.turn_sine;
    } else {
        const RowScale& scale = rows_[static_cast<std::size_t>(row)];
        down *= scale.down_per_m / down_whole;
        right *= scale.right_per_m / right_whole;
    }
    const float length = std::sqrt(down * down + right * right + 1.0F);
    const float h_m = static_cast<float>(here) * static_cast<float>(height_step_m) / exaggeration_;
    const float x = -right / length, y = down / length;
    return {x, y, 1.0F / length, x * x, x * y, y * y, h_m, h_m * h_m, 1.0F};
}

// Four squares of the level below make one.
void GroundMeans::add_level(std::vector<Sums>& below, int threads) {
    const Level& finer = levels_.back();
    Level level{(finer.rows + 1) / 2, (finer.columns + 1) / 2, {}};
    const std::size_t count = static_cast<std::size_t>(level.rows) * static_cast<std::size_t>(level.columns);
    std::vector<Sums> sums(count);
    level.squares.resize(count);
    const auto finer_at = [&](int row, int column) {
        if (row >= finer.rows || column >= finer.columns) return Sums{};
        if (finer.squares.empty()) return post(row, column, neighbour_weight);
        return below[static_cast<std::size_t>(row) * static_cast<std::size_t>(finer.columns) +
                     static_cast<std::size_t>(column)];
    };
    in_parallel(level.rows, threads, [&](int row) {
        for (int column = 0; column < level.columns; ++column) {
            const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                                   static_cast<std::size_t>(column);
            for (int part = 0; part < 4; ++part)
                sums[at].add(finer_at(2 * row + part / 2, 2 * column + part % 2));
            level.squares[at] = packed(sums[at]);
        }
    });
    below = std::move(sums);
    levels_.push_back(std::move(level));
}

// See shaders/shared.h, PageMeans.
gpu::MeansSquare GroundMeans::packed(const Sums& sums) {
    if (sums.posts == 0.0F) return {};
    const auto part = [&](float sum) {
        return static_cast<std::int32_t>(std::lround(sum / sums.posts * gpu::means_normal_steps));
    };
    const auto x = static_cast<std::uint32_t>(part(sums.x)), y = static_cast<std::uint32_t>(part(sums.y));
    const auto z = static_cast<std::uint32_t>(std::max(part(sums.z), 1));
    const float h_m = sums.h_m / sums.posts;
    const float spread_m = std::sqrt(std::max(0.0F, sums.hh_m2 / sums.posts - h_m * h_m));
    constexpr float most_m = 65000.0F;  // of a half
    return {(x & 0x7ffU) | (y & 0x7ffU) << 11U | z << 22U,
            glm::packHalf2x16({std::clamp(h_m, -most_m, most_m), std::min(spread_m, most_m)}),
            packed_spread(sums)};
}

std::uint32_t GroundMeans::packed_spread(const Sums& sums) {
    const float x = sums.x / sums.posts, y = sums.y / sums.posts;
    const float along_x = std::sqrt(std::max(0.0F, sums.xx / sums.posts - x * x));
    const float along_y = std::sqrt(std::max(0.0F, sums.yy / sums.posts - y * y));
    const float both = along_x * along_y;
    const float correlation = both > 1.0e-6F ? (sums.xy / sums.posts - x * y) / both : 0.0F;
    const auto steps = [](float part, float count) {
        return static_cast<std::int32_t>(std::lround(std::clamp(part, -1.0F, 1.0F) * count));
    };
    return static_cast<std::uint32_t>(steps(along_x, gpu::means_spread_steps)) |
           static_cast<std::uint32_t>(steps(along_y, gpu::means_spread_steps)) << 11U |
           static_cast<std::uint32_t>(steps(correlation, gpu::means_correlation_steps)) << 22U;
}

void GroundMeans::page(const PageIndex& index, gpu::PageMeans& means) const {
    constexpr int apron = static_cast<int>(gpu::means_apron), stride = static_cast<int>(gpu::means_stride);
    const Level& level = levels_[static_cast<std::size_t>(index.level)];
    for (int i = 0; i < stride * stride; ++i) {
        const int row = index.row * static_cast<int>(gpu::page_quads) + i / stride - apron;
        int column = index.column * static_cast<int>(gpu::page_quads) + i % stride - apron;
        if (wraps_longitude_) column = (column + level.columns) % level.columns;
        gpu::MeansSquare& square = means.squares[i];
        square = {};
        if (row >= 0 && row < level.rows && column >= 0 && column < level.columns)
            square =
                index.level == 0
                    ? packed(post(row, column, 0.0F))
                    : level.squares[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                                    static_cast<std::size_t>(column)];
    }
}

}  // namespace oro

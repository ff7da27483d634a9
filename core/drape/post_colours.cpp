#include "core/drape/post_colours.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/terrain/level_grid.h"

namespace oro {
namespace {

constexpr int texel_side = gpu::drape_stride;
constexpr int most_samples = 8;  // along a side of a texel

using Channels = std::array<double, 4>;

Channels channels_of(std::uint32_t texel) {
    Channels channels{};
    for (std::size_t k = 0; k < 4; ++k) channels[k] = static_cast<double>(texel >> (8U * k) & 0xFFU);
    return channels;
}

std::uint32_t texel_of_channels(const Channels& channels) {
    std::uint32_t texel = 0;
    for (std::size_t k = 0; k < 4; ++k)
        texel |= static_cast<std::uint32_t>(std::lround(std::clamp(channels[k], 0.0, 255.0))) << (8U * k);
    return texel;
}

class ColoursOverGround final : public GroundImage {
  public:
    ColoursOverGround(const PostGrid& grid, std::size_t grid_number,
                      std::shared_ptr<const PostColours> colours, std::unique_ptr<const GroundImage> under,
                      double opacity)
        : grid_(grid),
          is_own_(grid_number == colours->grid_number && grid.rows() == colours->grid.rows() &&
                  grid.columns() == colours->grid.columns()),
          colours_(std::move(colours)),
          under_(std::move(under)),
          opacity_(opacity) {}

    [[nodiscard]] int finest_level() const override {
        return std::min(0, under_ ? under_->finest_level() : 0);
    }
    [[nodiscard]] int coarsest_level() const override { return level_count(grid_) - 1; }
    Result<bool> load(const ImageTile& tile, std::span<std::uint32_t> texels) const override;

  private:
    [[nodiscard]] std::uint32_t at(double row, double column) const;
    [[nodiscard]] Channels mean(const ImageTile& tile, int row, int column) const;

    PostGrid grid_;
    bool is_own_;
    std::shared_ptr<const PostColours> colours_;
    std::unique_ptr<const GroundImage> under_;
    double opacity_;
};

// At fractional numbers of a post of grid_.
std::uint32_t ColoursOverGround::at(double row, double column) const {
    constexpr double half = 0.5;
    if (row < -half || row > grid_.rows() - half || column < -half || column > grid_.columns() - half)
        return 0;
    PostNumber post{row, column};
    if (!is_own_) {
        const PostPlace place = grid_.place_at(row, column);
        post = colours_->grid.post_at(place.lat_deg, place.lon_deg);
    }
    if (!std::isfinite(post.row) || !std::isfinite(post.column)) return 0;
    const double down = std::floor(post.row + half) - colours_->part.first_row;
    double right = std::floor(post.column + half) - colours_->part.first_column;
    if (colours_->grid.wraps_longitude()) {
        const double turn = colours_->grid.columns() - 1;
        right -= turn * std::floor(right / turn);
    }
    if (!(down >= 0.0 && down < colours_->part.rows && right >= 0.0 && right < colours_->part.columns))
        return 0;
    return colours_->rgba[static_cast<std::size_t>(down) * static_cast<std::size_t>(colours_->part.columns) +
                          static_cast<std::size_t>(right)];
}

Channels ColoursOverGround::mean(const ImageTile& tile, int row, int column) const {
    const double middle_row = post_of_texel(tile.level, tile.row, row),
                 middle_column = post_of_texel(tile.level, tile.column, column);
    const double posts = std::ldexp(0.5, tile.level);  // along a side
    const int samples = static_cast<int>(std::clamp(posts, 1.0, static_cast<double>(most_samples)));
    Channels sum{};
    for (int i = 0; i < samples * samples; ++i) {
        const double down = (i / samples + 0.5) / samples - 0.5, right = (i % samples + 0.5) / samples - 0.5;
        const Channels one = channels_of(at(middle_row + posts * down, middle_column + posts * right));
        for (std::size_t k = 0; k < 4; ++k) sum[k] += one[k] / (samples * samples);
    }
    return sum;
}

Result<bool> ColoursOverGround::load(const ImageTile& tile, std::span<std::uint32_t> texels) const {
    assert(texels.size() == gpu::drape_words);
    bool any = false;
    if (under_) {
        ORO_TRY(any, under_->load(tile, texels));
    }
    const bool has_under = any;
    for (int row = 0; row < texel_side; ++row) {
        for (int column = 0; column < texel_side; ++column) {
            std::uint32_t& texel = texels[static_cast<std::size_t>(row * texel_side + column)];
            Channels all = mean(tile, row - 1, column - 1);
            any = any || all[3] > 0.0;
            const double left = has_under ? (1.0 - all[3] / 255.0) * opacity_ : 0.0;
            const Channels below = has_under ? channels_of(texel) : Channels{};
            for (std::size_t k = 0; k < 4; ++k) all[k] += left * below[k];
            texel = texel_of_channels(all);
        }
    }
    return any;
}

}  // namespace

std::uint32_t texel_of(std::uint8_t red, std::uint8_t green, std::uint8_t blue, double alpha) {
    return texel_of_channels({red * alpha, green * alpha, blue * alpha, 255.0 * alpha});
}

std::unique_ptr<const GroundImage> colours_over_ground(const PostGrid& grid, std::size_t grid_number,
                                                       std::shared_ptr<const PostColours> colours,
                                                       std::unique_ptr<const GroundImage> under,
                                                       double opacity) {
    return std::make_unique<ColoursOverGround>(grid, grid_number, std::move(colours), std::move(under),
                                               opacity);
}

}  // namespace oro

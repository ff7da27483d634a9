#include "geo/drape/tile_sampling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/terrain/level_grid.h"

namespace oro {
namespace {

constexpr double most_pixels = 3e7;  // that are read for a tile

// Rows or columns, whichever are more; nothing where that is not known.
double posts_between(const PostGrid& grid, const ImagePlacing::Spot& here, const ImagePlacing::Spot& there) {
    if (grid.net) {
        const PostNumber one = grid.net->post_at(here.lat_deg, here.lon_deg),
                         other = grid.net->post_at(there.lat_deg, there.lon_deg);
        // Far from the grid its rows and columns say nothing.
        const double far = 2.0 * std::max(grid.rows(), grid.columns());
        if (std::max(std::abs(one.row), std::abs(one.column)) > far) return 0.0;
        return std::max(std::abs(other.row - one.row), std::abs(other.column - one.column));
    }
    return std::max(std::abs((there.lat_deg - here.lat_deg) * grid.lat.posts_per_deg),
                    std::abs(std::remainder(there.lon_deg - here.lon_deg, 360.0) * grid.lon.posts_per_deg));
}

}  // namespace

Sampling sampling_of(const PixelPlace& per_texel) {
    const double least = std::min(per_texel.column, per_texel.row);
    Sampling sampling;
    while (sampling.step * 4.0 <= least && sampling.step < (1 << 28)) sampling.step *= 2;
    const auto places = [&](double pixels) {
        return std::clamp(static_cast<int>(std::ceil(pixels / sampling.step - 0.01)), 1, 16);
    };
    sampling.columns = places(per_texel.column);
    sampling.rows = places(per_texel.row);
    return sampling;
}

std::optional<PixelWindow> window_of(const PlacedRaster& raster, const TilePlacing& tile,
                                     const PixelPlace& moved, Sampling& sampling) {
    PixelPlace low, high;
    if (!tile.bounds(low, high)) return std::nullopt;
    for (;; sampling.step *= 2) {
        const double step = sampling.step,
                     rim = 2.0 * step + std::max(tile.per_texel().column, tile.per_texel().row);
        const auto from = [&](double at) { return std::max(0.0, std::floor((at - rim) / step) * step); };
        const auto to = [&](double at, int end) {
            return std::min<double>(end, std::ceil((at + rim) / step) * step);
        };
        const double west = from(low.column + moved.column), north = from(low.row + moved.row);
        const double east = to(high.column + moved.column, raster.columns),
                     south = to(high.row + moved.row, raster.rows);
        if (!(west < east && north < south)) return std::nullopt;
        if ((east - west) * (south - north) / (step * step) > most_pixels) continue;
        return PixelWindow{static_cast<int>(west), static_cast<int>(north), static_cast<int>(east - west),
                           static_cast<int>(south - north)};
    }
}

std::vector<PixelPlace> turns_of(const ImagePlacing& placing) {
    const std::optional<PixelPlace> turn = placing.turn();
    if (!turn) return {PixelPlace{}};
    std::vector<PixelPlace> all;
    for (int turns = -1; turns <= 1; ++turns) all.push_back({turns * turn->column, turns * turn->row});
    return all;
}

bool lies_over(const PlacedRaster& raster, const ImagePlacing& placing, const PostGrid& grid) {
    const TilePlacing whole(grid, {level_count(grid) - 1, 0, 0}, placing);
    for (const PixelPlace& moved : turns_of(placing)) {
        Sampling sampling = sampling_of(whole.per_texel());
        if (window_of(raster, whole, moved, sampling)) return true;
    }
    return false;
}

int finest_level_of(const PlacedRaster& raster, const ImagePlacing& placing, const PostGrid& grid) {
    double least_posts = HUGE_VAL;
    constexpr int places = 8;
    for (int i = 0; i <= places * (places + 2); ++i) {
        const double column = raster.columns * static_cast<double>(i % (places + 1)) / places,
                     row = raster.rows * static_cast<double>(i / (places + 1)) / places;
        const auto here = placing.spot({column, row});
        for (const PixelPlace& next : {PixelPlace{column + 1.0, row}, PixelPlace{column, row + 1.0}}) {
            const auto there = placing.spot(next);
            if (!here || !there) continue;
            const double posts = posts_between(grid, *here, *there);
            if (posts > 0.0) least_posts = std::min(least_posts, posts);
        }
    }
    return std::isfinite(least_posts) ? static_cast<int>(std::floor(std::log2(least_posts))) : 0;
}

int least_level(const PostGrid& grid) {
    int level = 0;
    while (level > gpu::drape_finest &&
           (std::int64_t{std::max(grid.rows(), grid.columns())} << (1 - level)) < (std::int64_t{1} << 30))
        --level;
    return level;
}

}  // namespace oro

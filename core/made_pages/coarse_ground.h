// Between which heights the ground of made terrain lies, by its coarse octaves at every fourth post.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "core/made_pages/measured_block.h"

namespace oro {

// Tiles of 128 x 128 cells of a region: those of its pages of level 0. Any thread.
class CoarseGround {
  public:
    static constexpr int level = 2, tile_cells = 128, tile_posts = (tile_cells >> level) + 1;

    // region: outlives it.
    explicit CoarseGround(const MadeRegion& region) : region_(region) {}

    // h of all that is drawn over a cell, at full resolution or of posts of any level, is between what its
    // four posts have here: the lowest of `low_m` and the highest of `high_m`.
    struct Tile {
        int rows{}, columns{};        // of posts, tile_posts or fewer where the region ends
        std::vector<float> coarse_m;  // H of the coarse octaves, row by row
        float off_m{};                // that H may be off, either way,
        float lowest_H_m{}, highest_H_m{};
        float lowest_N_m{}, highest_N_m{};
        [[nodiscard]] float low_m(std::size_t post) const {
            return std::max(coarse_m[post] - off_m, lowest_H_m) + lowest_N_m;
        }
        [[nodiscard]] float high_m(std::size_t post) const {
            return std::min(coarse_m[post] + off_m, highest_H_m) + highest_N_m;
        }
    };
    // Row and column of the tile; it is one of the region.
    [[nodiscard]] Tile tile(int row, int column) const;
    // No lower than h of anything over a node of level 3 or above. Keeps 16 bytes a tile.
    [[nodiscard]] float highest_m(int node_level, int row, int column) const;
    [[nodiscard]] const MadeRegion& region() const { return region_; }
    // The region's post of a tile's row or column of posts.
    [[nodiscard]] static int region_post(int tile, int post, int last) {
        return static_cast<int>(
            std::min<std::int64_t>(last, std::int64_t{tile} * tile_cells + (std::int64_t{post} << level)));
    }

  private:
    using Quarters = std::array<float, 4>;  // nodes of level 3
    [[nodiscard]] Quarters highest_of_quarters(int row, int column) const;

    const MadeRegion& region_;
    mutable std::mutex mutex_;
    mutable std::unordered_map<std::uint64_t, Quarters> highest_m_;
};

}  // namespace oro

// Random places that tiles are measured at, the same ones in each run.
#pragma once

#include <cstdint>
#include <span>

#include "core/terrain/post_grid.h"

namespace oro {

// Numbers of [0, 1), the same of every library. Source: S. Vigna, splitmix64.
class RandomShares {
  public:
    explicit RandomShares(std::uint64_t seed) : state_(seed) {}
    double next() {
        std::uint64_t bits = state_ += 0x9E3779B97F4A7C15U;
        bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9U;
        bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBU;
        return static_cast<double>((bits ^ (bits >> 31U)) >> 11U) * 0x1.0p-53;
    }

  private:
    std::uint64_t state_;
};

// A place in the box of one of some grids, each post as likely as another. At least one grid.
inline PostPlace random_place(std::span<const PostGrid* const> grids, RandomShares& random) {
    double posts = 0.0;
    for (const PostGrid* const one : grids) posts += static_cast<double>(one->post_count());
    double number = random.next() * posts;
    const PostGrid* grid = grids.front();
    for (const PostGrid* const one : grids) {
        grid = one;
        if (number < static_cast<double>(one->post_count())) break;
        number -= static_cast<double>(one->post_count());
    }
    const double row = random.next() * (grid->rows() - 1);
    return grid->place_at(row, random.next() * (grid->columns() - 1));
}

}  // namespace oro

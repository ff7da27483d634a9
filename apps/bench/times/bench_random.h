// Eyes anywhere over a region: nobody has chosen them, so nothing can have been tuned to them.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "apps/bench/bench_path.h"
#include "core/frame/region_pages.h"

namespace oro {

// Numbers by chance: one seed, the same numbers on every machine. What the standard library makes of an
// engine is its own affair.
class EvenNumbers {
  public:
    explicit EvenNumbers(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high);
    int below(int count);  // 0 to count - 1

  private:
    std::mt19937_64 engine_;
};

// Heights of posts of the finest level, as they are drawn. It keeps the page that was asked last; the pages
// outlive it.
class DrawnPosts {
  public:
    explicit DrawnPosts(const RegionPages& pages) : pages_(pages) {}
    // Above the ellipsoid, metres; void_height_m where there is none. Errors: a file that cannot be read.
    Result<double> h_m(int row, int column);

  private:
    const RegionPages& pages_;
    PageIndex page_{-1, -1, 0};
    std::unique_ptr<gpu::PageBlock> block_;
};

// `count` eyes over posts that are there, each with the same chance. Height above the ground is log-uniform
// from 2 m to 400 km, headings are even, and the middle of the picture is 0 to 30 degrees below the horizon.
// One seed: the same eyes, on every machine. Names tell all that. Errors: a file that cannot be read; a
// region whose posts lie on a net, or that has none.
Result<std::vector<BenchEye>> random_eyes(const RegionPages& pages, int count, std::uint64_t seed,
                                          int width_px, int height_px);

// Of some eyes, in one unit.
struct SpreadOfEyes {
    double median{};
    double high{};  // 95 % of them have no more
    double worst{};
    std::vector<std::size_t> worst_eyes;  // at most five, the worst first
};
SpreadOfEyes spread_of(const std::vector<double>& values);

}  // namespace oro

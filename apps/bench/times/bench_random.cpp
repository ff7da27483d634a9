#include "apps/bench/times/bench_random.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <numeric>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

constexpr double lowest_m = 2.0, highest_m = 400'000.0, steepest_deg = 30.0;

std::string name_of(const Camera& camera, double above_m) {
    char text[128];
    std::snprintf(text, sizeof(text), "%.4f %.4f, %.0f m above ground, heading %.0f, pitch %.1f",
                  camera.eye.lat_deg, camera.eye.lon_deg, above_m, camera.attitude.heading_deg,
                  camera.attitude.pitch_deg);
    return text;
}

}  // namespace

double EvenNumbers::between(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11U), -53);
}

int EvenNumbers::below(int count) {
    return std::min(count - 1, static_cast<int>(between(0.0, count)));
}

Result<double> DrawnPosts::h_m(int row, int column) {
    constexpr int quads = static_cast<int>(gpu::page_quads), stride = static_cast<int>(gpu::height_stride);
    const PageLayout layout = pages_.layout(0);
    const PageIndex page{std::min(row / quads, layout.rows - 1), std::min(column / quads, layout.columns - 1),
                         0};
    if (!block_) block_ = std::make_unique<gpu::PageBlock>();
    if (page_.row != page.row || page_.column != page.column) {
        ORO_CHECK(pages_.load(page, *block_));
        page_ = page;
    }
    const int at = (row - page.row * quads + 1) * stride + column - page.column * quads + 1;
    const int steps = block_->heights[at];
    return steps == gpu::void_height ? static_cast<double>(void_height_m)
                                     : steps * static_cast<double>(gpu::height_step_m);
}

Result<std::vector<BenchEye>> random_eyes(const RegionPages& pages, int count, std::uint64_t seed,
                                          int width_px, int height_px) {
    const PostGrid& grid = pages.facts().grid;
    if (grid.net) return Error{ErrorKind::usage, "--random-eyes", "is not for posts in a CRS of their own"};
    EvenNumbers random(seed);
    DrawnPosts posts(pages);
    std::vector<BenchEye> eyes;
    constexpr int most_voids = 100'000;
    for (int tries = 0; static_cast<int>(eyes.size()) < count; ++tries) {
        if (tries > most_voids + count) return Error{ErrorKind::failed, "--random-eyes", "finds no posts"};
        const int row = random.below(grid.rows()), column = random.below(grid.columns());
        ORO_TRY(const double ground_m, posts.h_m(row, column));
        if (ground_m == static_cast<double>(void_height_m)) continue;
        const double above_m = std::exp(random.between(std::log(lowest_m), std::log(highest_m)));
        Camera camera;
        camera.width_px = width_px;
        camera.height_px = height_px;
        camera.vertical_fov_deg = 45.0;
        camera.eye = {grid.lat.at_deg(row), grid.lon.at_deg(column), ground_m + above_m};
        const double dip_deg =
            std::acos(std::min(1.0, wgs84_a_m / (wgs84_a_m + above_m))) * 180.0 / std::numbers::pi;
        camera.attitude = {random.between(0.0, 360.0), -dip_deg - random.between(0.0, steepest_deg), 0.0};
        eyes.push_back({name_of(camera, above_m), camera});
    }
    return eyes;
}

SpreadOfEyes spread_of(const std::vector<double>& values) {
    SpreadOfEyes spread;
    if (values.empty()) return spread;
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    const auto at = [&](std::size_t i) { return values[order[i]]; };
    const std::size_t count = values.size();
    spread.median = 0.5 * (at((count - 1) / 2) + at(count / 2));
    spread.high = at((95 * count + 99) / 100 - 1);
    spread.worst = at(count - 1);
    for (std::size_t i = 0; i < std::min<std::size_t>(5, count); ++i)
        spread.worst_eyes.push_back(order[count - 1 - i]);
    return spread;
}

}  // namespace oro

#include "core/frame/ridge_lines.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/base/parallel.h"
#include "core/earth/camera.h"

namespace oro {
namespace {

constexpr double evenly = 3.0;       // so many times as far as on the other side is no edge yet
constexpr double least_step = 0.03;  // of the own depth: smaller ones are no edge
constexpr double full_step = 0.35;   // and from here on it is a whole one
constexpr double near_m = 1e3, far_m = 1e5, near_share = 0.75, far_share = 0.3;
// From where on trees have lines, and where whole ones.
constexpr double growth_from_m = 1e3, growth_whole_m = 5e3;
constexpr std::array<double, 3> ink{28.0, 32.0, 42.0};

double share_of_growth(double distance_m) {
    return std::clamp((distance_m - growth_from_m) / (growth_whole_m - growth_from_m), 0.0, 1.0);
}

}  // namespace

double ridge_share(double own, double beyond, double before, double distance_m) {
    const double step = (own - beyond - evenly * std::abs(before - own)) / own;
    const double edge = std::clamp((step - least_step) / (full_step - least_step), 0.0, 1.0);
    const double away = std::clamp(std::log(distance_m / near_m) / std::log(far_m / near_m), 0.0, 1.0);
    return std::sqrt(edge) * std::lerp(near_share, far_share, away);
}

void draw_ridges(const DepthRows& picture, std::span<std::uint8_t> rgb, int threads) {
    const auto width = static_cast<std::size_t>(picture.width_px);
    assert(picture.depths.size() * 3 == rgb.size());
    const auto depth = [&](std::size_t at) { return std::abs(static_cast<double>(picture.depths[at])); };
    in_parallel(std::max(0, picture.height_px - 2), threads, [&](int row) {
        for (std::size_t x = 1; x + 1 < width; ++x) {
            const std::size_t at = (static_cast<std::size_t>(row) + 1) * width + x;
            const double own = depth(at);
            if (own <= 0.0) continue;
            const double limit = picture.depths[at] < 0.0F ? share_of_growth(near_plane_m / own) : 1.0;
            if (limit <= 0.0) continue;
            double share = 0.0;
            for (const auto& [beyond, before] :
                 {std::pair{at - width, at + width}, std::pair{at - 1, at + 1}, std::pair{at + 1, at - 1}})
                share = std::max(share,
                                 limit * ridge_share(own, depth(beyond), depth(before), near_plane_m / own));
            for (std::size_t i = 0; i < 3; ++i) {
                std::uint8_t& code = rgb[3 * at + i];
                code = static_cast<std::uint8_t>(std::lround(std::lerp(
                    static_cast<double>(code), std::min(ink[i], static_cast<double>(code)), share)));
            }
        }
    });
}

}  // namespace oro

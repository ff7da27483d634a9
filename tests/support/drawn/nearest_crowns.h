// What each pixel of a picture shows of many crowns and the ground, by asking every crown for every pixel
// that the ball around it may touch: in double, without what a picture leaves out.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "tests/support/drawn/crown_reference.h"

namespace oro::test {

// A pixel where doubles and floats may not agree is doubtful: close to the outline of what is nearest, or
// with something else at nearly the same depth.
inline constexpr int shows_no_crown = -1, is_doubtful_pixel = -2;

class NearestCrowns {
  public:
    // ground_m: depth of the ground in each pixel, infinity where there is none.
    NearestCrowns(const Projection& projection, int width_px, int height_px, std::span<const double> ground_m)
        : width_px_(width_px), height_px_(height_px), ground_m_(ground_m), pixels_(ground_m.size()) {
        const glm::dvec2 size(width_px, height_px);
        for (std::size_t i = 0; i < offsets.size(); ++i) {
            for (int x = 0; x < width_px; ++x)
                across_[i].push_back(((x + 0.5 + offsets[i].x) * 2.0 / size.x - 1.0 - projection.shift.x) /
                                     projection.scale.x);
            for (int y = 0; y < height_px; ++y)
                down_[i].push_back(((y + 0.5 + offsets[i].y) * 2.0 / size.y - 1.0 - projection.shift.y) /
                                   projection.scale.y);
        }
    }

    // Number: of a crown, not negative. The nearest first takes the least time.
    void add(const ReferenceCrown& crown, int number) {
        const double reach_m = 1.001 * crown.ball_m + 0.1 * std::max(crown.pixel_m, 0.0) + 0.01;
        if (-crown.middle.z + reach_m < 0.0) return;
        touched(across_[0], crown.middle.x, crown.middle.z, reach_m, columns_);
        if (columns_.empty()) return;
        touched(down_[0], crown.middle.y, crown.middle.z, reach_m, rows_);
        for (const int y : rows_)
            for (const int x : columns_) ask(crown, number, x, y);
    }

    // Of a pixel: the number of the crown that it shows for certain, or one of the two above.
    [[nodiscard]] int shown(int x, int y) const {
        const std::size_t at = index(x, y);
        const Pixel& pixel = pixels_[at];
        const double margin_m = margin_at(ground_m_[at]);
        bool before = true, behind = true, alone = !pixel.is_doubtful;
        for (std::size_t i = 0; i < offsets.size(); ++i) {
            before =
                before && pixel.nearest_m[i] < ground_m_[at] - 0.1 - 10.0 * margin_at(pixel.nearest_m[i]);
            behind = behind && pixel.nearest_m[i] > ground_m_[at] + 0.1 + 10.0 * margin_m;
            alone = alone && pixel.crown[i] == pixel.crown[0] &&
                    pixel.second_m[i] - pixel.nearest_m[i] > margin_at(pixel.nearest_m[i]);
        }
        const bool none = std::ranges::all_of(pixel.crown, [](int crown) { return crown == shows_no_crown; });
        if (pixel.doubtful_from_m < std::min(pixel.nearest_m[0], ground_m_[at]) + 0.1)
            return is_doubtful_pixel;
        if ((behind || none) && !pixel.is_doubtful) return shows_no_crown;
        return before && alone && pixel.crown[0] >= 0 ? pixel.crown[0] : is_doubtful_pixel;
    }

  private:
    // The middle of a pixel, and around it.
    static constexpr double beside_px = 0.03;
    static constexpr std::array<glm::dvec2, 5> offsets{{{0.0, 0.0},
                                                        {-beside_px, -beside_px},
                                                        {beside_px, -beside_px},
                                                        {-beside_px, beside_px},
                                                        {beside_px, beside_px}}};
    static constexpr double far_m = std::numeric_limits<double>::infinity();
    struct Pixel {
        std::array<double, 5> nearest_m{far_m, far_m, far_m, far_m, far_m},
            second_m{far_m, far_m, far_m, far_m, far_m};
        std::array<int, 5> crown{shows_no_crown, shows_no_crown, shows_no_crown, shows_no_crown,
                                 shows_no_crown};
        double doubtful_from_m{far_m};  // of crowns that rays step through by chance
        bool is_doubtful{};
    };
    // Of depths that floats tell apart, and leaves that steps along a ray find.
    static double margin_at(double depth_m) { return std::isfinite(depth_m) ? 0.02 + 2.0e-4 * depth_m : 0.0; }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_) +
               static_cast<std::size_t>(x);
    }

    // The rows, or columns, of pixels whose rays' plane through the eye a ball touches; slopes: of these
    // planes.
    static void touched(const std::vector<double>& slopes, double beside_m, double z_m, double radius_m,
                        std::vector<int>& found) {
        found.clear();
        for (std::size_t i = 0; i < slopes.size(); ++i) {
            const double off = beside_m + slopes[i] * z_m;
            if (off * off <= radius_m * radius_m * (1.0 + slopes[i] * slopes[i]))
                found.push_back(static_cast<int>(i));
        }
    }

    void ask(const ReferenceCrown& crown, int number, int x, int y) {
        const std::size_t at = index(x, y);
        Pixel& pixel = pixels_[at];
        const double farthest_m = std::min(*std::ranges::max_element(pixel.nearest_m), ground_m_[at]),
                     enters_m = -crown.middle.z - crown.ball_m;
        if (enters_m > farthest_m + 0.2 + 20.0 * margin_at(farthest_m)) return;
        for (std::size_t i = 0; i < offsets.size(); ++i) {
            const glm::dvec3 ray(across_[i][static_cast<std::size_t>(x)],
                                 down_[i][static_cast<std::size_t>(y)], -1.0);
            const auto [depth_m, doubtful_from_m] = meets_crown(crown, ray, i == 0);
            pixel.doubtful_from_m = std::min(pixel.doubtful_from_m, doubtful_from_m);
            if (depth_m == far_m) continue;
            pixel.is_doubtful = pixel.is_doubtful || crown.is_doubtful;
            if (depth_m < pixel.nearest_m[i]) {
                pixel.second_m[i] = pixel.nearest_m[i];
                pixel.nearest_m[i] = depth_m;
                pixel.crown[i] = number;
            } else {
                pixel.second_m[i] = std::min(pixel.second_m[i], depth_m);
            }
        }
    }

    int width_px_, height_px_;
    std::span<const double> ground_m_;
    std::vector<Pixel> pixels_;
    std::array<std::vector<double>, 5> across_, down_;
    std::vector<int> rows_, columns_;
};

}  // namespace oro::test

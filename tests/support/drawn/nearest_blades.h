// What each pixel of a picture shows of many blades and the ground, by asking every blade: in double, without
// what a picture leaves out.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

#include "tests/support/drawn/blade_reference.h"

namespace oro::test {

inline constexpr std::int64_t shows_no_blade = -1, is_doubtful_sample = -2;

class NearestBlades {
  public:
    // ground_m: depth of the ground in each pixel, infinity where there is none.
    NearestBlades(int width_px, int height_px, std::span<const double> ground_m)
        : width_px_(width_px), height_px_(height_px), ground_m_(ground_m), pixels_(ground_m.size()) {}

    // Number: of a blade, not negative.
    void add(const ReferenceBlade& blade, std::int64_t number) {
        for (const BladePiece& piece : blade.pieces) add_piece(piece, blade.is_doubtful, number);
    }

    // The number of the blade that a pixel shows for certain, or one of the two above.
    [[nodiscard]] std::int64_t shown(int x, int y) const {
        const Pixel& pixel = pixels_[index(x, y)];
        const double ground_m = ground_m_[index(x, y)];
        if (pixel.is_doubtful) return is_doubtful_sample;
        bool none = true, behind = true, certain = true;
        for (std::size_t i = 0; i < offsets.size(); ++i) {
            const double nearest_m = 1.0 / pixel.nearest_per_m[i], second_m = 1.0 / pixel.second_per_m[i];
            none = none && pixel.blade[i] == shows_no_blade;
            behind = behind && nearest_m > ground_m + ground_margin(ground_m);
            certain = certain && pixel.blade[i] == pixel.blade[0] &&
                      nearest_m < ground_m - ground_margin(ground_m) &&
                      second_m - nearest_m > 0.003 + 2.0e-4 * nearest_m;
        }
        if (none || behind) return shows_no_blade;
        return certain ? pixel.blade[0] : is_doubtful_sample;
    }

  private:
    static constexpr double beside_px = 0.08;
    static constexpr std::array<glm::dvec2, 5> offsets{{{0.0, 0.0},
                                                        {-beside_px, -beside_px},
                                                        {beside_px, -beside_px},
                                                        {-beside_px, beside_px},
                                                        {beside_px, beside_px}}};
    struct Pixel {
        std::array<double, 5> nearest_per_m{}, second_per_m{};
        std::array<std::int64_t, 5> blade{shows_no_blade, shows_no_blade, shows_no_blade, shows_no_blade,
                                          shows_no_blade};
        bool is_doubtful{};
    };
    static double ground_margin(double ground_m) {
        return std::isfinite(ground_m) ? 0.005 + 0.004 * ground_m : 0.0;
    }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_) +
               static_cast<std::size_t>(x);
    }

    // From where to where a row lies between a piece's edges.
    static std::pair<double, double> span_at(const BladePiece& piece, double y) {
        double low = 1.0e9, high = -1.0e9;
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec2 &from = piece.corners[i], &to = piece.corners[(i + 1) % 4];
            if ((from.y > y) == (to.y > y)) continue;
            const double x = from.x + (y - from.y) * (to.x - from.x) / (to.y - from.y);
            low = std::min(low, x);
            high = std::max(high, x);
        }
        return {low, high};
    }

    void add_piece(const BladePiece& piece, bool is_doubtful, std::int64_t number) {
        glm::dvec2 low(piece.corners[0]), high(low);
        for (const glm::dvec2& corner : piece.corners) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
        const auto pixel_at = [](double px, int last) {
            return static_cast<int>(std::clamp(std::floor(px), -1.0, last + 1.0));
        };
        const int first_x = std::max(pixel_at(low.x - 1.0, width_px_), 0),
                  last_x = std::min(pixel_at(high.x + 1.0, width_px_), width_px_ - 1);
        const int first_y = std::max(pixel_at(low.y - 1.0, height_px_), 0),
                  last_y = std::min(pixel_at(high.y + 1.0, height_px_), height_px_ - 1);
        for (int y = first_y; y <= last_y; ++y) {
            std::array<std::pair<double, double>, 5> spans;
            for (std::size_t i = 0; i < 5; ++i) spans[i] = span_at(piece, y + 0.5 + offsets[i].y);
            for (int x = first_x; x <= last_x; ++x) {
                Pixel& pixel = pixels_[index(x, y)];
                for (std::size_t i = 0; i < 5; ++i) {
                    const glm::dvec2 at = glm::dvec2(x, y) + 0.5 + offsets[i];
                    if (at.x < spans[i].first || at.x >= spans[i].second) continue;
                    const double share = std::clamp(glm::dot(at - piece.low_px, piece.way), 0.0, 1.0);
                    keep(pixel, i, piece.low_per_m + share * (piece.high_per_m - piece.low_per_m), number);
                    pixel.is_doubtful = pixel.is_doubtful || is_doubtful;
                }
            }
        }
    }
    // Pieces of one blade are no other thing.
    static void keep(Pixel& pixel, std::size_t i, double per_m, std::int64_t number) {
        if (per_m > pixel.nearest_per_m[i]) {
            if (pixel.blade[i] != number) pixel.second_per_m[i] = pixel.nearest_per_m[i];
            pixel.nearest_per_m[i] = per_m;
            pixel.blade[i] = number;
        } else if (pixel.blade[i] != number) {
            pixel.second_per_m[i] = std::max(pixel.second_per_m[i], per_m);
        }
    }

    int width_px_, height_px_;
    std::span<const double> ground_m_;
    std::vector<Pixel> pixels_;
};

}  // namespace oro::test

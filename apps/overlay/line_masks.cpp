#include "apps/overlay/line_masks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace oro {
namespace {

constexpr int square_px = 64;

// From a place to a line between two others.
double distance_px(glm::dvec2 place, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 along = to - from;
    const double squared = glm::dot(along, along);
    const double share = squared > 0.0 ? std::clamp(glm::dot(place - from, along) / squared, 0.0, 1.0) : 0.0;
    return glm::length(place - (from + share * along));
}

}  // namespace

std::uint8_t& LineMask::at(int x, int y) {
    const std::pair<int, int> number{y / square_px, x / square_px};
    if (last_square_ == nullptr || number != last_) {
        TextMask& square = squares_[number];
        if (square.ink.empty()) {
            square.x_px = number.second * square_px;
            square.y_px = number.first * square_px;
            square.width_px = std::min(square_px, width_px_ - square.x_px);
            square.height_px = std::min(square_px, height_px_ - square.y_px);
            square.ink.resize(static_cast<std::size_t>(square.width_px) *
                              static_cast<std::size_t>(square.height_px));
            square.halo.resize(square.ink.size());
        }
        last_ = number;
        last_square_ = &square;
    }
    TextMask& square = *last_square_;
    return square.ink[static_cast<std::size_t>(y - square.y_px) * static_cast<std::size_t>(square.width_px) +
                      static_cast<std::size_t>(x - square.x_px)];
}

void LineMask::cover(int x_px, int y_px, std::uint8_t share) {
    if (share == 0) return;
    std::uint8_t& covered = at(x_px, y_px);
    covered = std::max(covered, share);
}

void LineMask::add_piece(glm::dvec2 from, glm::dvec2 to, double half_px, double strength) {
    const double reach = half_px + 0.5;
    const int left = std::max(0, static_cast<int>(std::floor(std::min(from.x, to.x) - reach))),
              right = std::min(width_px_ - 1, static_cast<int>(std::floor(std::max(from.x, to.x) + reach))),
              top = std::max(0, static_cast<int>(std::floor(std::min(from.y, to.y) - reach))),
              bottom = std::min(height_px_ - 1, static_cast<int>(std::floor(std::max(from.y, to.y) + reach)));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const double away_px = distance_px({x + 0.5, y + 0.5}, from, to);
            const double share = strength * std::clamp(half_px + 0.5 - away_px, 0.0, 1.0);
            cover(x, y, static_cast<std::uint8_t>(std::lround(255.0 * share)));
        }
    }
}

void LineMask::add(const std::vector<glm::dvec2>& places_px, double line_width_px) {
    const double half_px = 0.5 * std::max(1.0, line_width_px), strength = std::min(1.0, line_width_px);
    for (std::size_t i = 0; i + 1 < places_px.size(); ++i)
        add_piece(places_px[i], places_px[i + 1], half_px, strength);
}

void LineMask::give(const InkedText::Colour& colour, std::vector<InkedText>& inked) {
    for (auto& [number, square] : squares_) inked.push_back({std::move(square), colour, {}});
    squares_.clear();
    last_square_ = nullptr;
}

}  // namespace oro

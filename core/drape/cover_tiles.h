// Land cover over a region's ground, as tiles of a pyramid like those of images: what the GPU gets of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/drape/ground_image.h"

namespace oro {

// A texel of cover: four pairs of 4 bits, from the low ones on: which ground, and how many fifteenths of the
// texel are of it. All together are 15; in a texel that is all zero nothing is known.
inline constexpr std::uint32_t cover_units = 15;
// The ground of places of which nothing is known: a rule says what covers them.
inline constexpr std::uint32_t unknown_ground = 15;
inline constexpr std::size_t cover_pairs = 4;

// What the number of a ground stands for.
struct GroundColour {
    glm::vec3 colour{};         // linear light, Rec. 709 primaries
    std::uint32_t materials{};  // numbers of one or two materials, in the low and the next byte; alike of one
    // What is steeper, lower or higher is rock or scree instead: known to a degree and to 50 m.
    float steepest_deg{90.0F};
    float lowest_H_m{-12000.0F};
    float highest_H_m{9000.0F};
};

// Safe to ask from several threads. load() fills texels as above; the finest level has one ground a texel,
// coarser ones the shares of all that they cover, of the largest four: what is left out of a texel goes to
// the next ones, so that means stay.
class CoverTiles : public GroundImage {
  public:
    // By the numbers in texels; at most 15.
    [[nodiscard]] virtual std::span<const GroundColour> grounds() const = 0;
};

// Brings shares to texels of the form above.
class CoverTexels {
  public:
    // Of a row of so many texels.
    explicit CoverTexels(std::size_t columns) : below_(columns) {}

    using Shares = std::array<float, unknown_ground + 1>;  // by ground; together 1
    // The texel of shares, of a pixel in a column; rows from the top, columns from the left. What it cannot
    // hold goes to the next texel and to the one below.
    std::uint32_t pack(std::size_t column, const Shares& shares);

  private:
    std::vector<Shares> below_;  // in fifteenths
    Shares right_{};
};

}  // namespace oro
